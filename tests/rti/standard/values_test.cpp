// Handles, values and exceptions of the standard's API.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <typeinfo>

#include "rti/standard/errors.h"
#include "rti/standard/exception_names.h"
#include "rti/standard/handles.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {
namespace {

using rti1516e::VariableLengthData;

std::string bytes_in(const VariableLengthData& data) {
  return {static_cast<const char*>(data.data()), data.size()};
}

TEST(StandardHandles, AnEmptyHandleIsInvalidAndNumbersKeepTheirOrder) {
  const rti1516e::AttributeHandle none, first = to_standard(rti::AttributeHandle{0}),
                                        second = to_standard(rti::AttributeHandle{1});
  EXPECT_FALSE(none.isValid());
  EXPECT_TRUE(first.isValid());
  EXPECT_LT(none, first);
  EXPECT_LT(first, second);
  EXPECT_NE(first, second);
  EXPECT_EQ(first, to_standard(rti::AttributeHandle{0}));
  EXPECT_FALSE(to_core(none));
  EXPECT_EQ(to_core(second).value, 1u);
  EXPECT_EQ(second.toString(), L"1");
}

TEST(StandardHandles, AHandleIsEncodedInFourBytesTheMostSignificantFirst) {
  const auto handle = to_standard(rti::ObjectHandle{0x01020304});
  EXPECT_EQ(bytes_in(handle.encode()), std::string("\1\2\3\4"));
  EXPECT_EQ(handle.encodedLength(), 4u);
  EXPECT_EQ(rti1516e::ObjectInstanceHandleFriend::decode(handle.encode()), handle);
  char room[3];
  EXPECT_THROW(handle.encode(room, sizeof room), rti1516e::CouldNotEncode);
  EXPECT_THROW(rti1516e::ObjectInstanceHandleFriend::decode(VariableLengthData("abc", 3)),
               rti1516e::CouldNotDecode);
}

TEST(StandardHandles, ARetractionHandleSurvivesItsEncodingAndItsCopies) {
  const rti::RetractionHandle message{{7}, 1234567890123, 2.5};
  rti1516e::MessageRetractionHandle handle = to_standard(message), copy;
  EXPECT_FALSE(copy.isValid());
  copy = handle;
  const rti1516e::MessageRetractionHandle& self = copy;
  copy = self;
  EXPECT_EQ(to_core(copy), message);
  EXPECT_EQ(handle.encodedLength(), 20u);
  EXPECT_EQ(to_core(rti1516e::MessageRetractionHandleFriend::decode(handle.encode())), message);
  EXPECT_FALSE(to_standard(rti::RetractionHandle()).isValid());
}

TEST(StandardHandles, SetsThatNoClassHasAreRefused) {
  EXPECT_EQ(to_core(to_standard(rti::AttributeSet{{3}, {40}})), (rti::AttributeSet{{3}, {40}}));
  EXPECT_THROW(to_core(rti1516e::AttributeHandleSet{to_standard(rti::AttributeHandle{127})}),
               rti1516e::AttributeNotDefined);
  EXPECT_THROW(to_core(rti1516e::AttributeHandleSet{rti1516e::AttributeHandle()}),
               rti1516e::AttributeNotDefined);
  EXPECT_THROW(to_core(rti1516e::DimensionHandleSet{to_standard(rti::DimensionHandle{64})}),
               rti1516e::InvalidDimensionHandle);
}

TEST(StandardValues, BytesAreCopiedBorrowedOrTakenOver) {
  std::string text = "abc";
  VariableLengthData copied(text.data(), text.size()), borrowed;
  borrowed.setDataPointer(text.data(), text.size());
  text[0] = 'x';
  EXPECT_EQ(bytes_in(copied), "abc");
  EXPECT_EQ(bytes_in(borrowed), "xbc");
  const VariableLengthData copy(borrowed);
  text[0] = 'y';
  EXPECT_EQ(bytes_in(copy), "xbc");

  static int deletions;
  deletions = 0;
  {
    VariableLengthData taken;
    taken.takeDataPointer(text.data(), text.size(), [](void*) { ++deletions; });
    EXPECT_EQ(bytes_in(taken), "ybc");
    taken.setData("z", 1);
    EXPECT_EQ(deletions, 1);
    taken.takeDataPointer(new char[2]{'o', 'k'}, 2);
    EXPECT_EQ(bytes_in(taken), "ok");
    taken.setData(taken.data(), 1);
    EXPECT_EQ(bytes_in(taken), "o");
  }
  EXPECT_EQ(deletions, 1);
  EXPECT_EQ(VariableLengthData().size(), 0u);
}

/// The name of the exception that is thrown, and what it says.
std::pair<std::string, std::wstring> thrown_for(std::string_view name) {
#define RINK_CATCH(Name)                                                  \
  catch (const rti1516e::Name& exception) {                               \
    return std::pair<std::string, std::wstring>(#Name, exception.what()); \
  }
  try {
    throw_standard(name, "why");
  }
  RINK_STANDARD_EXCEPTIONS(RINK_CATCH)
#undef RINK_CATCH
}

TEST(StandardErrors, EveryErrorOfTheCoreIsTheExceptionOfItsName) {
  for (int i = 1; i <= static_cast<int>(rti::HlaError::restore_not_in_progress); ++i) {
    const std::string name = rti::to_string(static_cast<rti::HlaError>(i));
    // Its own refusal of a shared key is no exception of the standard.
    EXPECT_EQ(thrown_for(name).first, name == "Unauthorized" ? "RTIinternalError" : name);
  }
  EXPECT_EQ(thrown_for("AttributeNotOwned").second, L"why");
  EXPECT_THROW(translated([] { throw rti::RtiException(rti::HlaError::illegal_name, "HLAx"); }),
               rti1516e::IllegalName);
}

TEST(WideText, Utf8AndWideStringsNameTheSameCharacters) {
  EXPECT_EQ(to_utf8(L"\u00e9\u20ac\U0001f6a2"), "\xc3\xa9\xe2\x82\xac\xf0\x9f\x9a\xa2");
  for (const std::wstring text : {L"", L"Pequod", L"\u00e9\u20ac\U0001f6a2\U0010ffff"})
    EXPECT_EQ(to_wide(to_utf8(text)), text);
  EXPECT_EQ(to_utf16(L"a\U0001f6a2"), u"a\xd83d\xdea2");
  EXPECT_EQ(from_utf16(u"a\xd83d\xdea2"), L"a\U0001f6a2");
}

TEST(WideText, WhatIsNoTextBecomesTheReplacementCharacter) {
  // Overlong, cut short, a surrogate, beyond Unicode, a continuation without a beginning.
  for (const char* const bytes :
       {"\xc0\x80", "\xe2\x82", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\x80"})
    EXPECT_NE(to_wide(bytes).find(L'\ufffd'), std::wstring::npos) << bytes;
  EXPECT_EQ(to_utf8(std::wstring(1, static_cast<wchar_t>(0xd800))), "\xef\xbf\xbd");
  EXPECT_EQ(from_utf16(std::u16string(1, 0xd800)), L"\ufffd");
}

}  // namespace
}  // namespace rink::standard
