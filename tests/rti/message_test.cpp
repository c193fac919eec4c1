// Every message: what is written is what is read, as long as it was measured, and nothing less is accepted.
#include <gtest/gtest.h>

#include <random>

#include "rti/message.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

/// Random fields from one seed.
struct Dice {
  std::mt19937_64 random;
  std::deque<std::string> words;  ///< a deque: views into earlier ones stay valid
  std::vector<std::byte> bytes;

  template <class Number>
  Number number() { return static_cast<Number>(random()); }
  std::string_view text() {
    return words.emplace_back(random() % 256, static_cast<char>('a' + random() % 26));
  }
  Bytes some(std::size_t size) {
    bytes.resize(size);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    return bytes;
  }
  Stamp stamp() { return {static_cast<double>(random()) / 1e9, random()}; }
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
    ASSERT_FALSE(exchange(truncated, read)) << "cut to " << size << " of " << body.size() << " bytes";
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
    expect_round_trip(RegisterSynchronizationPointMessage{dice.text()});
    expect_round_trip(PublishObjectClassMessage{u16(), u32()});
    expect_round_trip(SubscribeObjectClassMessage{u16(), u32(), u32()});
    expect_round_trip(PublishInteractionClassMessage{u16(), static_cast<std::uint8_t>(u16() % 2)});
    expect_round_trip(DiscoverObjectMessage{u32(), u16(), dice.text()});
    expect_round_trip(RemoveObjectMessage{u32()});
    const std::uint32_t count = u32() % 20, size = u32() % 30;
    expect_round_trip(UpdatesMessage{u16(), u32(), dice.stamp(), size, count, dice.some(count * (4 + size))});
    expect_round_trip(UpdatesMessage{u16(), u32(), dice.stamp(), UpdatesMessage::varies, count, dice.some(size)});
    expect_round_trip(InteractionMessage{u16(), u32(), dice.stamp(), dice.some(u32() % 300)});
    const auto regions = static_cast<std::uint16_t>(u32() % 5);
    expect_round_trip(ModifyRegionsMessage{regions, dice.some(regions * ModifyRegionsMessage::record_size)});
    expect_round_trip(AssociateRegionMessage{u32(), u32()});
    expect_round_trip(CreateRegionMessage{u32() % region_max});
    expect_round_trip(JoinedMessage{u32(), u32() % object_block_max});
    expect_round_trip(RefusedMessage{static_cast<std::uint8_t>(u32()), dice.text()});
    expect_round_trip(FederateJoinedMessage{u32(), dice.text(), dice.text()});
    expect_round_trip(FederateResignedMessage{u32(), static_cast<std::uint8_t>(u32() % 3), dice.text(), dice.text()});
  }
}

TEST(Message, TheHeaderOfABlockIsThatOfItsMessage) {
  const auto records = values_of(std::uint32_t{5}, 1.0f, 2.0f);
  UpdatesMessage message{3, 1, {1.5, 7}, 8, 1, records};
  std::vector<std::byte> whole, header(UpdatesMessage::header_size);
  write(whole, message);
  write_updates_header(header.data(), 3, AttributeSet(1), {1.5, 7}, 8, 1, static_cast<std::uint32_t>(records.size()));
  EXPECT_TRUE(std::equal(header.begin(), header.end(), whole.begin()));
}

TEST(Message, CountsThatDoNotMatchTheirBytesAreNotBelieved) {
  const auto records = values_of(std::uint32_t{5}, 1.0f, 2.0f);
  for (const std::uint32_t count : {0u, 2u, 0xffffffffu}) {
    std::vector<std::byte> bytes(UpdatesMessage::header_size);
    write_updates_header(bytes.data(), 3, AttributeSet(1), {}, 8, count, static_cast<std::uint32_t>(records.size()));
    bytes.insert(bytes.end(), records.begin(), records.end());
    Reader reader(Bytes(bytes).subspan(1));
    UpdatesMessage message;
    EXPECT_FALSE(exchange(reader, message)) << count;
  }
}

}  // namespace
}  // namespace rink::rti::testing
