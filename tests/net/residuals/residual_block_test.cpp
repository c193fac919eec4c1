// Blocks of residuals, read back, and forged.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "game/replication/attributes.h"
#include "game/replication/trajectory.h"
#include "rti/ambassador.h"
#include "rti/baselines/residual_bits.h"
#include "rti/baselines/residual_model.h"
#include "rti/wire/frame.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/object_messages.h"
#include "tests/net/rink_model.h"
#include "tests/places.h"

namespace rink::game::residuals {
namespace {

using Values = std::vector<std::byte>;

/// A frame by hand, for a federate that has discovered an entity.
struct Forged {
  rti::FederateAmbassador callbacks;
  rti::Ambassador ambassador{rink_fom(), callbacks};
  Forged() {
    ambassador.join("rink", "watcher", "");
    EXPECT_TRUE(ambassador.receive(framed(rti::JoinedMessage{4, 1})));
  }
  static Values in_frame(const Values& payload) {
    Values frame(rti::frame_head_size(payload.size()));
    rti::write_frame_head(frame.data(), payload.size());
    frame.insert(frame.end(), payload.begin(), payload.end());
    return frame;
  }
  template <class Message>
  static Values framed(Message message) {
    Values payload;
    rti::write(payload, message);
    return in_frame(payload);
  }
  bool takes(std::uint32_t handle, bool is_known, const Values& bits,
             std::optional<std::uint32_t> size = std::nullopt) {
    Values payload;
    const auto object_class = static_cast<std::uint16_t>(rink_model().entity.value);
    rti::DiscoverObjectMessage discovery{handle, object_class, ""};
    rti::StampMessage stamp{{10.0, 1}};
    rti::ResidualsMessage residuals{object_class,
                                    size.value_or(static_cast<std::uint32_t>(bits.size()))};
    if (is_known) rti::write(payload, discovery);
    rti::write(payload, stamp);
    rti::write(payload, residuals);
    payload.insert(payload.end(), bits.begin(), bits.end());
    return ambassador.receive(in_frame(payload));
  }
};

TEST(ResidualBlock, ResidualOfWhatNeverCameEndsTheConnectionAndIsCounted) {
  constexpr std::uint32_t handle = 70u << 18 | 5u;
  Values bits;
  {
    rti::BitWriter writer(bits);
    rti::ResidualCursor cursor{rti::AttributeSet{rink_model().input, rink_model().trajectory}};
    std::uint32_t object = handle;
    rti::AttributeSet set{rink_model().input};
    writer.bits(0u, 2 * rti::gap_order_bits);
    rti::exchange_handle(writer, cursor, object);
    writer.flag(false);
    rti::exchange_attributes(writer, cursor, set);
    writer.bits(1u, 4);
  }
  Forged without;
  EXPECT_FALSE(without.takes(handle, true, bits));
  EXPECT_EQ(without.ambassador.counters().residuals_refused, 1u);
  EXPECT_FALSE(Forged().takes(handle, false, bits)) << "an unknown object";
  EXPECT_FALSE(Forged().takes(handle, true, bits, 1u << 30)) << "a great size";
  EXPECT_FALSE(Forged().takes(handle, true, {})) << "an empty block";
  EXPECT_FALSE(Forged().takes(handle, true, Values(9, std::byte{0}))) << "a gap without end";
}

/// Two bodies of one shape hit each other shortly before the stamp: one record and its companion.
TEST(ResidualBlock, PageHasAWorkedExampleOfTwoBodiesThatHitEachOther) {
  const std::string example = "20 5a c0 a3 14 08 ff c0 af 02";
  std::ostringstream page;
  page << std::ifstream(test::source_folder() + "/docs/wire.md").rdbuf();
  EXPECT_NE(page.str().find(example), std::string::npos);
  const rti::ResidualModel model(rink_fom());
  const auto object_class = static_cast<std::uint16_t>(rink_model().entity.value);
  const rti::AttributeSet set{rink_model().trajectory};
  Values values;
  const auto held = [&](double x, double speed) {
    rti::FormerValues former;
    const Trajectory t{.time = 9.0, .position = {x, 2.0}, .velocity = {speed, 0.0}};
    model.keep(object_class, {rink_model().shape, rink_model().trajectory},
               encode(values, Shape{.mass = 0.2f}, t), former);
    return former;
  };
  rti::FormerValues first = held(1.0, 0.5), second = held(2.0, -0.25);
  std::istringstream text(example);
  Values bytes;
  for (std::string each; text >> each;)
    bytes.push_back(static_cast<std::byte>(std::stoi(each, nullptr, 16)));
  rti::BitReader bits(bytes);
  rti::ResidualCursor cursor{model.residual(object_class)};
  std::uint32_t handle = 0;
  bool has_companion = false;
  rti::AttributeSet attributes;
  ASSERT_TRUE(bits.bits(cursor.order, 4) && bits.bits(cursor.companion_order, 4));
  ASSERT_TRUE(rti::exchange_handle(bits, cursor, handle) && bits.flag(has_companion) &&
              rti::exchange_attributes(bits, cursor, attributes));
  EXPECT_EQ(handle, (1u << 18) + 5u);
  EXPECT_TRUE(has_companion);
  EXPECT_EQ(attributes, set);
  rti::FormerChange change{set, first, {}};
  rti::ResidualUpdate update{object_class, set, 10.0};
  const auto next = [&](rti::FormerValues& former) {
    Trajectory t;
    values.clear();
    EXPECT_TRUE(model.decode(update, former, bits, values) && decode(values, t));
    return t;
  };
  const double instant = 10.0 - 8.0 / 1024.0;
  EXPECT_EQ(
      next(first),
      (Trajectory{.time = instant, .position = {3065.0 / 2048.0, 2.0}, .velocity = {-0.25, 0.0}}));
  change.after = first.bytes;
  update.companion = &change;
  ASSERT_TRUE(rti::exchange_companion(bits, cursor, handle) &&
              rti::exchange_attributes(bits, cursor, attributes));
  EXPECT_EQ(handle, (1u << 18) + 7u);
  EXPECT_EQ(
      next(second),
      (Trajectory{.time = instant, .position = {3588.0 / 2048.0, 2.0}, .velocity = {0.5, 0.0}}));
  EXPECT_TRUE(rti::is_block_end(bits));
}

TEST(ResidualBlock, HandlesAndAttributesOfABlockAreReadBack) {
  const unsigned seed = 9;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int i = 0; i < 2000; ++i) {
    const rti::AttributeSet residual(0b10110u);
    rti::ResidualCursor writing{residual, static_cast<unsigned>(random() % 16)}, reading = writing;
    std::vector<std::pair<std::uint32_t, rti::AttributeSet>> sent;
    Values bits;
    {
      rti::BitWriter writer(bits);
      auto handle = static_cast<std::uint32_t>(random() >> (random() % 3 == 0 ? 32 : 38));
      for (int k = 0; k < 8; ++k) {
        rti::AttributeSet set(static_cast<std::uint32_t>(random()) & residual.bits);
        if (set.is_empty()) set = residual;
        rti::exchange_handle(writer, writing, handle);
        rti::exchange_attributes(writer, writing, set);
        sent.emplace_back(handle, set);
        const std::uint32_t gap = static_cast<std::uint32_t>(random() % 5000) + 1;
        if (handle > 0xffffffffu - gap) break;
        handle += gap;
      }
    }
    rti::BitReader reader(bits);
    for (const auto& [handle, set] : sent) {
      std::uint32_t read = 0;
      rti::AttributeSet attributes;
      ASSERT_TRUE(rti::exchange_handle(reader, reading, read));
      ASSERT_TRUE(rti::exchange_attributes(reader, reading, attributes));
      ASSERT_EQ(read, handle);
      ASSERT_EQ(attributes, set);
    }
    ASSERT_TRUE(rti::is_block_end(reader));
  }
}

}  // namespace
}  // namespace rink::game::residuals
