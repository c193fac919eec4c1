// Every message: what is written is what is read, as long as it was measured, and nothing less is
// accepted.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "rti/wire/declaration_messages.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/fom_messages.h"
#include "rti/wire/management_messages.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/message.h"
#include "rti/wire/object_messages.h"
#include "rti/wire/region_messages.h"
#include "rti/wire/save_messages.h"
#include "rti/wire/update_block.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

/// Random fields from one seed.
struct Dice {
  std::mt19937_64 random;
  std::deque<std::string> words;  ///< a deque: views into earlier ones stay valid
  std::vector<std::byte> bytes;

  template <class Number>
  Number number() {
    return static_cast<Number>(random());
  }
  std::string_view text() {
    return words.emplace_back(random() % 256, static_cast<char>('a' + random() % 26));
  }
  Bytes some(std::size_t size) {
    bytes.resize(size);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    return bytes;
  }
  Stamp stamp() { return {static_cast<double>(random()) / 1e9, random()}; }
  /// Attributes that a declaration may name, by turns of a narrow class and of a wide one.
  AttributeBits declared() {
    AttributeBits bits = random();
    if (random() % 2 == 0) bits = bits << 63 | random();
    else bits &= 0x7fffffffu;
    return bits & ~(AttributeBits{1} << privilege_to_delete_object.value);
  }
};

template <class Message>
void expect_round_trip(Message message) {
  std::vector<std::byte> written, again;
  write(written, message);
  EXPECT_EQ(measure(message), written.size());
  const Bytes body = Bytes(written).subspan(1);
  Message read;
  Reader reader(body);
  ASSERT_TRUE(exchange(reader, read));
  EXPECT_TRUE(reader.is_at_end());
  write(again, read);
  EXPECT_EQ(again, written);
  for (std::size_t size = 0; size < body.size(); ++size) {
    Reader truncated(body.first(size));
    ASSERT_FALSE(exchange(truncated, read))
        << "cut to " << size << " of " << body.size() << " bytes";
  }
}

TEST(Message, ReadsBackAsItWasWrittenAndNeverFromLess) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Dice dice{std::mt19937_64(seed), {}, {}};
    const auto u32 = [&] { return dice.number<std::uint32_t>(); };
    const auto u16 = [&] { return dice.number<std::uint16_t>(); };
    JoinMessage join;
    join.fom_hash = dice.number<std::uint64_t>();
    join.federation = join.name = join.type = dice.text();
    expect_round_trip(join);
    expect_round_trip(PublishObjectClassMessage{u16(), dice.declared()});
    expect_round_trip(SubscribeObjectClassMessage{u16(), dice.declared(), u32()});
    expect_round_trip(PublishInteractionClassMessage{u16(), static_cast<std::uint8_t>(u16() % 2)});
    expect_round_trip(DiscoverObjectMessage{u32(), u16(), dice.text()});
    expect_round_trip(RemoveObjectMessage{u32()});
    expect_round_trip(StampMessage{dice.stamp()});
    expect_round_trip(UpdatesMessage{u16(), u32()});
    expect_round_trip(InteractionMessage{u16(), u32(), dice.stamp(), dice.some(u32() % 300)});
    const auto regions = static_cast<std::uint16_t>(u32() % 5);
    expect_round_trip(
        ModifyRegionsMessage{regions, dice.some(regions * ModifyRegionsMessage::record_size)});
    expect_round_trip(AssociateRegionMessage{u32(), u32()});
    expect_round_trip(CreateRegionMessage{u32() % region_max});
    expect_round_trip(JoinedMessage{u32(), u32() % object_block_max});
    expect_round_trip(RefusedMessage{static_cast<std::uint8_t>(u32()), dice.text()});
    expect_round_trip(FederateJoinedMessage{u32(), dice.text(), dice.text()});
    expect_round_trip(FederateResignedMessage{u32(), static_cast<std::uint8_t>(u32() % 3),
                                              dice.text(), dice.text()});
  }
}

TEST(Message, OfRegionsReadsBackAsItWasWrittenAndNeverFromLess) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Dice dice{std::mt19937_64(seed), {}, {}};
    const auto region = dice.number<std::uint32_t>() % region_max;
    const auto object_class = dice.number<std::uint16_t>();
    const auto count = static_cast<std::uint16_t>(dice.number<std::uint32_t>() % 5);
    const std::vector<std::byte> records(count * RegionalClassMessage::pair_size),
        regions(count * sizeof(std::uint32_t)), ranges(count * ModifyRangesMessage::range_size);
    expect_round_trip(CreateRegionOverMessage{region, std::uint64_t{1} << count});
    expect_round_trip(ModifyRangesMessage{region, static_cast<std::uint8_t>(count), ranges});
    expect_round_trip(
        RegionalClassMessage{object_class, static_cast<std::uint8_t>(count % 3), count, records});
    expect_round_trip(RegionalInteractionMessage{object_class, static_cast<std::uint8_t>(count % 2),
                                                 count, regions});
    expect_round_trip(AssociateRegionsMessage{
        dice.number<std::uint32_t>(), static_cast<std::uint8_t>(count % 2), count, records});
    expect_round_trip(
        InteractionWithinMessage{object_class, dice.stamp(), count, regions, dice.some(100)});
    expect_round_trip(ProvideUpdateMessage{dice.number<std::uint32_t>(),
                                           dice.number<std::uint32_t>(), dice.some(count)});
    expect_round_trip(FomDigestMessage{count, records});
  }
}

TEST(Message, OfSavesReadsBackAsItWasWrittenAndNeverFromLess) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Dice dice{std::mt19937_64(seed), {}, {}};
    const auto number = dice.number<std::uint32_t>();
    for (std::uint8_t word = 0; word <= static_cast<std::uint8_t>(SaveWord::query_restore); ++word)
      expect_round_trip(SaveRequestMessage{word, dice.text(), 1.5 * word, number});
    for (std::uint8_t word = 0; word <= static_cast<std::uint8_t>(SaveNotice::not_restored); ++word)
      expect_round_trip(
          SaveNoticeMessage{word, number, dice.text(), 4, 1.5 * word, dice.text(), number});
    expect_round_trip(AmbassadorStateMessage{dice.some(number % 300)});
    expect_round_trip(RestoredMessage{number, 0, 0, dice.some(number % 300)});
    expect_round_trip(RestoredMessage{number, 1, number, dice.some(number % 300)});
    const auto count = static_cast<std::uint16_t>(number % 5);
    expect_round_trip(SaveStatusMessage{static_cast<std::uint8_t>(number % 2), count,
                                        dice.some(count * SaveStatusMessage::record_size)});
  }
}

TEST(Message, OfDeclarationsAndObjectsReadsBackAsItWasWrittenAndNeverFromLess) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Dice dice{std::mt19937_64(seed), {}, {}};
    const auto word = static_cast<std::uint8_t>(dice.number<std::uint32_t>() % 2);
    const auto number = dice.number<std::uint32_t>();
    const AttributeBits bits = dice.declared();
    const auto object_class = dice.number<std::uint16_t>();
    expect_round_trip(ClassRelevanceMessage{word, object_class, bits, number});
    expect_round_trip(ObjectRelevanceMessage{number, bits});
    expect_round_trip(SpareUpdateMessage{number, bits});
    expect_round_trip(AdvisorySwitchMessage{word});
    expect_round_trip(InstanceNamesMessage{word, dice.some(number % 300)});
    expect_round_trip(InstanceNamesAnswerMessage{word, dice.some(number % 300)});
    expect_round_trip(LocalDeleteMessage{number});
    expect_round_trip(RequestUpdateMessage{word, number, bits, dice.some(number % 300)});
    expect_round_trip(ChangeTransportationMessage{word, number, bits, word});
    expect_round_trip(QueryTransportationMessage{word, number, number});
    expect_round_trip(TransportationMessage{word, word, number, bits, word});
  }
}

TEST(Message, OfFederationManagementReadsBackAsItWasWrittenAndNeverFromLess) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Dice dice{std::mt19937_64(seed), {}, {}};
    const auto handles = static_cast<std::uint16_t>(dice.number<std::uint32_t>() % 5);
    const std::vector<std::byte> tag(dice.number<std::uint32_t>() % 100),
        records(handles * sizeof(std::uint32_t));
    expect_round_trip(RegisterSynchronizationPointMessage{dice.text(), tag, {handles, records}});
    expect_round_trip(
        SynchronizationPointAchievedMessage{dice.text(), static_cast<std::uint8_t>(handles % 2)});
    expect_round_trip(
        SynchronizationPointRegisteredMessage{dice.text(), static_cast<std::uint8_t>(handles % 3)});
    expect_round_trip(AnnounceSynchronizationPointMessage{dice.text(), tag});
    expect_round_trip(FederationSynchronizedMessage{dice.text(), {handles, records}});
    expect_round_trip(CreateFederationExecutionMessage{dice.text(), dice.number<std::uint64_t>()});
    expect_round_trip(DestroyFederationExecutionMessage{dice.text()});
    expect_round_trip(
        FederationExecutionCreatedMessage{dice.text(), static_cast<std::uint8_t>(handles)});
    expect_round_trip(
        FederationExecutionMessage{0, dice.text(), dice.text(), dice.number<std::uint32_t>()});
    expect_round_trip(FederationExecutionMessage{1, {}, {}, 0});
    FederationReportMessage report{
        dice.text(), dice.text(), dice.text(), dice.number<std::uint32_t>(), {}};
    for (std::uint64_t& drops : report.drops) drops = dice.number<std::uint64_t>();
    expect_round_trip(report);
    FederateReportMessage federate{dice.number<std::uint32_t>(), dice.text(), dice.text(), {}};
    federate.counts.updates_sent = dice.number<std::uint64_t>();
    federate.counts.regions = dice.number<std::uint32_t>();
    federate.counts.logical_time = 1e9 / (1.0 + static_cast<double>(federate.counts.regions));
    federate.counts.is_time_constrained = 1;
    expect_round_trip(federate);
  }
}

std::size_t size_of(StampMessage message) {
  expect_round_trip(message);
  return measure(message);
}

TEST(Message, StampsLeaveOutTheZerosOfTimeAndTag) {
  EXPECT_EQ(size_of({Stamp{0.0, 0}}), 2u);
  EXPECT_EQ(size_of({Stamp{-0.0, 0}}), 3u);
  EXPECT_EQ(size_of({Stamp{1.0, 1}}), 5u) << "two bytes of the time, one of the tag";
  EXPECT_EQ(size_of({Stamp{299.0 + 1023.0 / 1024.0, 0}}), 6u)
      << "any instant of a match's first 512 s on a grid of 1/1024 s";
  EXPECT_EQ(size_of({Stamp{0.1, ~0ull}}), StampMessage::size_max);
}

TEST(Message, StampsWithImpossibleSizesOrTimesAreRefused) {
  const auto is_read = [](std::vector<unsigned> bytes) {
    std::vector<std::byte> body;
    for (const unsigned byte : bytes) body.push_back(static_cast<std::byte>(byte));
    body.resize(body.size() + 20);
    Reader reader(body);
    Stamp stamp;
    return exchange(reader, stamp);
  };
  EXPECT_TRUE(is_read({0x02, 0xf0, 0x3f})) << "1 s";
  EXPECT_FALSE(is_read({0x02, 0xf0, 0x7f})) << "infinity";
  for (unsigned sizes = 0; sizes < 256; ++sizes)
    EXPECT_EQ(is_read({sizes}), (sizes & 15u) <= 8 && sizes >> 4 <= 8) << sizes;
}

TEST(Message, NumbersTakeOneByteForEachSevenBitsAndReadBackAtEveryPowerOfTwo) {
  for (unsigned bit = 0; bit < 64; ++bit) {
    for (const std::uint64_t value : {(1ull << bit) - 1, 1ull << bit, (1ull << bit) | 1}) {
      std::uint64_t written = value, read = 0;
      std::vector<std::byte> bytes;
      Writer(bytes).varint(written);
      EXPECT_EQ(bytes.size(),
                std::max<std::size_t>(1, (static_cast<std::size_t>(std::bit_width(value)) + 6) / 7))
          << value;
      Reader reader(bytes);
      ASSERT_TRUE(reader.varint(read));
      EXPECT_EQ(read, value);
      EXPECT_TRUE(reader.is_at_end());
      Reader cut(Bytes(bytes).first(bytes.size() - 1));
      EXPECT_FALSE(cut.varint(read));
      std::uint16_t narrow = 0;
      Reader again(bytes);
      EXPECT_EQ(again.varint(narrow), value <= 0xffff)
          << value << ": a number that does not fit is refused, not cut";
    }
  }
}

TEST(UpdateBlock, StepsBetweenAnyTwoHandlesReadBack) {
  std::mt19937 random(3);
  std::vector<std::uint32_t> handles{0, 0xffffffffu, 0, 5, 5, 4, 0x80000000u, 0x7fffffffu};
  for (int i = 0; i < 1000; ++i)
    handles.push_back(static_cast<std::uint32_t>(random() >> random() % 32));
  std::vector<std::byte> bytes;
  {
    RecordWriter writer(bytes);
    for (const std::uint32_t handle : handles) writer.add(handle, {});
  }
  Reader reader(bytes);
  HandleReader back;
  for (const std::uint32_t handle : handles) {
    std::uint32_t read = 0;
    ASSERT_EQ(back.next(reader, read), HandleReader::Next::handle);
    ASSERT_EQ(read, handle);
  }
  std::uint32_t read = 0;
  EXPECT_EQ(back.next(reader, read), HandleReader::Next::end);
  EXPECT_TRUE(reader.is_at_end());
}

TEST(UpdateBlock, AStepBeyondAllHandlesIsMalformedWhereverItStarts) {
  for (const std::uint64_t step :
       {std::uint64_t{1} << 34, ~std::uint64_t{0}, ~std::uint64_t{0} - 1, std::uint64_t{1} << 63}) {
    std::array<std::byte, 2 * varint_size_max> bytes{};
    std::byte* end = put_varint(bytes.data(), handle_step(0, 0xffffffffu));
    end = put_varint(end, step);
    Reader reader(Bytes(bytes.data(), end));
    HandleReader back;
    std::uint32_t read = 0;
    ASSERT_EQ(back.next(reader, read), HandleReader::Next::handle);
    EXPECT_EQ(back.next(reader, read), HandleReader::Next::malformed) << step;
  }
}

TEST(UpdateBlock, RecordsOfAnySizeReadBackAndNoneIsReadFromABlockThatIsCut) {
  const ObjectClass& object_class = harbour().at(ferry);
  const AttributeSet set{speed, destination};
  std::vector<std::byte> bytes;
  std::vector<std::vector<std::byte>> all;
  {
    RecordWriter writer(bytes);
    for (std::size_t size = 0; size < 3000; size += 1 + size / 2) {
      std::vector<std::byte> values = values_of(1.5f);
      const auto town = varying(std::string(size, 'x'));
      values.insert(values.end(), town.begin(), town.end());
      writer.add(static_cast<std::uint32_t>(size), values);
      all.push_back(values);
    }
  }
  std::size_t count = 0;
  Reader reader(bytes);
  EXPECT_TRUE(read_records(reader, object_class, set, [&](std::uint32_t, Bytes values) {
    return std::ranges::equal(values, all[count++]);
  }));
  EXPECT_EQ(count, all.size());
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50) {
    Reader cut(Bytes(bytes).first(size));
    EXPECT_FALSE(read_records(cut, object_class, set, [](std::uint32_t, Bytes) { return true; }))
        << size;
  }
}

}  // namespace
}  // namespace rink::rti::testing
