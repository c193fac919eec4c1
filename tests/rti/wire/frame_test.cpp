// Frames found in a stream, whole or cut, one at a time or all at once.
#include "rti/wire/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace rink::rti::testing {
namespace {

using Payload = std::vector<std::byte>;

/// Payloads of 1 to 40 bytes, and the stream that carries them.
struct FrameStream {
  std::vector<Payload> payloads;
  std::vector<std::byte> bytes;
  explicit FrameStream(std::mt19937& random) {
    FrameWriter writer(1);  // so that each message has a frame of its own
    for (int i = 0; i < 20; ++i) {
      Payload& payload = payloads.emplace_back(1 + random() % 40);
      for (std::byte& each : payload) each = static_cast<std::byte>(random());
      std::vector<std::byte>& end = writer.begin_message(payload.size());
      end.insert(end.end(), payload.begin(), payload.end());
      writer.appended();
    }
    bytes.assign(writer.bytes().begin(), writer.bytes().end());
  }
};

TEST(Frames, AreTheSameHoweverTheStreamIsCutAndHoweverTheyAreTaken) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const FrameStream stream(random);
    std::vector<Payload> together, singly;
    FrameReader all, one;
    for (Bytes left = stream.bytes; !left.empty();) {
      const Bytes part = left.first(std::min<std::size_t>(left.size(), 1 + random() % 60));
      left = left.subspan(part.size());
      EXPECT_EQ(
          all.receive(
              part, [] { return 40; },
              [&](Bytes each) { return together.emplace_back(each.begin(), each.end()), true; }),
          Framing::sound);
      for (Bytes rest = part, payload; !rest.empty();) {
        ASSERT_EQ(one.next(rest, 40, payload), Framing::sound);
        if (!payload.empty()) singly.emplace_back(payload.begin(), payload.end());
      }
    }
    EXPECT_EQ(together, stream.payloads);
    EXPECT_EQ(singly, stream.payloads);
  }
}

TEST(Frames, OneAtATimeLeavesWhatFollows) {
  std::mt19937 random(1);
  const FrameStream stream(random);
  FrameReader reader;
  Bytes left = stream.bytes, payload;
  ASSERT_EQ(reader.next(left, 40, payload), Framing::sound);
  EXPECT_TRUE(std::ranges::equal(payload, stream.payloads[0]));
  EXPECT_EQ(left.size(), stream.bytes.size() - frame_header_size - stream.payloads.front().size());
}

TEST(Frames, EmptyAndOversizedOnesAreRefusedByTheirHeaders) {
  for (const std::size_t cut : {1u, 2u, 4u}) {
    for (const int length : {0, 9}) {
      const std::vector<std::byte> header{static_cast<std::byte>(length), {}, {}, {}};
      FrameReader reader;
      Bytes first = Bytes(header).first(cut), rest = Bytes(header).subspan(cut), payload;
      Framing framing = reader.next(first, 8, payload);
      if (framing == Framing::sound) framing = reader.next(rest, 8, payload);
      EXPECT_EQ(framing, length == 0 ? Framing::empty : Framing::oversized);
      EXPECT_TRUE(payload.empty());
    }
  }
}

}  // namespace
}  // namespace rink::rti::testing
