// Whole sessions of the shipped model under each policy, read by the wire page alone, and where
// their bytes go.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "rti/ledger/message_fields.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"
#include "tests/places.h"
#include "tests/rti/python.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

/// By direction, 'd' or 'u', and form.
using SizesByForm = std::map<std::pair<char, std::string>, std::int64_t>;

/// What the second reader prints of a session.
std::string read_by_page(const RecordingStage& recording, const std::string& flag) {
  const test::TemporaryFolder folder("recorded-rink");
  const std::string session = (std::filesystem::path(folder) / "session").string();
  std::ofstream(session, std::ios::binary) << recording.record();
  return rti::testing::output_of("python3 -B '" + test::source_folder() +
                                 "/tests/rti/wire/second_reader.py' '" + test::source_folder() +
                                 "/game/net/rink.fom.xml' '" + session + "' " + flag + " 2>&1");
}

/// As the second reader finds them.
SizesByForm sizes_by_page(const RecordingStage& recording, std::string& text) {
  text = read_by_page(recording, "--sizes");
  SizesByForm sizes;
  std::istringstream lines(text);
  char direction = 0;
  int kind = 0;
  std::int64_t size = 0;
  for (std::string word; lines >> word;) {
    if (word != "size" || !(lines >> direction >> kind >> size)) return {};
    const rti::MessageFields* fields = rti::fields_of(static_cast<std::uint8_t>(kind));
    sizes[{direction, kind == 0 ? "frame" : std::string(fields->form)}] += size;
  }
  return sizes;
}

SizesByForm sizes_by_ledger(const rti::LedgerStage& ledger) {
  SizesByForm bits;
  for (const rti::LedgerRow& row : ledger.rows())
    bits[{row.direction == rti::LedgerDirection::down ? 'd' : 'u', row.form}] += row.amount.bits;
  for (auto& [of, size] : bits) {
    EXPECT_EQ(size % 8, 0) << of.second << ": messages are whole bytes";
    size /= 8;
  }
  std::erase_if(bits, [](const auto& each) { return each.second == 0; });
  return bits;
}

TEST(RecordedRink, IsReadByTheWirePageWithTheLedgersSizes) {
  if (!rti::testing::has_python()) GTEST_SKIP() << "there is no python3";
  for (const char* policy : {"periodic", "snapshot", "dead-reckoning", "on-event", "exact"}) {
    LockstepSettings settings{.clients = 6, .is_recorded = true};
    settings.server.policy = policy;
    LockstepRink rink(small_crowd(), settings);
    rink.start();
    rink.run(1.5);
    rink.kill(2);
    rink.leave(3);
    rink.add_client("late");
    rink.run(1.5);
    std::string text;
    const SizesByForm sizes = sizes_by_page(*rink.recording(), text);
    EXPECT_EQ(sizes_by_ledger(*rink.ledger()), sizes) << policy << ": " << text;
    std::int64_t down = 0, up = 0;
    for (const auto& [of, size] : sizes) (of.first == 'd' ? down : up) += size;
    EXPECT_EQ(down, static_cast<std::int64_t>(rink.recording()->bytes_of('d'))) << policy;
    EXPECT_EQ(up, static_cast<std::int64_t>(rink.recording()->bytes_of('u'))) << policy;
    EXPECT_GT(down, 10'000) << policy;
  }
}

/// Every record of "exact": that of a body that meets an unknown one, of one that leaves, lingers
/// and comes back, on the network grid and off it, and those of a client that begins late.
TEST(RecordedRink, TellsByTheWirePageWhatTheExactFeedHasSent) {
  if (!rti::testing::has_python()) GTEST_SKIP() << "there is no python3";
  for (const double grid : {0.0, 60.0}) {
    Scene scene = small_crowd();
    scene.network_grid = grid;
    LockstepSettings settings{.clients = 6, .view_fraction = 0.05, .is_recorded = true};
    settings.server.policy = exact_policy;
    settings.server.replay = keys_for(scene, 3, 6.0);
    LockstepRink rink(scene, settings);
    rink.start();
    rink.run(2.0);
    rink.add_client("late");
    rink.run(4.0);
    std::map<std::string, std::uint64_t> sums;
    std::istringstream lines(read_by_page(*rink.recording(), ""));
    std::string last;
    for (std::string line; std::getline(lines, line); last = line) {
      std::istringstream words(line);
      std::string word, time, tag;
      if (!(words >> word >> word) || word != "exact") continue;
      ++sums["ticks"];
      words >> time >> tag;
      while (words >> word) {
        std::uint64_t count = 1;
        if (word != "start" && word != "hash") words >> count;
        sums[word] += count;
      }
    }
    const ExactCounters& sent = rink.exact_feed()->counters();
    EXPECT_EQ(sums["ticks"], sent.ticks) << last;
    EXPECT_EQ(sums["start"], sent.starts);
    EXPECT_EQ(sums["keys"], sent.keys);
    EXPECT_EQ(sums["told"], sent.told);
    EXPECT_EQ(sums["entries"], sent.entries);
    EXPECT_EQ(sums["returns"], sent.returns);
    EXPECT_EQ(sums["hash"], sent.hashes);
    EXPECT_GE(sums["exits"], sent.exits) << "who has lingered too long ends, too";
    for (const char* each : {"start", "keys", "told", "entries", "returns", "hash", "exits"})
      EXPECT_GT(sums[each], 5u) << each << ", grid " << grid;
  }
}

}  // namespace
}  // namespace rink::game
