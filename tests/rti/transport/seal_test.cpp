// What is sealed comes back as it was said, or not at all.
#include "rti/admission/seal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string_view>

#include "rti/wire/frame.h"
#include "tests/rti/rig.h"
#include "tests/rti/seeded.h"

namespace rink::rti::testing {
namespace {

/// Of a short record: the frame's head and the mark.
const std::size_t record_head_size = frame_head_size(1) + 1;

SessionKey key_of(unsigned seed) { return nonce_of(seed); }

std::vector<std::byte> random_bytes(std::mt19937& random, std::size_t size) {
  std::vector<std::byte> bytes(size);
  for (std::byte& each : bytes) each = static_cast<std::byte>(random());
  return bytes;
}

std::vector<std::byte> sealed_of(Seal& seal, Bytes bytes) {
  FrameWriter records(seal_record_max);
  seal.seal(std::span(&bytes, 1), records);
  return {records.bytes().begin(), records.bytes().end()};
}

/// All that `reader` believes of `stream`, which arrives in pieces of random sizes.
std::vector<std::byte> opened_of(SealReader& reader, Bytes stream, std::mt19937& random) {
  FrameReader frames;
  std::vector<std::byte> all, opened;
  bool is_sound = true;
  while (!stream.empty() && is_sound) {
    const Bytes piece = stream.first(std::min<std::size_t>(stream.size(), 1 + random() % 9'000));
    stream = stream.subspan(piece.size());
    is_sound = frames.receive(
                   piece, [] { return seal_record_max; },
                   [&](Bytes record) {
                     if (!reader.open(record, opened)) return false;
                     all.insert(all.end(), opened.begin(), opened.end());
                     return true;
                   }) == Framing::sound;
  }
  return all;
}

TEST(Seals, AreOpenedToWhatWasSaidHoweverItWasCut) {
  std::mt19937 random(1);
  Seal seal(key_of(1));
  SealReader reader(key_of(1));
  std::vector<std::byte> said;
  FrameWriter stream(seal_record_max);
  for (const std::size_t size : {0u, 1u, 100u, 16'384u, 16'385u, 70'000u, 3u, 40'000u}) {
    const std::vector<std::byte> first = random_bytes(random, size),
                                 second = random_bytes(random, size / 3);
    said.insert(said.end(), first.begin(), first.end());
    said.insert(said.end(), second.begin(), second.end());
    const Bytes parts[] = {first, second};
    seal.seal(parts, stream);
  }
  EXPECT_EQ(opened_of(reader, stream.bytes(), random), said);
}

TEST(Seals, HideWhatIsSaidAndThatItIsSaidTwice) {
  Seal seal(key_of(1));
  const std::vector<std::byte> words = bytes_of("a ferry leaves the harbour");
  const std::vector<std::byte> once = sealed_of(seal, words), again = sealed_of(seal, words);
  EXPECT_EQ(std::search(once.begin(), once.end(), words.begin() + 2, words.begin() + 7),
            once.end());
  EXPECT_EQ(once.size(), record_head_size + words.size() + seal_tag_size);
  EXPECT_FALSE(
      std::equal(once.begin() + record_head_size, once.end(), again.begin() + record_head_size))
      << "each record has a number of its own";
}

/// After the first record that is not the next, nothing is believed.
TEST(Seals, AreBrokenByWhateverIsAlteredMissingRepeatedSwappedOrOfAnother) {
  std::mt19937 random(2);
  std::vector<std::vector<std::byte>> records;
  Seal seal(key_of(1)), foreign(key_of(2));
  const std::vector<std::byte> words = bytes_of("keys of the harbour");
  for (int i = 0; i < 4; ++i) records.push_back(sealed_of(seal, words));
  const auto believed = [&](const std::vector<std::vector<std::byte>>& sent) {
    SealReader reader(key_of(1));
    std::vector<std::byte> stream;
    for (const auto& each : sent) stream.insert(stream.end(), each.begin(), each.end());
    const std::size_t size = opened_of(reader, stream, random).size();
    EXPECT_EQ(size % words.size(), 0u);
    return size / words.size();
  };
  EXPECT_EQ(believed(records), 4u);
  for (std::size_t bit = 8 * frame_head_size(1); bit < 8 * records[1].size(); ++bit) {
    auto altered = records;
    altered[1][bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
    ASSERT_EQ(believed(altered), 1u) << bit;
  }
  EXPECT_EQ(believed({records[0], records[2], records[3]}), 1u) << "one is missing";
  EXPECT_EQ(believed({records[0], records[0], records[1]}), 1u) << "one is repeated";
  EXPECT_EQ(believed({records[1], records[0]}), 0u) << "two are swapped";
  EXPECT_EQ(believed({records[0], sealed_of(foreign, words), records[1]}), 1u);
}

TEST(Seals, OfDatagramsAreOpenedOnceInAnyOrder) {
  std::mt19937 random(3);
  Seal seal(key_of(1));
  SealReader reader(key_of(1));
  std::vector<std::vector<std::byte>> sealed(5'000);
  for (std::size_t i = 0; i < sealed.size(); ++i) {
    const std::vector<std::byte> head = values_of(static_cast<std::uint32_t>(i));
    seal.seal_datagram({.head = head, .body = head}, sealed[i]);
    ASSERT_EQ(sealed[i].size(), 2 * head.size() + datagram_seal_size);
  }
  std::vector<std::byte> opened;
  std::set<std::size_t> come;
  std::size_t newest = 0, late = 0, repeated = 0;
  for (int i = 0; i < 40'000; ++i) {
    // Mostly near the newest, at times far behind or ahead.
    const std::size_t jump = random() % 200 == 0 ? 1'500 : 40;
    const std::size_t base = newest > jump ? newest - jump : 0;
    const std::size_t which = std::min(base + random() % (jump + 3), sealed.size() - 1);
    const bool is_within = come.empty() || which + 1'024 > *come.rbegin();
    const bool is_new = is_within && come.count(which) == 0;
    const bool is_opened = reader.open_datagram(sealed[which], opened);
    ASSERT_EQ(is_opened, is_new) << which << " after " << newest;
    late += !is_within, repeated += is_within && !is_new;
    if (!is_opened) continue;
    std::vector<std::byte> twice =
        values_of(static_cast<std::uint32_t>(which), static_cast<std::uint32_t>(which));
    EXPECT_EQ(opened, twice);
    come.insert(which), newest = std::max(newest, which);
  }
  EXPECT_GT(come.size(), 1'000u);
  EXPECT_GT(late, 50u);
  EXPECT_GT(repeated, 1'000u);
}

TEST(Seals, OfDatagramsAreNotOpenedIfAlteredCutOrOfTheStream) {
  Seal seal(key_of(1));
  SealReader reader(key_of(1));
  const std::vector<std::byte> words = bytes_of("states");
  std::vector<std::byte> sealed, opened;
  seal.seal_datagram({.head = words, .body = {}}, sealed);
  for (std::size_t bit = 0; bit < 8 * sealed.size(); ++bit) {
    std::vector<std::byte> altered = sealed;
    altered[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
    ASSERT_FALSE(reader.open_datagram(altered, opened)) << bit;
  }
  for (std::size_t size = 0; size < sealed.size(); ++size)
    ASSERT_FALSE(reader.open_datagram(Bytes(sealed).first(size), opened)) << size;
  const std::vector<std::byte> record = sealed_of(seal, words);
  std::vector<std::byte> moved(sizeof(std::uint64_t), std::byte{0});
  moved.insert(moved.end(), record.begin() + record_head_size, record.end());
  EXPECT_FALSE(reader.open_datagram(moved, opened)) << "the stream's numbers are its own";
  EXPECT_TRUE(reader.open_datagram(sealed, opened)) << "all that was refused left no trace";
}

}  // namespace
}  // namespace rink::rti::testing
