// A packed key log reads back bit for bit, is small, and is refused if a byte of it is not as it
// was.
#include "game/control/key_log_packed.h"

#include <gmock/gmock.h>

#include <sstream>

#include "game/control/key_log_file.h"
#include "game/model/random_stream.h"
#include "game/model/time_grid.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

using ::testing::HasSubstr;

std::string bytes_of(const KeyLog& log) {
  std::ostringstream stream;
  write_packed_key_log(stream, log);
  return stream.str();
}

KeyLog read(const std::string& bytes) {
  std::istringstream stream(bytes);
  return read_key_log(stream, "match.keys");
}

std::string packed_refusal(const std::string& bytes) {
  return refusal_of([&] { read(bytes); });
}

KeyLog small_log() {
  KeyLog log{.scene = "match",
             .seed = 3,
             .bats = 2,
             .fingerprint = 9,
             .until = 2.0,
             .hash = 5,
             .scene_text = "a = 1\n",
             .is_sealed = true,
             .events = {}};
  log.events = {{0.5, 0, InputKind::key_down, Key::up},
                {0.75, 1, InputKind::key_up, Key::right},
                {0.1 + 0.7, 0, InputKind::key_up, Key::up}};
  return log;
}

TEST(PackedKeyLog, ReadsBackBitForBitWhateverItsTimesAndPlayers) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed);
    KeyLog log{.scene = "a crowd",
               .seed = ~0ull,
               .bats = {},
               .fingerprint = 0xff00ff00ff00ff00u,
               .until = 1e9,
               .hash = 77,
               .scene_text = "a = 1\n\n# b\n",
               .is_sealed = true,
               .events = {}};
    if (seed % 2 == 0) log.bats = 1000, log.bat_count = 8, log.puck_count = 0xffffffffu;
    double time = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const double later = time + random.uniform() * (i % 9 == 0 ? 1e-12 : i % 11 == 0 ? 1e3 : 0.1);
      const std::uint32_t form = random.below(4);
      time =
          std::max(time, form == 0   ? later
                         : form == 1 ? next_on(key_grid, later)
                         : form == 2 ? std::round(later * 1e3) * 0.001
                                     : std::round(later * 20.0) * 0.05 + 0.002 * random.below(25));
      const auto kind = static_cast<InputKind>(random.below(4));
      const bool has_key = kind == InputKind::key_down || kind == InputKind::key_up;
      log.events.push_back({time, random.below(i % 2 == 0 ? 2 : 2000), kind,
                            has_key ? static_cast<Key>(random.below(4)) : Key::left});
    }
    EXPECT_EQ(read(bytes_of(log)), log);
  }
}

TEST(PackedKeyLog, TakesThreeToFourBytesForAKeyOfAMatch) {
  KeyLog log = small_log();
  log.events.clear();
  const std::size_t without = bytes_of(log).size();
  RandomStream random(1);
  for (int i = 1; i <= 1000; ++i)
    log.events.push_back({next_on(key_grid, i * 0.037 + 0.01 * random.uniform()), random.below(2),
                          InputKind::key_down, Key::up});
  EXPECT_LE(bytes_of(log).size() - without, 3u * 1000 + 10);
  for (int i = 0; i < 1000; ++i)
    log.events[static_cast<std::size_t>(i)].time =
        i * 0.05 + 0.034;  // as players that decide press them
  EXPECT_LE(bytes_of(log).size() - without, 4u * 1000 + 10);
}

TEST(PackedKeyLog, ThatIsCutAnywhereIsRefused) {
  const std::string bytes = bytes_of(small_log());
  ASSERT_EQ(read(bytes), small_log());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(packed_refusal(bytes.substr(0, size)), "(accepted)") << size;
  EXPECT_THAT(packed_refusal(bytes.substr(0, bytes.size() - 1)),
              HasSubstr("match.keys: is cut off: "));
  EXPECT_THAT(packed_refusal(bytes.substr(0, 15)),
              HasSubstr("match.keys: is cut off after its first line"));
}

TEST(PackedKeyLog, ThatIsAlteredAnywhereIsRefused) {
  const std::string bytes = bytes_of(small_log());
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (const int bit : {0, 3, 7}) {
      std::string altered = bytes;
      altered[at] = static_cast<char>(altered[at] ^ (1 << bit));
      EXPECT_NE(packed_refusal(altered), "(accepted)") << at;
    }
  std::string altered = bytes;
  altered.back() = static_cast<char>(altered.back() ^ 1);
  EXPECT_THAT(packed_refusal(altered),
              HasSubstr("match.keys: was altered: its checksum is another"));
  EXPECT_THAT(packed_refusal(bytes + '\n'),
              HasSubstr("match.keys: was altered: it continues after its end"));
}

TEST(PackedKeyLog, OfAnotherVersionIsRefusedByItsFirstLine) {
  std::string bytes = bytes_of(small_log());
  bytes[10] = '5';
  EXPECT_THAT(packed_refusal(bytes), HasSubstr("match.keys:1: found \"rink-keys 5\", expected the "
                                               "line \"rink-keys 1\" or \"rink-keys 2\""));
}

/// A checksum keeps nobody from making up a log: what is read must be checked all the same.
TEST(PackedKeyLog, ThatIsMadeUpIsReadOrRefusedButNeverBelieved) {
  RandomStream random(4);
  for (int round = 0; round < 20'000; ++round) {
    std::string body;
    for (std::uint32_t size = random.below(60); size > 0; --size)
      body += static_cast<char>(random.below(round % 2 == 0 ? 256 : 8));
    std::uint64_t sum = 0xcbf29ce484222325u;
    for (const char byte : body) sum = (sum ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
    const std::uint64_t size = body.size();
    std::string bytes = "rink-keys 2\n";
    bytes.append(reinterpret_cast<const char*>(&sum), 8)
        .append(reinterpret_cast<const char*>(&size), 8)
        .append(body);
    try {
      const KeyLog log = read(bytes);
      for (std::size_t k = 1; k < log.events.size(); ++k)
        EXPECT_LE(log.events[k - 1].time, log.events[k].time);
    } catch (const SceneError&) {
    }
  }
}

TEST(PackedKeyLog, ThatFindsNoRoomSaysSo) {
  try {
    write_packed_key_log(std::filesystem::path("/dev/full"), small_log());
    FAIL() << "a full disk was written to";
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/dev/full: cannot be written: No space left on device"));
  }
}

TEST(KeyLog, WithoutEndIsRefusedAtOnce) {
  for (const char* device : {"/dev/zero", "/dev/urandom"}) {
    try {
      read_key_log(std::filesystem::path(device));
      FAIL() << device;
    } catch (const SceneError& error) {
      EXPECT_THAT(error.what(), HasSubstr(std::string(device) + ":1: found \""));
      EXPECT_THAT(error.what(), HasSubstr("expected the line \"rink-keys 1\""));
    }
  }
  EXPECT_THAT(packed_refusal("rink-keys 1\nscene " + std::string(100'000, 'x')),
              HasSubstr("expected a line of at most 65536 bytes"));
}

}  // namespace
}  // namespace rink::game
