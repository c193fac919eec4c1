// Every harness over its kept corpus, over each of its inputs cut short, and over random changes to
// them: what was found once stays found.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <vector>

#include "tests/fuzz/harness.h"
#include "tests/places.h"

namespace rink::fuzz {
namespace {

std::vector<Harness> all_harnesses() {
  std::vector<Harness> all;
  for (const auto& list : {rti_harnesses(), game_harnesses(), im_harnesses()})
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// In the order of their names, so that random changes are the same everywhere.
std::vector<std::vector<std::byte>> corpus_of(const std::string& name) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(test::source_folder()) / "tests/fuzz/corpus" / name))
    files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<std::vector<std::byte>> corpus;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    std::vector<char> content((std::istreambuf_iterator<char>(stream)),
                              std::istreambuf_iterator<char>());
    const auto* first = reinterpret_cast<const std::byte*>(content.data());
    corpus.emplace_back(first, first + content.size());
  }
  return corpus;
}

void change(std::vector<std::byte>& input, std::mt19937_64& random) {
  const std::size_t at = random() % input.size();
  const auto value = static_cast<std::byte>(random() % 256);
  switch (random() % 3) {
    case 0:
      input[at] = value;
      break;
    case 1:
      input.insert(input.begin() + static_cast<std::ptrdiff_t>(at), value);
      break;
    default:
      input.erase(input.begin() + static_cast<std::ptrdiff_t>(at));
  }
}

class Corpus : public ::testing::TestWithParam<Harness> {};

TEST_P(Corpus, IsTakenWithoutHarm) {
  const auto corpus = corpus_of(GetParam().name);
  EXPECT_FALSE(corpus.empty()) << "tests/fuzz/corpus/" << GetParam().name << " is empty";
  for (const auto& input : corpus) GetParam().run(input);
}

TEST_P(Corpus, IsTakenWithoutHarmAlsoWhenChangedAtRandom) {
  constexpr std::uint64_t seed = 41;
  std::mt19937_64 random(seed);
  std::size_t changed = 0;
  for (const auto& original : corpus_of(GetParam().name))
    for (int variant = 0; variant < 10; ++variant, ++changed) {
      std::vector<std::byte> input = original;
      for (std::uint64_t changes = 1 + random() % 8; changes > 0 && !input.empty(); --changes)
        change(input, random);
      if (variant % 3 == 0 && !input.empty()) input.resize(random() % input.size());
      GetParam().run(input);
    }
  EXPECT_GT(changed, 0u) << "seed " << seed;
}

TEST_P(Corpus, ThenWhatIsMalformedIsRefused) {
  for (const auto& input : corpus_of(GetParam().name)) GetParam().refuse(input);
  GetParam().refuse({});
}

INSTANTIATE_TEST_SUITE_P(Of, Corpus, ::testing::ValuesIn(all_harnesses()),
                         [](const auto& harness) { return std::string(harness.param.name); });

}  // namespace
}  // namespace rink::fuzz
