// rink duel: two bots play hosted matches over TCP as people would, each with a client of its own,
// and report what they saw and what it cost.

#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "game/apps/command.h"
#include "game/net/address.h"
#include "game/net/client/network_match.h"
#include "game/net/exit_status.h"
#include "game/net/fom_file.h"
#include "game/net/interrupt.h"
#include "game/net/limits.h"
#include "game/players/player_kinds.h"
#include "game/replication/trajectory_codec.h"
#include "game/version/version.h"
#include "loadgen/duel/match_bot.h"
#include "rti/transport/tcp/tcp.h"

namespace {

using namespace rink;
using game::now_s;

struct Options {
  std::string connect = "127.0.0.1:4711", second, players = "chaser";
  std::uint32_t matches = 1;
  std::uint64_t seed = 1;
  double duration_s = 0.0, frame_hz = 60.0;
};

/// One of the two, with what it received while matches were played.
struct Rival {
  Rival(const rti::Fom& fom, const game::ObjectModel& model, const Options& options,
        std::size_t number)
      : match(fom, model, transport,
              connect(transport,
                      number == 0 || options.second.empty() ? options.connect : options.second),
              {.name = "rival-" + std::to_string(number)}),
        bot(options.players, options.seed + number) {}

  static rti::ConnectionId connect(rti::TcpTransport& transport, const std::string& place) {
    const auto [address, port] = game::address_and_port("--connect", place);
    return transport.connect(address, port);
  }

  void frame() {
    const double now = now_s();
    bot.act(match, now);
    match.advance(now);
    const std::uint64_t bytes = match.client().ambassador().counters().bytes_received;
    if (match.sight().phase == game::MatchPhase::playing)
      played_s += now - frame_s, played_bytes += bytes - frame_bytes;
    frame_s = now;
    frame_bytes = bytes;
  }

  rti::TcpTransport transport;
  game::NetworkMatch match;
  loadgen::MatchBot bot;
  double frame_s = now_s(), played_s = 0.0;
  std::uint64_t frame_bytes = 0, played_bytes = 0;
};

void print(const Rival& rival) {
  const game::MatchSight& sight = rival.match.sight();
  const double played_s = std::max(rival.played_s, 1e-9);
  std::printf("%s: %u to %u, played %.1f s, %.0f payload bytes/s, %.1f keys/s",
              sight.own_team == game::Team::left ? "left" : "right", sight.score.left,
              sight.score.right, rival.played_s, static_cast<double>(rival.played_bytes) / played_s,
              rival.match.client().keys_sent() / played_s);
  if (sight.link)
    std::printf(", ping %.2f ms, jitter %.2f ms, %llu visible corrections", sight.link->ping_ms,
                sight.link->jitter_ms, static_cast<unsigned long long>(sight.link->corrections));
  std::printf("\n");
}

game::ExitStatus play(const Options& options) {
  const rti::Fom fom = game::load_rink_fom(game::fom_file());
  const game::ObjectModel model(fom);
  std::array<std::unique_ptr<Rival>, 2> rivals;
  for (std::size_t k = 0; k < rivals.size(); ++k)
    rivals[k] = std::make_unique<Rival>(fom, model, options, k);
  const double begin_s = now_s(), period_s = 1.0 / options.frame_hz;
  std::uint32_t played = 0;
  bool was_over = false;
  for (std::uint64_t frame = 1;
       !game::is_interrupted && played < options.matches &&
       (options.duration_s == 0.0 || now_s() < begin_s + options.duration_s);
       ++frame) {
    for (const auto& rival : rivals) rival->frame();
    for (const auto& rival : rivals) {
      if (rival->match.sight().phase != game::MatchPhase::lost) continue;
      game::complain(rival->match.sight().notice);
      const auto refusal = rival->match.client().joining().refusal();
      return refusal ? game::exit_status(*refusal) : game::ExitStatus::connection_lost;
    }
    const bool is_over = rivals[0]->match.sight().phase == game::MatchPhase::over &&
                         rivals[1]->match.sight().phase == game::MatchPhase::over;
    if (is_over && !was_over && ++played < options.matches)
      for (const auto& rival : rivals) rival->match.rematch();
    was_over = is_over;
    std::this_thread::sleep_for(
        std::chrono::duration<double>(begin_s + static_cast<double>(frame) * period_s - now_s()));
  }
  for (const auto& rival : rivals) print(*rival);
  for (const auto& rival : rivals) rival->match.leave(now_s());
  return game::is_interrupted ? game::ExitStatus::interrupted : game::ExitStatus::ok;
}

}  // namespace

int main(int count, char** words) {
  game::speak_as("rink-duel");
  game::Flags flags(
      "Two bots play hosted matches over TCP as people would, by what their own clients show.",
      "rink duel");
  flags.version(game::version_line("rink-duel"));
  Options options;
  flags.option("--connect", options.connect, "host, as ADDRESS:PORT").shows_default();
  flags.option("--second", options.second,
               "host of the second player, as ADDRESS:PORT: another node; by default the same");
  flags.option("--players", options.players, "the kind of both players")
      .check(game::one_of(game::player_kinds()))
      .shows_default();
  flags.option("--matches", options.matches, "number of matches, with a rematch between")
      .check(game::number_from(1, 1000))
      .shows_default();
  flags
      .option("--duration", options.duration_s,
              "seconds after which to leave; 0: when all matches are over")
      .check(game::number_from(0.0, game::seconds_max))
      .shows_default();
  flags.option("--frame-rate", options.frame_hz, "frames per second of each client")
      .check(game::number_from(10.0, 1000.0))
      .shows_default();
  flags.option("--seed", options.seed, "seed of their decisions").shows_default();
  flags.footer(std::string("Example: rink serve match & rink duel --matches 2\n\n") +
               game::exit_status_help);
  return game::run_command(
      flags, count, words,
      {.run = [&] { return static_cast<int>(play(options)); },
       .status_of =
           [](const std::exception&) { return static_cast<int>(game::ExitStatus::bad_input); }});
}
