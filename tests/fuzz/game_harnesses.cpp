// The readers of the game: key logs, decisions told to who watches, and coded trajectories.
#include <array>
#include <cstring>
#include <sstream>

#include "game/control/key_log.h"
#include "game/model/scene_file.h"
#include "game/net/interest_codec.h"
#include "game/replication/trajectory_codec.h"
#include "rti/wire/stream.h"
#include "tests/fuzz/harness.h"

namespace rink::fuzz {
namespace {

/// Text and packed logs alike; a log that is read and written is read as the same.
void key_logs(rti::Bytes bytes) {
  std::istringstream stream(text_of(bytes));
  game::KeyLog log;
  try {
    log = game::read_key_log(stream, "fuzzed");
  } catch (const game::SceneError&) {
    return;
  }
  if (!log.is_sealed) return;
  std::ostringstream written;
  game::write_key_log(written, log);
  std::istringstream again(written.str());
  require(game::read_key_log(again, "written") == log, "a log that is written is read as the same");
}

void interest(rti::Bytes bytes) {
  rti::Reader reader(bytes);
  game::InterestSeen seen;
  if (!exchange(reader, seen)) return;
  std::vector<std::byte> written;
  rti::Writer writer(written);
  game::InterestSeen again;
  require(exchange(writer, seen), "what was read can be written");
  rti::Reader second(written);
  require(exchange(second, again) && again.heard == seen.heard && again.views.size() == seen.views.size(), "and is read as the same");
}

void trajectories(rti::Bytes bytes) {
  const game::TrajectoryCodec codec;
  Input input(bytes);
  double time = 0.0;
  const rti::Bytes clock = input.part(sizeof time);
  if (!clock.empty()) std::memcpy(&time, clock.data(), clock.size());
  if (!(time >= 0.0 && time <= 1e9)) return;
  const rti::Bytes rest = input.rest();
  const auto size = codec.size(rest);
  if (!size) return;
  require(*size <= rest.size(), "a coded value is all there");
  std::vector<std::byte> value, coded, again;
  if (!codec.decode(rest.first(*size), time, value)) return;
  codec.encode(value, time, coded);
  require(codec.size(coded) == coded.size(), "a coded value ends by itself");
  require(codec.decode(coded, time, again) && again == value, "what was decoded keeps its bits");
}

void scenes(rti::Bytes bytes) {
  try {
    game::parse_scene(text_of(bytes), "fuzzed.toml");
  } catch (const game::SceneError&) {
  }
}

}  // namespace

std::span<const Harness> game_harnesses() {
  static constexpr std::array<Harness, 4> list{{{"key_log", key_logs}, {"interest", interest}, {"trajectory", trajectories}, {"scene", scenes}}};
  return list;
}

}  // namespace rink::fuzz
