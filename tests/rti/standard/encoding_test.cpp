// Encoding helpers against the layouts of IEEE 1516.2-2010, 4.13, and against the other encoder of
// this library, which is written from the same clause.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "rti/standard/standard_headers.h"
#include "rti/wire/data_elements.h"

namespace rink::standard {
namespace {

using namespace rti1516e;
namespace data = rti::data;

std::string octets(const DataElement& element) {
  const VariableLengthData encoded = element.encode();
  return {static_cast<const char*>(encoded.data()), encoded.size()};
}
std::string octets(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
VariableLengthData data_of(const std::string& text) {
  return VariableLengthData(text.data(), text.size());
}
std::string text(const char* literal, std::size_t size) { return {literal, size}; }

TEST(StandardEncoding, BasicRepresentationsAreInTheirByteOrder) {
  EXPECT_EQ(octets(HLAinteger16BE(0x0102)), "\1\2");
  EXPECT_EQ(octets(HLAinteger16LE(0x0102)), "\2\1");
  EXPECT_EQ(octets(HLAinteger32BE(0x01020304)), "\1\2\3\4");
  EXPECT_EQ(octets(HLAinteger32LE(0x01020304)), "\4\3\2\1");
  EXPECT_EQ(octets(HLAinteger64BE(0x0102030405060708)), "\1\2\3\4\5\6\7\10");
  EXPECT_EQ(octets(HLAinteger64LE(-2)), "\xfe\xff\xff\xff\xff\xff\xff\xff");
  EXPECT_EQ(octets(HLAfloat32BE(1.0f)), text("\x3f\x80\0\0", 4));
  EXPECT_EQ(octets(HLAfloat32LE(1.0f)), text("\0\0\x80\x3f", 4));
  EXPECT_EQ(octets(HLAfloat64BE(-2.0)), text("\xc0\0\0\0\0\0\0\0", 8));
  EXPECT_EQ(octets(HLAfloat64LE(-2.0)), text("\0\0\0\0\0\0\0\xc0", 8));
  EXPECT_EQ(octets(HLAoctet('a')), "a");
  EXPECT_EQ(octets(HLAbyte('a')), "a");
  EXPECT_EQ(octets(HLAASCIIchar('a')), "a");
  EXPECT_EQ(octets(HLAoctetPairBE(OctetPair('a', 'b'))), "ab");
  EXPECT_EQ(octets(HLAoctetPairLE(OctetPair('a', 'b'))), "ba");
  EXPECT_EQ(octets(HLAunicodeChar(L'\u20ac')), "\x20\xac");
  EXPECT_EQ(octets(HLAboolean(true)), text("\0\0\0\1", 4));
  EXPECT_EQ(octets(HLAASCIIstring(std::string("ab"))), text("\0\0\0\2ab", 6));
  EXPECT_EQ(octets(HLAunicodeString(std::wstring(L"a\U0001f6a2"))),
            text("\0\0\0\3\0a\xd8\x3d\xde\xa2", 10));
}

TEST(StandardEncoding, WhatWasEncodedIsDecoded) {
  HLAfloat64LE number;
  number.decode(HLAfloat64LE(-1.5e300).encode());
  EXPECT_EQ(number.get(), -1.5e300);
  HLAunicodeString name;
  name.decode(HLAunicodeString(std::wstring(L"\u00e9\U0001f6a2")).encode());
  EXPECT_EQ(name.get(), L"\u00e9\U0001f6a2");
  HLAoctetPairLE pair;
  pair.decode(HLAoctetPairLE(OctetPair('a', 'b')).encode());
  EXPECT_EQ(pair.get(), OctetPair('a', 'b'));
  HLAboolean truth;
  EXPECT_THROW(truth.decode(data_of(text("\0\0\0\2", 4))), EncoderException);
}

TEST(StandardEncoding, AValueOfTheUsersIsReadAndWrittenInItsPlace) {
  Integer32 mine = 5;
  HLAinteger32BE element(&mine);
  mine = 6;
  EXPECT_EQ(octets(element), text("\0\0\0\6", 4));
  element.decode(data_of(text("\0\0\0\7", 4)));
  EXPECT_EQ(mine, 7);
  const HLAinteger32BE copy(element);
  mine = 8;
  EXPECT_EQ(copy.get(), 7);
  EXPECT_THROW(element.setDataPointer(nullptr), EncoderException);
}

TEST(StandardEncoding, FieldsOfARecordBeginAtTheirBoundaries) {
  HLAfixedRecord record;
  record.appendElement(HLAoctet('d'));
  record.appendElement(HLAfloat64BE(1.0));
  record.appendElement(HLAinteger16BE(2));
  record.appendElement(HLAinteger32BE(3));
  EXPECT_EQ(record.getOctetBoundary(), 8u);
  EXPECT_EQ(octets(record), text("d\0\0\0\0\0\0\0\x3f\xf0\0\0\0\0\0\0\0\2\0\0\0\0\0\3", 24));
  EXPECT_EQ(record.getEncodedLength(), 24u);
  HLAfixedRecord read(record);
  read.set(1, HLAfloat64BE(0.0));
  read.decode(record.encode());
  EXPECT_EQ(dynamic_cast<const HLAfloat64BE&>(read.get(1)).get(), 1.0);
  EXPECT_THROW(read.set(0, HLAfloat64BE(0.0)), EncoderException);
  EXPECT_THROW(read.get(4), EncoderException);
}

TEST(StandardEncoding, ElementsOfAnArrayBeginAtTheirBoundariesAndNothingFollowsTheLast) {
  HLAfixedRecord element;
  element.appendElement(HLAinteger32BE(0));
  element.appendElement(HLAoctet('x'));
  HLAfixedArray two(element, 2);
  EXPECT_EQ(octets(two), text("\0\0\0\0x\0\0\0\0\0\0\0x", 13));
  HLAvariableArray any{HLAfloat64BE()};
  EXPECT_EQ(octets(any), text("\0\0\0\0", 4));
  any.addElement(HLAfloat64BE(1.0));
  EXPECT_EQ(octets(any), text("\0\0\0\1\0\0\0\0\x3f\xf0\0\0\0\0\0\0", 16));
  EXPECT_THROW(any.addElement(HLAfloat32BE(1.0f)), EncoderException);
}

TEST(StandardEncoding, TheAlternativesOfAVariantRecordBeginAtTheWidestBoundary) {
  HLAvariantRecord record{HLAoctet()};
  record.addVariant(HLAoctet(1), HLAoctet('a'));
  record.addVariant(HLAoctet(2), HLAfloat64BE(1.0));
  record.setDiscriminant(HLAoctet(1));
  EXPECT_EQ(octets(record), text("\1\0\0\0\0\0\0\0a", 9));
  record.setVariant(HLAoctet(2), HLAfloat64BE(-2.0));
  EXPECT_EQ(octets(record), text("\2\0\0\0\0\0\0\0\xc0\0\0\0\0\0\0\0", 16));
  HLAvariantRecord read(record);
  read.setDiscriminant(HLAoctet(1));
  read.decode(record.encode());
  EXPECT_EQ(dynamic_cast<const HLAfloat64BE&>(read.getVariant()).get(), -2.0);
  EXPECT_THROW(record.setDiscriminant(HLAoctet(3)), EncoderException);
  EXPECT_THROW(record.setVariant(HLAoctet(1), HLAfloat64BE(0.0)), EncoderException);
}

/// Octets of a value that stands after others in a buffer do not depend on these.
TEST(StandardEncoding, ElementsFollowEachOtherInABuffer) {
  std::vector<Octet> buffer{'?'};
  HLAfixedRecord record;
  record.appendElement(HLAoctet('d'));
  record.appendElement(HLAinteger16BE(258));
  record.encodeInto(buffer);
  HLAASCIIstring(std::string("ab")).encodeInto(buffer);
  EXPECT_EQ(std::string(buffer.begin(), buffer.end()), text("?d\0\1\2\0\0\0\2ab", 11));
  HLAASCIIstring name;
  EXPECT_EQ(name.decodeFrom(buffer, record.decodeFrom(buffer, 1)), buffer.size());
  EXPECT_EQ(name.get(), "ab");
}

TEST(StandardEncoding, OpaqueDataMayBeSetToAPartOfItself) {
  const std::string all = "a ship that is longer than its prow";
  HLAopaqueData opaque(all.data(), all.size());
  opaque.set(opaque.get() + 2, 4);
  EXPECT_EQ(std::string(opaque.get(), opaque.dataLength()), "ship");
}

TEST(StandardEncoding, AUnicodeCharIsACodeUnitAlsoHalfOfAPair) {
  for (const wchar_t unit : {L'x', wchar_t{0xd801}, wchar_t{0xdfff}, wchar_t{0xffff}}) {
    HLAunicodeChar read;
    read.decode(HLAunicodeChar(unit).encode());
    EXPECT_EQ(read.get(), unit);
  }
  EXPECT_THROW(HLAunicodeChar(wchar_t{0x10000}).encode(), EncoderException);
}

TEST(StandardEncoding, OpaqueDataLiesInTheUsersBufferIfThatHasRoom) {
  Octet room[4] = {'a', 'b', 'c', 'd'};
  Octet* place = room;
  HLAopaqueData opaque(&place, 4, 2);
  EXPECT_EQ(octets(opaque), text("\0\0\0\2ab", 6));
  opaque.decode(data_of(text("\0\0\0\3xyz", 7)));
  EXPECT_EQ(std::string(room, 4), "xyzd");
  EXPECT_EQ(opaque.dataLength(), 3u);
  EXPECT_THROW(opaque.decode(data_of(text("\0\0\0\5vwxyz", 9))), EncoderException);
  EXPECT_THROW(HLAopaqueData(&place, 1, 2), EncoderException);
}

struct Sample {
  std::uint8_t deck;
  double x;
  std::string name;
  std::vector<std::int16_t> depths;
};
using SampleElement =
    data::FixedRecord<data::Field<&Sample::deck, data::Octet>,
                      data::Field<&Sample::x, data::Float64BE>,
                      data::Field<&Sample::name, data::AsciiString>,
                      data::Field<&Sample::depths, data::VariableArray<data::Integer16BE>>>;

HLAfixedRecord record_of(const Sample& sample) {
  HLAfixedRecord record;
  record.appendElement(HLAoctet(static_cast<Octet>(sample.deck)));
  record.appendElement(HLAfloat64BE(sample.x));
  record.appendElement(HLAASCIIstring(sample.name));
  HLAvariableArray depths{HLAinteger16BE()};
  for (const std::int16_t each : sample.depths) depths.addElement(HLAinteger16BE(each));
  record.appendElement(depths);
  return record;
}

Sample random_sample(std::mt19937& random) {
  Sample sample{static_cast<std::uint8_t>(random()), static_cast<double>(random()), {}, {}};
  sample.name.assign(random() % 9, 'n');
  for (auto left = random() % 5; left > 0; --left)
    sample.depths.push_back(static_cast<std::int16_t>(random()));
  return sample;
}

TEST(StandardEncoding, BothEncodersOfThisLibraryAgreeOnAThousandRecords) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Sample sample = random_sample(random);
    const HLAfixedRecord record = record_of(sample);
    ASSERT_EQ(octets(record), octets(data::encode<SampleElement>(sample)));
    HLAfixedRecord read = record_of({});
    read.decode(record.encode());
    ASSERT_EQ(octets(read), octets(record));
  }
}

/// Cut short anywhere, or with any octet changed, a value is decoded or refused.
TEST(StandardEncoding, BytesOfStrangersAreDecodedOrRefused) {
  std::mt19937 random(2);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = octets(record_of(random_sample(random)));
    if (i % 2 == 0) bytes.resize(random() % bytes.size());
    else bytes[random() % bytes.size()] = static_cast<char>(random());
    HLAfixedRecord read = record_of({});
    try {
      read.decode(data_of(bytes));
    } catch (const EncoderException&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace rink::standard
