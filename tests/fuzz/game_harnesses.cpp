// The readers of the game: key logs, decisions told to who watches, and coded trajectories.
#include <array>
#include <cstring>
#include <sstream>

#include "game/control/key_log_file.h"
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

/// A sealed log of which one key was changed, and one that goes on after its end.
void refuse_key_logs(rti::Bytes bytes) {
  game::KeyLog log;
  Input input(bytes);
  log.is_sealed = true;
  log.scene = "crowd";
  log.until = 10.0;
  for (int i = 0; i < 4; ++i)
    log.events.push_back(
        {static_cast<double>(i), input.byte() % 2, game::InputKind::key_down, game::Key::left});
  std::ostringstream written;
  game::write_key_log(written, log);
  const auto is_refused = [](const std::string& text) {
    std::istringstream stream(text);
    try {
      game::read_key_log(stream, "changed");
      return false;
    } catch (const game::SceneError&) {
      return true;
    }
  };
  std::string changed = written.str();
  const std::size_t at = changed.find("down");
  require(at != std::string::npos && !is_refused(changed), "a log as it was written is taken");
  changed.replace(at, 4, "up");
  require(is_refused(changed), "a key that was changed breaks the seal");
  require(is_refused(written.str() + "1 0 down left\n"), "nothing follows the seal");
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
  require(exchange(second, again) && again.heard == seen.heard &&
              again.views.size() == seen.views.size(),
          "and is read as the same");
}

/// An answer to a watcher whose end is missing.
void refuse_interest(rti::Bytes bytes) {
  Input input(bytes);
  game::InterestSeen seen;
  for (unsigned count = 1 + input.byte() % 8; count > 0; --count)
    seen.views.push_back({.bat = input.byte(), .hears = count % 2 == 0});
  std::vector<std::byte> written;
  rti::Writer writer(written);
  require(exchange(writer, seen), "an answer can be written");
  for (std::size_t size = 0; size < written.size(); ++size) {
    rti::Reader reader(rti::Bytes(written).first(size));
    game::InterestSeen read;
    require(!exchange(reader, read), "an answer that is cut off is refused");
  }
}

/// A coded trajectory whose end is missing.
void refuse_trajectories(rti::Bytes bytes) {
  const game::TrajectoryCodec codec;
  std::vector<std::byte> value, coded;
  const rti::Bytes whole = bytes.first(std::min<std::size_t>(bytes.size(), 64));
  double time = 1.0;
  const auto size = codec.size(whole);
  if (!size || !codec.decode(whole.first(*size), time, value)) return;
  codec.encode(value, time, coded);
  for (std::size_t cut = 0; cut < coded.size(); ++cut)
    require(!codec.size(rti::Bytes(coded).first(cut)), "a value that is cut off has no size");
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

void refuse_scenes(rti::Bytes bytes) {
  try {
    game::parse_scene(text_of(bytes) + "\n]=[\n", "fuzzed.toml");
  } catch (const game::SceneError&) {
    return;
  }
  require(false, "what is no TOML is refused");
}

}  // namespace

std::span<const Harness> game_harnesses() {
  static constexpr std::array<Harness, 4> list{{{"key_log", key_logs, refuse_key_logs},
                                                {"interest", interest, refuse_interest},
                                                {"trajectory", trajectories, refuse_trajectories},
                                                {"scene", scenes, refuse_scenes}}};
  return list;
}

}  // namespace rink::fuzz
