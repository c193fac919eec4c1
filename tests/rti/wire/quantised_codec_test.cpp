// Values whose types state a range and a resolution: how few bits they take, how near they stay,
// and how models that cannot be meant are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/rti/scenes/fjord_traffic.h"

#include "rti/fom/quantised_codec.h"

namespace rink::rti::testing {
namespace {

std::vector<std::byte> light_of(double x, double y, double energy, std::int32_t colour,
                                std::int16_t below) {
  return values_of(x, y, energy, colour, below);
}

template <class Number>
Number number_at(Bytes bytes, std::size_t at, bool is_big_endian = false) {
  std::vector<std::byte> part(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                              bytes.begin() + static_cast<std::ptrdiff_t>(at + sizeof(Number)));
  if (is_big_endian) part = reversed(part);
  Number number;
  std::memcpy(&number, part.data(), sizeof number);
  return number;
}

const AttributeCodec& codec_of(ObjectClassHandle object_class, AttributeHandle attribute) {
  return *fjord().at(object_class).attributes[attribute.value].codec;
}

std::vector<std::byte> coded(const AttributeCodec& codec, Bytes value) {
  std::vector<std::byte> bytes;
  codec.encode(value, 0.0, bytes);
  EXPECT_EQ(codec.size(bytes), bytes.size());
  return bytes;
}
std::vector<std::byte> decoded(const AttributeCodec& codec, Bytes bytes) {
  std::vector<std::byte> value;
  EXPECT_TRUE(codec.decode(bytes, 0.0, value));
  return value;
}

TEST(QuantisedCodec, BelongsToTypesThatStateARangeAndAResolution) {
  EXPECT_NE(fjord().at(boat).attributes[track.value].codec, nullptr);
  EXPECT_EQ(fjord().at(boat).attributes[cargo.value].codec, nullptr)
      << "a double without a range travels in full";
  EXPECT_NE(fjord().at(boat).attributes[track.value].baselines, nullptr)
      << "periodic, and quantised throughout";
  EXPECT_EQ(fjord().at(beacon).attributes[light.value].baselines, nullptr)
      << "its energy is not quantised";
  EXPECT_EQ(fjord().at(beacon).attributes[depth.value].baselines, nullptr) << "not periodic";
  for (const ObjectClass& each : harbour().object_classes())
    for (const Attribute& attribute : each.attributes) EXPECT_EQ(attribute.codec, nullptr);
}

TEST(QuantisedCodec, TakesTheBitsThatRangesAndResolutionsAskFor) {
  // 3,000 m in steps of 2^-10 m: 22 bits; 60 m/s in steps of 2^-7 m/s: 13 bits; 11,001 whole
  // metres: 14 bits. One bit before them, and whole bytes at the end.
  const auto bytes_for = [](unsigned bits) { return (bits + 7u) / 8u; };
  EXPECT_EQ(coded(codec_of(boat, track), track_of(1.0, 2.0, 3.0f, 4.0f)).size(),
            bytes_for(1 + 2 * 22 + 2 * 13));
  EXPECT_EQ(coded(codec_of(beacon, light), light_of(1.0, 2.0, 3.0, 4, -5)).size(),
            bytes_for(1 + 2 * 22 + 64 + 32 + 14));
  EXPECT_EQ(coded(codec_of(beacon, depth), values_of(std::int16_t{-5})).size(), bytes_for(1 + 14));
}

TEST(QuantisedCodec, StaysWithinHalfTheResolutionAndNeverRoundsTwice) {
  for (unsigned seed = 1; seed <= 5000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const double x = seed % 50 == 0 ? -500.0 : between(random, -500.0, 2500.0),
                 y = seed % 51 == 0 ? 2500.0 : between(random, -500.0, 2500.0);
    const auto along = static_cast<float>(between(random, -30.0, 30.0)),
               across = static_cast<float>(between(random, -30.0, 30.0));
    const auto value =
        decoded(codec_of(boat, track), coded(codec_of(boat, track), track_of(x, y, along, across)));
    EXPECT_LE(std::abs(number_at<double>(value, 0) - x), 0.0005);
    EXPECT_LE(std::abs(number_at<double>(value, 8) - y), 0.0005);
    EXPECT_LE(std::abs(number_at<float>(value, 16, true) - along), 0.005f);
    EXPECT_LE(std::abs(number_at<float>(value, 20, true) - across), 0.005f);
    EXPECT_EQ(decoded(codec_of(boat, track), coded(codec_of(boat, track), value)), value);
    const double energy = std::bit_cast<double>(random());
    const auto colour = static_cast<std::int32_t>(random());
    const auto below = static_cast<std::int16_t>(-static_cast<int>(random() % 11'001));
    const auto shown =
        decoded(codec_of(beacon, light),
                coded(codec_of(beacon, light), light_of(x, y, energy, colour, below)));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(number_at<double>(shown, 16)),
              std::bit_cast<std::uint64_t>(energy))
        << "bit exact";
    EXPECT_EQ(number_at<std::int32_t>(shown, 24), colour);
    EXPECT_EQ(number_at<std::int16_t>(shown, 28), below)
        << "whole numbers in steps of one are exact";
  }
}

TEST(QuantisedCodec, SendsInFullWhatIsOutOfItsRange) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinite = std::numeric_limits<double>::infinity();
  for (const double x : {-500.1, 2501.0, 1e300, -infinite, infinite, nan}) {
    const auto value = track_of(x, 1.23456789, 0.1f, -1e30f);
    const auto bytes = coded(codec_of(boat, track), value);
    EXPECT_EQ(bytes.size(), value.size() + 1);
    EXPECT_EQ(decoded(codec_of(boat, track), bytes), value) << "every bit of it";
  }
}

TEST(QuantisedCodec, RefusesWhatNoFederateWrites) {
  const AttributeCodec& codec = codec_of(boat, track);
  std::vector<std::byte> value;
  EXPECT_EQ(codec.size({}), std::nullopt);
  const auto bytes = coded(codec, track_of(1.0, 2.0, 3.0f, 4.0f));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(codec.decode(Bytes(bytes).first(size), 0.0, value));
  auto padded = bytes;
  padded.back() |= std::byte{0x80};  // 71 bits are said, the 72nd is 0
  EXPECT_FALSE(codec.decode(padded, 0.0, value));
  std::vector<std::byte> ones(bytes.size(), std::byte{0xff});
  ones[0] = std::byte{0xfe};
  EXPECT_FALSE(codec.decode(ones, 0.0, value)) << "beyond the range";
  for (unsigned seed = 1; seed <= 5000; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<std::byte> noise(random() % 30);
    for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
    value.clear();
    const auto size = codec.size(noise);
    if (!size || *size > noise.size() || !codec.decode(Bytes(noise).first(*size), 0.0, value))
      continue;
    EXPECT_EQ(value.size(), 24u) << "seed " << seed;
  }
}

std::string complaint(const std::string& from, const std::string& to) {
  std::string text = fjord_xml;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  try {
    Fom::parse(text, "fjord.xml");
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

TEST(QuantisedCodec, ModelsThatCannotBeMeantAreRefusedByLineAndElement) {
  EXPECT_EQ(complaint("<resolution>0.001</resolution>", ""),
            "fjord.xml:19: <simpleData> 'Place' has a range, so its <resolution> must be a number "
            "above 0 (IEEE 1516.2-2010, 4.13)");
  EXPECT_EQ(complaint("0.001", "fine"),
            "fjord.xml:19: <simpleData> 'Place' has a range, so its <resolution> must be a number "
            "above 0 (IEEE 1516.2-2010, 4.13)");
  EXPECT_EQ(complaint("0.001", "-1"),
            "fjord.xml:19: <simpleData> 'Place' has a range, so its <resolution> must be a number "
            "above 0 (IEEE 1516.2-2010, 4.13)");
  EXPECT_EQ(complaint("range -500 2500", "range -500"),
            "fjord.xml:19: <simpleData> 'Place' has a note 'range -500'; expected 'range LOW "
            "HIGH', two numbers (IEEE 1516.2-2010, 4.13)");
  EXPECT_EQ(complaint("range -500 2500", "range 5 5"),
            "fjord.xml:19: <simpleData> 'Place' has a range and resolution that its representation "
            "cannot hold (IEEE 1516.2-2010, 4.13)");
  EXPECT_EQ(complaint("0.01<", "1e-9<"),
            "fjord.xml:20: <simpleData> 'Speed' has a range and resolution that its representation "
            "cannot hold (IEEE 1516.2-2010, 4.13)");
  EXPECT_EQ(complaint("range -11000 0", "range -40000 0"),
            "fjord.xml:21: <simpleData> 'Depth' has a range and resolution that its representation "
            "cannot hold (IEEE 1516.2-2010, 4.13)");
  EXPECT_EQ(
      complaint("<name>Depth</name><representation>HLAinteger16LE",
                "<name>Depth</name><representation>HLAinteger64LE"),
      "fjord.xml:21: <simpleData> 'Depth' has a range, so its <representation> must be "
      "HLAfloat32, HLAfloat64, HLAinteger16 or HLAinteger32, LE or BE (IEEE 1516.2-2010, 4.13)");
  EXPECT_EQ(complaint("rate of x", "rate of z"),
            "fjord.xml:33: <field> 'speedX' is the rate of 'z'; both must be fields of "
            "<fixedRecordData> 'Track' with a range and a resolution (IEEE 1516.2-2010, 4.13)");
}

TEST(QuantisedCodec, IsPartOfTheModelsHash) {
  const auto hash_with = [](const std::string& from, const std::string& to) {
    std::string text = fjord_xml;
    text.replace(text.find(from), from.size(), to);
    return Fom::parse(text, "fjord.xml").hash();
  };
  EXPECT_EQ(hash_with("ofTheFjord</label>", "ofTheFjord</label><!-- the whole of it -->"),
            fjord().hash());
  EXPECT_EQ(hash_with("<resolution>0.001<", "<resolution>0.0011<"), fjord().hash())
      << "in the same steps";
  EXPECT_NE(hash_with("<resolution>0.001<", "<resolution>0.01<"), fjord().hash());
  EXPECT_NE(hash_with("range -30 30", "range -40 40"), fjord().hash());
  EXPECT_NE(hash_with("<updateType>Periodic</updateType>", ""), fjord().hash());
  EXPECT_NE(hash_with("rate of x", "of no matter"), fjord().hash());
}

TEST(QuantisedCodec, FederatesSayAndHearValuesOfTheModel) {
  FederationExecution execution(fjord(), {});
  FederationHost host(execution);
  InProcessNetwork network;
  InProcessEndpoint server(network), clients(network);
  server.listen("rti");
  host.add(server);
  struct Heard : FederateAmbassador {
    std::vector<std::byte> value;
    void reflect_attribute_values(ObjectHandle, AttributeSet, Bytes values, const Stamp&) override {
      value.assign(values.begin(), values.end());
    }
  } heard;
  FederateAmbassador nothing;
  Ambassador speaker(fjord(), nothing), listener(fjord(), heard);
  FederateLink first(speaker, clients, clients.connect("rti")),
      second(listener, clients, clients.connect("rti"));
  FederateLinks links;
  links.add(first), links.add(second);
  const auto round = [&] {
    links.flush(0.0), host.poll({}), host.match(), host.flush(), clients.poll({}, links);
  };
  speaker.join("rink", "speaker", "tester"), listener.join("rink", "listener", "tester");
  speaker.publish_object_class_attributes(beacon, {light, depth});
  listener.subscribe_object_class_attributes(beacon, {light, depth});
  for (int i = 0; i < 3; ++i) round();
  const ObjectHandle object = speaker.register_object_instance(beacon);
  auto values = light_of(-500.0, 0.5, -0.1, 7, -8);
  std::ranges::copy(values_of(std::int16_t{-11'000}), std::back_inserter(values));
  speaker.update_attribute_values(object, {light, depth}, values, {1.0, 0});
  for (int i = 0; i < 3; ++i) round();
  EXPECT_EQ(heard.value, values) << "all of it is on the grid";
}

}  // namespace
}  // namespace rink::rti::testing
