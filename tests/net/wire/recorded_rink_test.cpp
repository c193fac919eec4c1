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

/// As the second reader finds them.
SizesByForm sizes_by_page(const RecordingStage& recording, std::string& text) {
  const test::TemporaryFolder folder("recorded-rink");
  const std::string session = (std::filesystem::path(folder) / "session").string();
  std::ofstream(session, std::ios::binary) << recording.record();
  text = rti::testing::output_of("python3 -B '" + test::source_folder() +
                                 "/tests/rti/wire/second_reader.py' '" + test::source_folder() +
                                 "/game/net/rink.fom.xml' '" + session + "' --sizes 2>&1");
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

}  // namespace
}  // namespace rink::game
