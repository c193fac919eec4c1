// rink replay: replays a recorded game and reports whether it ends in the same state.
#include <cerrno>
#include <chrono>
#include <exception>
#include <iostream>
#include <stdexcept>

#include "game/apps/command.h"
#include "game/control/key_log_file.h"
#include "game/control/replay.h"
#include "game/model/system_reason.h"
#include "game/version/version.h"
#include "im/basics/hexadecimal.h"

namespace {

using namespace rink;

constexpr int other_hash = 1, bad_input = 2;

int replay(const std::string& file) {
  const game::KeyLog log = game::read_key_log(std::filesystem::path(file));
  game::require_complete(log, file);
  const game::Scene scene = game::recorded_scene(log, file);
  const double start_s = game::now_s();
  const std::uint64_t hash = game::replay(log, scene);
  const double wall_s = game::now_s() - start_s;
  if (hash != *log.hash) {
    game::complain(file, ": after ", *log.until, " s the game ends in the hash ", hexadecimal(hash),
                   ", but ", hexadecimal(*log.hash), " was recorded");
    return other_hash;
  }
  errno = 0;
  std::cout << "scene " << log.scene << ", seed " << log.seed << ", " << scene.bodies.bats.size()
            << " bats, " << log.events.size() << " keys, " << *log.until << " s: hash "
            << hexadecimal(hash) << " as recorded (" << wall_s << " s)\n"
            << std::flush;
  if (!std::cout)
    throw std::runtime_error("the standard output: cannot be written to its end: " +
                             game::system_reason(errno));
  return 0;
}

}  // namespace

int main(int count, char** words) {
  std::string file;
  game::speak_as("rink replay");
  game::Flags flags("Replays a recorded game, without a network, and compares the final hash.",
                    "rink replay");
  flags.version(game::version_line("rink-replay"));
  flags
      .option("file", file,
              "a key log with scene, keys, end and hash, as rink simulate --record and rink serve "
              "--record write it")
      .is_required();
  flags.footer(
      "Example: rink simulate match --players chaser,random --until 120 --record match.keys && "
      "rink replay match.keys\n"
      "Exit status: 0 the same hash, 1 another hash, 2 a log that is wrong, altered or incomplete, "
      "or a bad flag.");
  return game::run_command(flags, count, words,
                           {.run = [&] { return replay(file); },
                            .status_of = [](const std::exception&) { return bad_input; },
                            .hears_interrupts = false});
}
