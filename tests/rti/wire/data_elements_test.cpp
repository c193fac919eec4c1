// Encodings of IEEE 1516.2-2010, 4.13.9, against bytes laid out by hand and against the sizes that
// the reader of object models computes.
#include <gtest/gtest.h>

#include <random>

#include "rti/wire/data_elements.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using namespace data;

std::string hexadecimal_of(Bytes bytes) {
  std::string text;
  for (const std::byte each : bytes) {
    char digits[4];
    std::snprintf(digits, sizeof digits, "%s%02x", text.empty() ? "" : " ",
                  static_cast<unsigned>(each));
    text += digits;
  }
  return text;
}

/// Encodes, compares with the bytes by hand, decodes, and refuses all that is shorter or longer.
template <class Element>
void expect_layout(const typename Element::Value& value, const std::string& by_hand) {
  std::vector<std::byte> bytes = encode<Element>(value);
  EXPECT_EQ(hexadecimal_of(bytes), by_hand);
  EXPECT_EQ(decode<Element>(bytes), value);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_EQ(decode<Element>(Bytes(bytes).first(size)), std::nullopt) << size;
  bytes.push_back(std::byte{0});
  EXPECT_EQ(decode<Element>(bytes), std::nullopt);
}

struct Reading {
  std::uint8_t kind = 0;
  double level = 0.0;
  std::int16_t count = 0;
  friend bool operator==(const Reading&, const Reading&) = default;
};
using ReadingElement = FixedRecord<Field<&Reading::kind, Octet>, Field<&Reading::level, Float64BE>,
                                   Field<&Reading::count, Integer16BE>>;

struct Station3 {
  std::int16_t number = 0;
  std::vector<Reading> readings;
  std::string name;
  friend bool operator==(const Station3&, const Station3&) = default;
};
using StationElement = FixedRecord<Field<&Station3::number, Integer16BE>,
                                   Field<&Station3::readings, VariableArray<ReadingElement>>,
                                   Field<&Station3::name, AsciiString>>;

TEST(DataElements, NumbersHaveTheOrderOfTheirRepresentation) {
  expect_layout<Octet>(0x7f, "7f");
  expect_layout<Integer16BE>(-2, "ff fe");
  expect_layout<Integer16LE>(-2, "fe ff");
  expect_layout<Integer32BE>(0x01020304, "01 02 03 04");
  expect_layout<Integer64LE>(1, "01 00 00 00 00 00 00 00");
  expect_layout<Float32BE>(1.0f, "3f 80 00 00");
  expect_layout<Float64LE>(-2.0, "00 00 00 00 00 00 00 c0");
  expect_layout<UnicodeChar>(u'\u20ac', "20 ac");
  expect_layout<Boolean>(true, "00 00 00 01");
  EXPECT_EQ(decode<Boolean>(values_of(std::uint32_t{0x02000000})), std::nullopt);
}

TEST(DataElements, FieldsAreAlignedFromTheRecordsBeginningAndNothingFollowsTheLast) {
  expect_layout<ReadingElement>({0x11, 1.0, 0x0203},
                                "11 00 00 00 00 00 00 00 3f f0 00 00 00 00 00 00 02 03");
  EXPECT_EQ(ReadingElement::boundary, 8u);
}

TEST(DataElements, ArraysAlignTheirElementsBehindTheCount) {
  expect_layout<FixedArray<Integer16BE, 3>>({1, 2, 3}, "00 01 00 02 00 03");
  expect_layout<AsciiString>("Oslo", "00 00 00 04 4f 73 6c 6f");
  expect_layout<UnicodeString>(u"\u00c5s", "00 00 00 02 00 c5 00 73");
  expect_layout<OpaqueData>({}, "00 00 00 00");
  expect_layout<VariableArray<Float64BE>>({1.0}, "00 00 00 01 00 00 00 00 3f f0 00 00 00 00 00 00");
  // An array of texts: each count at a multiple of 4, so 3 octets of padding between, none at the
  // end.
  expect_layout<VariableArray<AsciiString>>(
      {"a", "bc"}, "00 00 00 02 00 00 00 01 61 00 00 00 00 00 00 02 62 63");
}

TEST(DataElements, RecordsOfVaryingSizeAlignWhatFollows) {
  expect_layout<StationElement>(
      {0x0102, {{1, 1.0, 2}, {3, -1.0, 4}}, "x"},
      "01 02 00 00 00 00 00 00 "  // number, then the array at a multiple of 8
      "00 00 00 02 00 00 00 00 "  // its count, then its elements at multiples of 8
      "01 00 00 00 00 00 00 00 3f f0 00 00 00 00 00 00 00 02 00 00 00 00 00 00 "
      "03 00 00 00 00 00 00 00 bf f0 00 00 00 00 00 00 00 04 "  // nothing behind the last
      "00 00 00 00 00 01 78");  // 2 up to a multiple of 4, the text's count, the text
  expect_layout<StationElement>({0, {}, ""}, "00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
}

enum class Kind : std::int32_t { none = 0, depth = 1, words = 2, place = 3, other = 9 };
using KindElement = Enumerated<Kind, Integer32BE>;
using Report = VariantRecord<KindElement, Alternative<Float64BE, Kind::depth>,
                             Alternative<AsciiString, Kind::words, Kind::place>>;

TEST(DataElements, AlternativesBeginAtTheGreatestBoundaryOfAll) {
  EXPECT_EQ(Report::boundary, 8u);
  Report::Value value{Kind::depth, {}};
  value.alternative.emplace<1>(1.0);
  expect_layout<Report>(value, "00 00 00 01 00 00 00 00 3f f0 00 00 00 00 00 00");
  value = {Kind::place, {}};
  value.alternative.emplace<2>("ab");
  expect_layout<Report>(value, "00 00 00 03 00 00 00 00 00 00 00 02 61 62");
  expect_layout<Report>({Kind::none, {}}, "00 00 00 00");
}

TEST(DataElements, AnAlternativeForAllOthersIsTakenWhereNoneIsNamed) {
  using Any = VariantRecord<Octet, Alternative<Integer16BE, 1>, Alternative<Octet>>;
  Any::Value value{1, {}};
  value.alternative.emplace<1>(std::int16_t{5});
  expect_layout<Any>(value, "01 00 00 05");
  value = {7, {}};
  value.alternative.emplace<2>(std::uint8_t{5});
  expect_layout<Any>(value, "07 00 05");
}

/// The number of elements is a stranger's: it claims no memory that the bytes do not have.
TEST(DataElements, ACountBeyondTheBytesIsRefusedAtOnce) {
  EXPECT_EQ(decode<OpaqueData>(values_of(std::uint32_t{0xffffff7f})), std::nullopt);
  EXPECT_EQ(decode<OpaqueData>(values_of(std::uint32_t{0x000000ff})), std::nullopt) << "negative";
  EXPECT_EQ((decode<VariableArray<StationElement>>(values_of(std::uint32_t{0xffffff7f}))),
            std::nullopt);
}

TEST(DataElements, NoBytesMakeADecoderReadBeyondThem) {
  std::mt19937 random(1);
  std::size_t read = 0;
  for (int i = 0; i < 20'000; ++i) {
    // For the most part zeros and small counts, so that some are values.
    std::vector<std::byte> bytes(random() % 48);
    for (std::byte& each : bytes)
      each = static_cast<std::byte>(random() % 16 == 0 ? random() % 4 : 0);
    if (const auto station = decode<StationElement>(bytes)) {
      ++read;
      EXPECT_EQ(decode<StationElement>(encode<StationElement>(*station)), station);
    }
    if (const auto report = decode<Report>(bytes)) {
      EXPECT_EQ(encode<Report>(*report).size(), bytes.size());
    }
  }
  EXPECT_GT(read, 0u);
}

/// The sizes by which the RTI checks values are those of what is encoded.
TEST(DataElements, TheModelsReaderFindsTheSameSizes) {
  const Fom fom = Fom::parse(
      "<objectModel><objects><objectClass><name>HLAobjectRoot</name><objectClass><name>Buoy</name>"
      "<attribute><name>reading</name><dataType>Reading</dataType></attribute>"
      "<attribute><name>readings</name><dataType>Readings</dataType></attribute>"
      "<attribute><name>flags</name><dataType>Flags</dataType></attribute>"
      "</objectClass></objectClass></objects><dataTypes><arrayDataTypes>"
      "<arrayData><name>Readings</name><dataType>Reading</dataType><cardinality>3</cardinality>"
      "<encoding>HLAfixedArray</encoding></arrayData>"
      "<arrayData><name>Flags</name><dataType>HLAboolean</dataType><cardinality>5</cardinality>"
      "<encoding>HLAfixedArray</encoding></arrayData></arrayDataTypes><fixedRecordDataTypes>"
      "<fixedRecordData><name>Reading</name><encoding>HLAfixedRecord</encoding>"
      "<field><name>kind</name><dataType>HLAoctet</dataType></field>"
      "<field><name>level</name><dataType>HLAfloat64BE</dataType></field>"
      "<field><name>count</name><dataType>HLAinteger16BE</dataType></field>"
      "</fixedRecordData></fixedRecordDataTypes></dataTypes></objectModel>",
      "buoy.xml");
  const std::vector<Attribute>& attributes = fom.at(*fom.object_class("Buoy")).attributes;
  EXPECT_EQ(attributes[0].size, encode<ReadingElement>({}).size());
  EXPECT_EQ(attributes[1].size, (encode<FixedArray<ReadingElement, 3>>({}).size()));
  EXPECT_EQ(attributes[2].size, (encode<FixedArray<Boolean, 5>>({}).size()));
}

}  // namespace
}  // namespace rink::rti::testing
