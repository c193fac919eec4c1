// The frames between peers: as the RTI's, whole however they are cut, broken by what is none.
#include "game/net/peer/network/frames.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rink::game {
namespace {

TEST(PeerFrames, AreThoseOfTheRti) {
  const std::vector<std::uint8_t> content{1, 2, 3};
  rti::FrameWriter writer(100);
  std::vector<std::byte>& message = writer.begin_message(4);
  message.push_back(static_cast<std::byte>(FrameKind::mail));
  for (const std::uint8_t byte : content) message.push_back(static_cast<std::byte>(byte));
  writer.appended();
  EXPECT_TRUE(std::ranges::equal(framed(FrameKind::mail, content), writer.bytes()));
}

TEST(PeerFrames, OfNewcomersAndRefusalsHaveTheFormThatEveryVersionReads) {
  for (const FrameKind kind : {FrameKind::hello, FrameKind::refusal}) {
    const std::vector<std::byte> frame = framed(kind, std::vector<std::uint8_t>{1, 2});
    const std::byte head[] = {std::byte{3}, {}, {}, {}, static_cast<std::byte>(kind)};
    EXPECT_TRUE(std::ranges::equal(rti::Bytes(frame).first(5), head));
  }
  // What a peer of version 13 refuses one of version 14 with.
  const std::string reason = "it speaks version 14 of the peers' protocol, here it is version 13";
  std::vector<std::uint8_t> bytes{0x50, 0, 0, 0, 3, 0, 0x42, 0, 0, 0};
  bytes.insert(bytes.end(), reason.begin(), reason.end());
  for (const unsigned each : {0x7bu, 0x81u, 0xd2u, 0xe6u, 0x87u, 0x2bu, 0x07u, 0xddu})
    bytes.push_back(static_cast<std::uint8_t>(each));
  FrameQueue frames;
  frames.add(std::as_bytes(std::span(bytes)));
  const std::optional<Frame> frame = frames.next(stranger_frame_max);
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->kind, FrameKind::refusal);
  const auto refused = message_from<Refused>(frame->content);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->kind, RefusalKind::wrong_version);
  EXPECT_EQ(refused->reason, reason);
}

TEST(PeerFrames, ComeWholeHoweverTheyAreCutAndWaitUntilTheyAreTaken) {
  std::vector<std::byte> stream = framed(FrameKind::hello, std::vector<std::uint8_t>(300, 7));
  for (const std::byte byte : framed(FrameKind::sign, {})) stream.push_back(byte);
  for (const std::size_t cut : {1u, 4u, 5u, 305u, 306u, 308u}) {
    FrameQueue frames;
    const rti::Bytes all(stream);
    frames.add(all.first(cut));
    std::optional<Frame> first = frames.next(1000);
    frames.add(all.subspan(cut));
    if (!first) first = frames.next(1000);
    ASSERT_TRUE(first) << "cut at " << cut;
    EXPECT_EQ(first->content, std::vector<std::uint8_t>(300, 7));
    const std::optional<Frame> second = frames.next(1000);
    ASSERT_TRUE(second) << "cut at " << cut;
    EXPECT_EQ(second->kind, FrameKind::sign);
    EXPECT_FALSE(frames.next(1000) || frames.is_broken());
  }
}

TEST(PeerFrames, AreKeptWhenTheirBytesEndBeforeTheyAreTaken) {
  FrameQueue frames;
  for (std::uint8_t number = 0; number < 3; ++number) {
    std::vector<std::byte> bytes = framed(FrameKind::mail, std::vector<std::uint8_t>{number});
    frames.add(bytes);
    if (number == 0) {
      EXPECT_TRUE(frames.next(1000));
    }
    EXPECT_EQ(frames.waiting_bytes(), number * bytes.size());
    frames.keep();
    std::ranges::fill(bytes, std::byte{});
  }
  EXPECT_EQ(frames.next(1000)->content, std::vector<std::uint8_t>{1});
  EXPECT_EQ(frames.next(1000)->content, std::vector<std::uint8_t>{2});
  EXPECT_FALSE(frames.next(1000) || frames.is_broken());
}

TEST(PeerFrames, BreakAtALengthOfNoneOrTooMuchAndAtAKindThatIsNone) {
  const auto is_broken = [](const std::vector<std::uint8_t>& bytes) {
    FrameQueue frames;
    frames.add(std::as_bytes(std::span(bytes)));
    return !frames.next(100) && frames.is_broken() && !frames.next(100);
  };
  EXPECT_TRUE(is_broken({0, 0, 0, 0, 0}));
  EXPECT_TRUE(is_broken({101, 0, 0, 0}));
  EXPECT_TRUE(is_broken({1, 0, 0, 0, static_cast<std::uint8_t>(frame_kind_max) + 1}));
  EXPECT_TRUE(is_broken({0, 0, 5}));
  EXPECT_TRUE(is_broken({101, 0, 5}));
  EXPECT_TRUE(is_broken({0, 0x80, 1, 0}));
  EXPECT_TRUE(is_broken({1, 0, static_cast<std::uint8_t>(frame_kind_max) + 1}));
  EXPECT_TRUE(is_broken({2, 0, 0, 0, static_cast<std::uint8_t>(FrameKind::mail), 7}))
      << "only what other versions read has the older form";
  EXPECT_TRUE(is_broken({3, 0, static_cast<std::uint8_t>(FrameKind::hello), 'R', 'i'}));
  EXPECT_FALSE(is_broken({100, 0, 0, 0}));
  EXPECT_FALSE(is_broken({100, 0, 5}));
}

}  // namespace
}  // namespace rink::game
