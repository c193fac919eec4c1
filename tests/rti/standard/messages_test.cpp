// Values, tags and settings between the standard's API and the core.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "rti/standard/handles.h"
#include "rti/standard/settings.h"
#include "rti/standard/values.h"
#include "tests/places.h"

namespace rink::standard {
namespace {

using rti1516e::VariableLengthData;

VariableLengthData value_of(const std::string& text) {
  return VariableLengthData(text.data(), text.size());
}
std::string content(const VariableLengthData& value) {
  return {static_cast<const char*>(value.data()), value.size()};
}

const rti::Fom& port() {
  static const auto model = load_model({test::source_folder() + "/tests/rti/standard/port.xml"});
  return *model;
}
rti::InteractionClassHandle hail() { return *port().interaction_class("Hail"); }
rti1516e::ParameterHandle parameter(const char* name) {
  return to_standard(*port().parameter(hail(), name));
}

TEST(StandardTags, TagsOfUpToSevenBytesGoWithAnyMessage) {
  for (std::size_t size = 0; size <= 7; ++size) {
    const std::string tag = std::string(
                                "\0\xff"
                                "abcde",
                                7)
                                .substr(0, size);
    const ReceivedTag plain = read_tag(tag_stamp(value_of(tag), {}));
    EXPECT_EQ(content(plain.tag), tag);
    EXPECT_FALSE(plain.has_time);
    const rti::Stamp timed = tag_stamp(value_of(tag), 2.5);
    EXPECT_EQ(timed.time, 2.5);
    EXPECT_EQ(content(read_tag(timed).tag), tag);
    EXPECT_TRUE(read_tag(timed).has_time);
  }
  EXPECT_EQ(tag_stamp({}, {}), rti::Stamp{});
}

TEST(StandardTags, TagsOfUpToThirteenBytesGoWithMessagesThatHaveNoTime) {
  for (std::size_t size = 8; size <= 13; ++size) {
    const std::string tag = std::string("1234567\xff\0\xff\xff\xff\xff", 13).substr(0, size);
    EXPECT_EQ(content(read_tag(tag_stamp(value_of(tag), {})).tag), tag);
    EXPECT_THROW(tag_stamp(value_of(tag), 1.0), rti1516e::RTIinternalError);
  }
  EXPECT_THROW(tag_stamp(value_of(std::string(14, 'x')), {}), rti1516e::RTIinternalError);
}

TEST(StandardTags, TheNumberOfAFederateOfRinksOwnApiIsItsEightBytes) {
  EXPECT_EQ(content(read_tag({1.0, 0x0102030405060708}).tag), "\1\2\3\4\5\6\7\10");
}

TEST(StandardInteractions, AllParametersFollowEachOtherAsRinksOwnApiHasThem) {
  const Message message = encode_message(
      port(), hail(),
      {{parameter("from"), value_of("abcd")}, {parameter("words"), value_of("ahoy")}}, {}, {});
  const std::string expected("abcd\4\0\0\0ahoy", 12);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(message.parameters.data()),
                        message.parameters.size()),
            expected);
  EXPECT_EQ(message.stamp, rti::Stamp{});
}

TEST(StandardInteractions, AnyParametersAndAnyTagArrive) {
  const rti1516e::ParameterHandleValueMap both{{parameter("from"), value_of("abcd")},
                                               {parameter("words"), value_of("ahoy")}},
      one{{parameter("words"), value_of("")}};
  for (const auto& values : {both, one, rti1516e::ParameterHandleValueMap()})
    for (const std::size_t size : {0u, 7u, 8u, 1000u}) {
      const std::string tag(size, 't');
      const Message sent = encode_message(port(), hail(), values, value_of(tag), 4.0);
      const ReceivedMessage got =
          decode_message(port(), hail(), hail(), sent.parameters, sent.stamp);
      EXPECT_EQ(content(got.tag), tag);
      EXPECT_TRUE(got.has_time);
      ASSERT_EQ(got.values.size(), values.size());
      for (const auto& [handle, value] : values)
        EXPECT_EQ(content(got.values.at(handle)), content(value));
    }
}

TEST(StandardInteractions, ParametersThatTheKnownClassHasNotAreLeftOut) {
  const rti::InteractionClassHandle signal = *port().interaction_class("Signal");
  const Message sent = encode_message(
      port(), hail(),
      {{parameter("from"), value_of("abcd")}, {parameter("words"), value_of("ahoy")}}, {}, {});
  const ReceivedMessage got = decode_message(port(), hail(), signal, sent.parameters, sent.stamp);
  ASSERT_EQ(got.values.size(), 1u);
  EXPECT_EQ(content(got.values.at(parameter("from"))), "abcd");
}

TEST(StandardInteractions, BytesThatAreNeitherFormGiveNoValues) {
  const std::string bytes = "xy";
  const auto got =
      decode_message(port(), hail(), hail(), std::as_bytes(std::span(bytes)), {0.0, 0});
  EXPECT_TRUE(got.values.empty());
  const auto apart = decode_message(port(), hail(), hail(), std::as_bytes(std::span(bytes)),
                                    {0.0, std::uint64_t{0xa0} << 56});
  EXPECT_TRUE(apart.values.empty());
}

TEST(StandardInteractions, AValueOfAnotherSizeThanItsTypesIsRefused) {
  EXPECT_THROW(
      encode_message(port(), hail(),
                     {{parameter("from"), value_of("abc")}, {parameter("words"), value_of("")}}, {},
                     {}),
      rti1516e::RTIinternalError);
  EXPECT_THROW(encode_message(port(), hail(),
                              {{to_standard(rti::ParameterHandle{9}), value_of("")}}, {}, {}),
               rti1516e::InteractionParameterNotDefined);
}

Update encoded(const rti1516e::AttributeHandleValueMap& values) {
  Update update;
  encode_update(port(), *port().object_class("Ship"), values, update);
  return update;
}

TEST(StandardUpdates, OnlyWantedAttributesAreRead) {
  const rti::ObjectClassHandle ship = *port().object_class("Ship");
  const auto x = to_standard(*port().attribute(ship, "x"));
  const auto name = to_standard(*port().attribute(ship, "flag"));
  const Update update = encoded({{x, value_of("12345678")}, {name, value_of("red")}});
  const auto all = decode_update(port(), ship, update.attributes, update.values, update.attributes);
  EXPECT_EQ(content(all.at(x)), "12345678");
  EXPECT_EQ(content(all.at(name)), "red");
  const auto one = decode_update(port(), ship, update.attributes, update.values,
                                 rti::AttributeSet{to_core(name)});
  EXPECT_EQ(one.size(), 1u);
  EXPECT_EQ(content(one.at(name)), "red");
  EXPECT_THROW(encoded({{x, value_of("1")}}), rti1516e::RTIinternalError);
  EXPECT_THROW(encoded({{to_standard(rti::AttributeHandle{77}), value_of("1")}}),
               rti1516e::AttributeNotDefined);
}

TEST(StandardSettings, AnAddressIsReadInEveryForm) {
  for (const wchar_t* const form :
       {L"harbour:7001", L"rti://harbour:7001/", L"address=harbour:7001",
        L"crcAddress=harbour\nport=7001", L"host = x; host=harbour;port=7001"}) {
    const Settings settings = read_settings(form);
    EXPECT_EQ(settings.host, "harbour");
    EXPECT_EQ(settings.port, 7001);
  }
  EXPECT_EQ(read_settings(L"").port, 7000);
  EXPECT_EQ(read_settings(L"[::1]:7002").host, "::1");
  EXPECT_EQ(read_settings(L"fom=a.xml, b.xml;time=HLAinteger64Time").fom,
            (std::vector<std::string>{"a.xml", "b.xml"}));
}

TEST(StandardSettings, WhatIsNoSettingIsRefused) {
  for (const wchar_t* const wrong :
       {L"harbour:70000", L"harbour:x", L":7000", L"colour=red", L"port=0", L"time=days"})
    EXPECT_THROW(read_settings(wrong), rti1516e::InvalidLocalSettingsDesignator);
}

TEST(StandardSettings, AModelThatIsNotThereIsNamed) {
  EXPECT_THROW(load_model({"no-such-model.xml"}), rti1516e::CouldNotOpenFDD);
  EXPECT_THROW(load_model({}), rti1516e::CouldNotOpenFDD);
  EXPECT_THROW(load_model({test::source_folder() + "/tests/rti/standard/CMakeLists.txt"}),
               rti1516e::ErrorReadingFDD);
  EXPECT_EQ(load_model({"HLAstandardMIM",
                        "file://" + test::source_folder() + "/tests/rti/standard/port.xml"})
                ->name(),
            "Port");
}

}  // namespace
}  // namespace rink::standard
