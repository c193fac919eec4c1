// Blocks of residuals, read back, and forged.
#include <gtest/gtest.h>

#include <cstring>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "rti/ambassador.h"
#include "rti/baselines/residual_bits.h"
#include "rti/wire/frame.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/object_messages.h"
#include "tests/net/rink_model.h"

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
  template <class Message>
  static Values framed(Message message) {
    Values frame(rti::frame_header_size);
    rti::write(frame, message);
    const auto length = static_cast<std::uint32_t>(frame.size() - rti::frame_header_size);
    std::memcpy(frame.data(), &length, sizeof length);
    return frame;
  }
  bool takes(std::uint32_t handle, bool is_known, const Values& bits,
             std::optional<std::uint32_t> size = std::nullopt) {
    Values frame(rti::frame_header_size);
    const auto object_class = static_cast<std::uint16_t>(rink_model().entity.value);
    rti::DiscoverObjectMessage discovery{handle, object_class, ""};
    rti::StampMessage stamp{{10.0, 1}};
    rti::ResidualsMessage residuals{object_class,
                                    size.value_or(static_cast<std::uint32_t>(bits.size()))};
    if (is_known) rti::write(frame, discovery);
    rti::write(frame, stamp);
    rti::write(frame, residuals);
    frame.insert(frame.end(), bits.begin(), bits.end());
    const auto length = static_cast<std::uint32_t>(frame.size() - rti::frame_header_size);
    std::memcpy(frame.data(), &length, sizeof length);
    return ambassador.receive(frame);
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
    writer.bits(0u, rti::gap_order_bits);
    rti::exchange_handle(writer, cursor, object);
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
