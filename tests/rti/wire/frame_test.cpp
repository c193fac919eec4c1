// Frames found in a stream, whole or cut, one at a time or all at once.
#include "rti/wire/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace rink::rti::testing {
namespace {

using Payload = std::vector<std::byte>;

std::vector<std::byte> bytes(std::initializer_list<unsigned> values) {
  std::vector<std::byte> all;
  for (const unsigned value : values) all.push_back(static_cast<std::byte>(value));
  return all;
}

/// The longest payload of a `FrameStream`.
constexpr std::size_t longest = 70'000;

/// Payloads of 1 to 40 bytes and some about as long as a head of two bytes can say, in both forms,
/// and the stream that carries them. Each begins with a kind of message, which is not 0.
struct FrameStream {
  std::vector<Payload> payloads;
  std::vector<FrameForm> forms;
  std::vector<std::byte> bytes;
  explicit FrameStream(std::mt19937& random) {
    FrameWriter writer(longest);
    for (int i = 0; i < 20; ++i) {
      std::size_t size = 1 + random() % 40;
      if (i % 7 == 3) size = short_frame_max - 2 + random() % 5;
      if (i % 7 == 5) size = older_frame_max - random() % 3;
      Payload& payload = payloads.emplace_back(size);
      for (std::byte& each : payload) each = static_cast<std::byte>(random());
      payload.front() |= std::byte{1};
      forms.push_back(random() % 3 == 0 ? FrameForm::older : FrameForm::present);
      writer.open(forms.back());
      std::vector<std::byte>& end = writer.begin_message(payload.size());
      end.insert(end.end(), payload.begin(), payload.end());
      writer.appended();
    }
    bytes.assign(writer.bytes().begin(), writer.bytes().end());
  }
};

TEST(Frames, HaveHeadsOfTwoBytesOfFourIfTheyAreLongAndOfTheOlderFormWhereVersionsMeet) {
  struct Case {
    std::size_t length;
    FrameForm form;
    std::vector<std::byte> head;
  };
  const Case all[] = {{1, FrameForm::present, bytes({1, 0})},
                      {0x1234, FrameForm::present, bytes({0x34, 0x12})},
                      {0x7fff, FrameForm::present, bytes({0xff, 0x7f})},
                      {0x8000, FrameForm::present, bytes({0, 0x80, 1, 0})},
                      {0x12345678, FrameForm::present, bytes({0x78, 0xd6, 0x68, 0x24})},
                      {0x7fffffff, FrameForm::present, bytes({0xff, 0xff, 0xff, 0xff})},
                      {1, FrameForm::older, bytes({1, 0, 0, 0})},
                      {0x8001, FrameForm::older, bytes({1, 0x80, 0, 0})},
                      {0xffff, FrameForm::older, bytes({0xff, 0xff, 0, 0})}};
  for (const Case& each : all) {
    SCOPED_TRACE(each.length);
    std::vector<std::byte> head(frame_head_size(each.length, each.form));
    write_frame_head(head.data(), each.length, each.form);
    EXPECT_EQ(head, each.head);
    for (std::size_t size = 0; size < head.size(); ++size)
      EXPECT_FALSE(read_frame_head(Bytes(head).first(size))) << "cut after " << size;
    head.push_back(std::byte{1});
    const auto read = read_frame_head(head);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->size, each.head.size());
    EXPECT_EQ(read->length, each.length);
    EXPECT_EQ(read->form, each.form);
  }
}

TEST(Frames, GrowBeyondAHeadOfTwoBytesByMessages) {
  FrameWriter writer(longest);
  const std::vector<std::byte> message(short_frame_max - 10, std::byte{7});
  for (int i = 0; i < 3; ++i) {
    std::vector<std::byte>& end = writer.begin_message(message.size());
    end.insert(end.end(), message.begin(), message.end());
    writer.appended();
  }
  EXPECT_EQ(writer.frame_count(), 2u) << "the third has no room";
  FrameReader reader;
  std::vector<std::size_t> sizes;
  EXPECT_EQ(reader.receive(
                writer.bytes(), [] { return longest; },
                [&](Bytes payload) {
                  sizes.push_back(payload.size());
                  return std::ranges::all_of(payload,
                                             [](std::byte b) { return b == std::byte{7}; });
                }),
            Framing::sound);
  EXPECT_EQ(sizes, (std::vector<std::size_t>{2 * message.size(), message.size()}));
}

TEST(Frames, AreTheSameHoweverTheStreamIsCutAndHoweverTheyAreTaken) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const FrameStream stream(random);
    std::vector<Payload> together, singly;
    std::vector<FrameForm> forms;
    FrameReader all, one;
    const bool is_cut_finely = seed % 4 == 0;
    for (Bytes left = stream.bytes; !left.empty();) {
      const Bytes part = left.first(
          std::min<std::size_t>(left.size(), 1 + random() % (is_cut_finely ? 60 : 30'000)));
      left = left.subspan(part.size());
      EXPECT_EQ(all.receive(
                    part, [] { return longest; },
                    [&](Bytes each) {
                      forms.push_back(all.form());
                      return together.emplace_back(each.begin(), each.end()), true;
                    }),
                Framing::sound);
      for (Bytes rest = part, payload; !rest.empty();) {
        ASSERT_EQ(one.next(rest, longest, payload), Framing::sound);
        if (!payload.empty()) singly.emplace_back(payload.begin(), payload.end());
      }
    }
    EXPECT_EQ(together, stream.payloads);
    EXPECT_EQ(singly, stream.payloads);
    EXPECT_EQ(forms, stream.forms);
  }
}

TEST(Frames, OneAtATimeLeavesWhatFollows) {
  std::mt19937 random(1);
  const FrameStream stream(random);
  FrameReader reader;
  Bytes left = stream.bytes, payload;
  ASSERT_EQ(reader.next(left, longest, payload), Framing::sound);
  EXPECT_TRUE(std::ranges::equal(payload, stream.payloads[0]));
  EXPECT_EQ(left.size(), stream.bytes.size() - frame_head_size(1, stream.forms.front()) -
                             stream.payloads.front().size());
}

TEST(Frames, EmptyAndOversizedOnesAreRefusedByTheirHeads) {
  const std::pair<std::vector<std::byte>, Framing> all[] = {
      {bytes({0, 0, 1, 2}), Framing::empty},
      {bytes({0, 0, 0, 0}), Framing::empty},
      {bytes({1, 0, 0, 7}), Framing::empty},  // one zero, which is no message
      {bytes({9, 0, 1, 2}), Framing::oversized},
      {bytes({9, 0, 0, 0}), Framing::oversized},
      {bytes({0, 0x80, 0, 0}), Framing::oversized},
      {bytes({0, 0x80, 1, 0}), Framing::oversized},
      {bytes({255, 255, 255, 255}), Framing::oversized},
  };
  for (const auto& [head, refusal] : all) {
    for (const std::size_t cut : {1u, 2u, 3u, 4u}) {
      FrameReader reader;
      Bytes first = Bytes(head).first(cut), rest = Bytes(head).subspan(cut), payload;
      Framing framing = reader.next(first, 8, payload);
      if (framing == Framing::sound) framing = reader.next(rest, 8, payload);
      EXPECT_EQ(framing, refusal) << static_cast<int>(head[0]) << " cut after " << cut;
      EXPECT_TRUE(payload.empty());
    }
  }
}

}  // namespace
}  // namespace rink::rti::testing
