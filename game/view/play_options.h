// The command line of rink play.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "game/control/seed_flag.h"
#include "game/net/flags.h"
#include "game/net/peer/interest/viewing_options.h"
#include "game/net/peer/playing_peer.h"
#include "game/view/menu.h"
#include "game/view/picture_of.h"

namespace rink::view {

struct PlayOptions {
  bool is_two = false;
  std::string bot, host, join, watch, replay, records;
  std::string peer, peer_listen;
  game::PlayingPeerSettings sharing;
  std::string camera;
  std::string size = "1280x720";
  bool is_full_screen = false, is_muted = false, shows_figures = false;
  std::string settings_file, key_file;
  std::uint64_t seed = 1;
  bool is_offscreen = false;
  std::string script, screenshot;
  double at_s = 0.0;
};

/// To play among peers, without a server; excludes `others`.
inline void add_peer_options(CLI::App& app, PlayOptions& options,
                             const std::vector<CLI::Option*>& others) {
  constexpr const char* group = "Among peers, without a server";
  game::Terms& terms = options.sharing.terms = {
      .peer_count = 2, .until = 600.0, .window = 0.02, .balance_windows = 25};
  terms.interest.scheme = "none";
  const auto peer = app.add_option("--peer", options.peer,
                                   "be one of the peers that share a game: HOST:PORT of any that "
                                   "is there already, a rink play or a rink peer")
                        ->type_name("HOST:PORT")
                        ->group(group);
  const auto listen = app.add_option("--peer-listen", options.peer_listen,
                                     "be the first of them; or, with --peer, where others reach "
                                     "this one (default on this machine: 127.0.0.1:0)")
                          ->type_name("ADDRESS:PORT")
                          ->group(group);
  for (CLI::Option* one : {peer, listen})
    for (CLI::Option* other : others) one->excludes(other);
  const auto first = [&](CLI::Option* option) {
    option->needs(listen)->excludes(peer)->group(group)->capture_default_str();
  };
  first(app.add_option("--peers", terms.peer_count,
                       "how many there will be, those who only compute or play bots among them; "
                       "the first one's to say")
            ->check(CLI::Range(2u, game::peers_max)));
  first(app.add_option("--until", terms.until,
                       "simulated time at which to stop [s]; the first one's to say")
            ->check(game::number_from(1e-6, game::seconds_max)));
  first(app.add_option("--window", terms.window,
                       "simulated time from one agreement to the next [s]: a key is felt one to "
                       "two windows later; the first one's to say")
            ->check(game::number_from(1e-3, 1.0)));
  first(app.add_option(
               "--scheme", terms.interest.scheme,
               "the filter by which peers tell each other what players see beyond what their peers "
               "have (docs/im.md): none, all is told; region, grid, ...; the first one's to say")
            ->check(game::objection_to));
  app.add_option("--view", options.sharing.view_fraction,
                 "area that is told of, around the own bat, as a fraction of the field's; 1 or "
                 "more: everything")
      ->check(game::number_from(1e-9, 1e6))
      ->group(group)
      ->capture_default_str();
  options.sharing.scene = "match";
  app.add_option("--scene", options.sharing.scene,
                 "a scene file or the name of a preset; the same for all peers")
      ->group(group)
      ->capture_default_str();
  app.add_option(
         "--bats", options.sharing.bats,
         "scale a crowd to so many bats at constant density; 0: as it is; the same for all peers")
      ->check(CLI::Range(0u, game::bats_max))
      ->group(group)
      ->capture_default_str();
  app.add_option("--record", options.sharing.record,
                 "write everybody's keys and the final hash to this key log; rink simulate --keys "
                 "plays the same game")
      ->type_name("FILE")
      ->group(group);
  app.add_option("--patience", options.sharing.patience_s,
                 "how long another peer may be silent [s]")
      ->check(game::number_from(0.1, game::seconds_max))
      ->group(group)
      ->capture_default_str();
}

inline void add_options(CLI::App& app, PlayOptions& options) {
  const auto two = app.add_flag("--two", options.is_two,
                                "two players on this keyboard (W A S D and the arrows)");
  const auto bot = app.add_option("--bot", options.bot, "one player against a bot of this strength")
                       ->check(CLI::IsMember({"beginner", "club", "expert"}));
  const auto host = app.add_option("--host", options.host, "host a match on PORT and play it")
                        ->type_name("PORT")
                        ->check(CLI::Range(1, 65535));
  const auto join =
      app.add_option("--join", options.join, "join the match at HOST:PORT")->type_name("HOST:PORT");
  const auto watch = app.add_option("--watch", options.watch,
                                    "watch the match or the crowd at HOST:PORT; of a crowd, I "
                                    "shows who hears of what, Tab or a click of which body")
                         ->type_name("HOST:PORT");
  const auto replay = app.add_option("--replay", options.replay,
                                     "watch a recorded match: space stops it, left and right seek, "
                                     "up and down change its speed")
                          ->type_name("FILE");
  for (CLI::Option* one : {two, bot, host, join, watch, replay})
    for (CLI::Option* other : {two, bot, host, join, watch, replay})
      if (one != other) one->excludes(other);
  add_peer_options(app, options, {two, bot, host, join, watch, replay});
  app.add_option("--key-file", options.key_file,
                 "a shared key: to host for those only who have the same file, and to join or "
                 "watch such a host")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  app.add_option("--records", options.records,
                 "folder for the records of matches (default: rink/matches in $XDG_DATA_HOME or "
                 "~/.local/share)")
      ->type_name("FOLDER");
  app.add_option("--camera", options.camera,
                 "where to see it from; C changes it, V gives each of two players their own again")
      ->check(CLI::IsMember({"left", "right", "side", "above"}));
  app.add_option("--size", options.size, "of the window")
      ->type_name("WIDTHxHEIGHT")
      ->capture_default_str();
  app.add_flag("--full-screen", options.is_full_screen, "fill the screen; F11 changes it");
  app.add_flag("--mute", options.is_muted, "no sound; M changes it");
  app.add_flag("--figures", options.shows_figures,
               "show frames per second and the connection's figures; F3 changes it");
  app.add_option("--settings", options.settings_file,
                 "file of the settings (default: rink/play.toml in $XDG_CONFIG_HOME or ~/.config)")
      ->type_name("FILE");
  app.add_option("--seed", options.seed, "of the bots")
      ->check(game::seed_number())
      ->capture_default_str();
  app.add_option("--script", options.script,
                 "press keys and take pictures as FILE says: lines TIME down|up|tap KEY, TIME text "
                 "WORDS, TIME picture FILE.png, TIME end")
      ->type_name("FILE");
  const auto screenshot = app.add_option("--screenshot", options.screenshot,
                                         "write the picture at --at to FILE.png and end")
                              ->type_name("FILE");
  app.add_option("--at", options.at_s, "seconds after the start")
      ->needs(screenshot)
      ->check(game::number_from(0.0, game::seconds_max))
      ->capture_default_str();
  app.add_flag(
      "--offscreen", options.is_offscreen,
      "draw without a window or a display, 60 frames to a second; needs --script or --screenshot");
}

/// What the command line wishes to play at once; nothing: the menu.
inline std::optional<MatchWish> wish_of(const PlayOptions& options) {
  using Kind = MatchWish::Kind;
  if (options.is_two) return MatchWish{.kind = Kind::two, .address = {}};
  if (!options.bot.empty())
    return MatchWish{.kind = Kind::bot, .strength = options.bot, .address = {}};
  if (!options.host.empty()) return MatchWish{.kind = Kind::host, .address = options.host};
  if (!options.join.empty()) return MatchWish{.kind = Kind::join, .address = options.join};
  if (!options.watch.empty()) return MatchWish{.kind = Kind::watch, .address = options.watch};
  if (!options.peer.empty() || !options.peer_listen.empty())
    return MatchWish{.kind = Kind::peer, .address = options.peer};
  if (!options.replay.empty()) return MatchWish{.kind = Kind::replay, .address = options.replay};
  return std::nullopt;
}

inline std::optional<Viewpoint> viewpoint_of(const PlayOptions& options) {
  if (options.camera == "left") return Viewpoint::left_end;
  if (options.camera == "right") return Viewpoint::right_end;
  if (options.camera == "side") return Viewpoint::side;
  if (options.camera == "above") return Viewpoint::above;
  return std::nullopt;
}

/// Nothing unless `text` is two whole numbers like 1280x720, from 320x240 to 8192x8192.
inline std::optional<WindowSize> size_of(const std::string& text) {
  WindowSize size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2)
    return std::nullopt;
  if (size.width < 320 || size.height < 240 || size.width > 8192 || size.height > 8192)
    return std::nullopt;
  return size;
}

}  // namespace rink::view
