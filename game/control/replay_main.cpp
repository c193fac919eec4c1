// rink replay: plays a recorded game again and says whether it ends as it did.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <iostream>

#include "game/control/replay.h"
#include "game/version/version.h"

namespace {

using namespace rink;

constexpr int other_hash = 1, bad_input = 2;

std::string hash_text(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, hash);
  return text;
}

int replay(const std::string& file) {
  const game::KeyLog log = game::read_key_log(std::filesystem::path(file));
  game::require_complete(log, file);
  const game::Scene scene = game::recorded_scene(log, file);
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t hash = game::replay(log, scene);
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (hash != *log.hash) {
    std::cerr << "rink replay: " << file << ": after " << *log.until
              << " s the game ends in the hash " << hash_text(hash) << ", but "
              << hash_text(*log.hash) << " was recorded\n";
    return other_hash;
  }
  std::cout << "scene " << log.scene << ", seed " << log.seed << ", " << scene.bodies.bats.size()
            << " bats, " << log.events.size() << " keys, " << *log.until << " s: hash "
            << hash_text(hash) << " as recorded (" << wall_s << " s)\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::string file;
  CLI::App app(
      "Plays a recorded game again, without a network, and compares the hash in which it ends.",
      "rink replay");
  app.set_version_flag("--version", game::version_line("rink-replay"));
  app.add_option("file", file,
                 "a key log with scene, keys, end and hash, as rink simulate --record and rink "
                 "serve --record write it")
      ->required();
  app.footer(
      "Example: rink simulate match --players chaser,random --until 120 --record match.keys && "
      "rink replay match.keys\n"
      "Exit status: 0 the same hash, 1 another hash, 2 a log that is wrong, altered or incomplete, "
      "or a bad flag.");
  try {
    app.parse(argc, argv);
    return replay(file);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_input;
  } catch (const std::exception& error) {
    std::cerr << "rink replay: " << error.what() << '\n';
    return bad_input;
  }
}
