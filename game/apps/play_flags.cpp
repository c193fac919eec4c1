// Defines the flags of rink play and its help text, and reads the wanted match from them.
#include "game/apps/play_flags.h"

#include <cstdio>

#include "game/net/limits.h"
#include "game/net/peer/interest/viewing_options.h"
#include "game/view/film/picture_sequence.h"

namespace rink::view {
using game::existing_file, game::one_of, game::whole_number_from;

/// Adds the flags of play among peers, without a server, which exclude `others`.
void add_peer_options(game::Flags& flags, PlayOptions& options,
                      const std::vector<game::Flag>& others) {
  constexpr const char* group = "Among peers, without a server";
  game::Terms& terms = options.sharing.terms = {
      .peer_count = 2, .until = 600.0, .window = 0.02, .balance_windows = 25};
  terms.interest.scheme = "none";
  const auto peer = flags
                        .option("--peer", options.peer,
                                "be one of the peers that share a game: HOST:PORT of any "
                                "running one, a rink play or a rink peer")
                        .value_name("HOST:PORT")
                        .group(group);
  const auto listen = flags
                          .option("--peer-listen", options.peer_listen,
                                  "be the first of them; or, with --peer, where others reach "
                                  "this one (default on this machine: 127.0.0.1:0)")
                          .value_name("ADDRESS:PORT")
                          .group(group);
  for (game::Flag one : {peer, listen})
    for (const game::Flag& other : others) one.excludes(other);
  const auto first = [&](game::Flag option) {
    option.needs(listen).excludes(peer).group(group).shows_default();
  };
  first(flags
            .option("--peers", terms.peer_count,
                    "number of peers, with those that only compute, watch or play bots; set by the "
                    "first peer")
            .check(whole_number_from(2, game::peers_max)));
  first(flags
            .option("--until", terms.until,
                    "simulated time at which to stop [s]; set by the first peer; not of a match, "
                    "which is played until it is won")
            .check(game::number_from(1e-6, game::seconds_max)));
  first(flags
            .option("--window", terms.window,
                    "simulated time from one agreement to the next [s]: a key takes effect one to "
                    "two windows later; of a match, by default 1/60; set by the first peer")
            .check(game::number_from(1e-3, 1.0)));
  first(
      flags
          .option(
              "--scheme", terms.interest.scheme,
              "the filter of the updates that peers send each other about bodies beyond their own "
              "parts (docs/im.md): none, which lets all through; region, grid, ...; set by the "
              "first peer")
          .check(game::objection_to));
  flags
      .option("--view", options.sharing.view_fraction,
              "area of the view around the own bat as a fraction of the field's; 1 or more: "
              "everything")
      .check(game::number_from(1e-9, 1e6))
      .group(group)
      .shows_default();
  flags
      .option(
          "--bats", options.sharing.bats,
          "scale a crowd to so many bats at constant density; 0: as it is; the same for all peers")
      .check(whole_number_from(0, game::bats_max))
      .group(group)
      .shows_default();
  flags
      .option("--record", options.sharing.record,
              "write the keys of all peers and the final hash to this key log; rink simulate "
              "--keys plays the same game; matches are recorded in the folder --records instead")
      .value_name("FILE")
      .group(group);
  flags.option("--patience", options.sharing.patience_s, "how long another peer may be silent [s]")
      .check(game::number_from(0.1, game::seconds_max))
      .group(group)
      .shows_default();
  flags
      .option("--wait", options.sharing.gathering_s,
              "how long the first peers wait until all have come [s]")
      .check(game::number_from(0.1, game::seconds_max))
      .group(group)
      .shows_default();
}

void add_options(game::Flags& flags, PlayOptions& options) {
  const auto two =
      flags.flag("--two", options.is_two, "two players on this keyboard (W A S D and the arrows)");
  const auto bot = flags.option("--bot", options.bot, "one player against a bot of this strength")
                       .check(one_of({"beginner", "club", "expert"}));
  const auto host =
      flags
          .option("--host", options.host,
                  "host a match on PORT of every address of this machine (0.0.0.0), and play it")
          .value_name("PORT")
          .check(game::whole_number_from(1, 65535));
  flags
      .option("--continue", options.continued,
              "with --host: go on with the match of this record, which was not played to its end")
      .needs(host)
      .value_name("FILE")
      .check(existing_file());
  const auto join =
      flags.option("--join", options.join, "join the match at HOST:PORT").value_name("HOST:PORT");
  const auto watch = flags
                         .option("--watch", options.watch,
                                 "watch the match or the crowd at HOST:PORT; of a crowd, I "
                                 "shows which player receives what, Tab or a click about which "
                                 "body")
                         .value_name("HOST:PORT");
  const auto replay =
      flags
          .option("--replay", options.replay,
                  "watch a recorded match: space stops it, left, right and its bar seek, "
                  "up and down change its speed")
          .value_name("FILE");
  const std::vector<game::Flag> beginnings{two, bot, host, join, watch, replay};
  for (std::size_t k = 0; k < beginnings.size(); ++k)
    for (std::size_t other = 0; other < beginnings.size(); ++other)
      if (k != other) game::Flag(beginnings[k]).excludes(beginnings[other]);
  add_peer_options(flags, options, beginnings);
  flags
      .option("--key-file", options.key_file,
              "a shared key: to host only for players with the same file, and to join or "
              "watch such a host")
      .value_name("FILE")
      .check(existing_file());
  options.sharing.scene = "match";
  flags
      .option("--scene", options.sharing.scene,
              "what is played, but by --join and --watch: match; paper, at the pace of the paper; "
              "or a scene file; the same for all peers")
      .shows_default();
  flags
      .option("--records", options.records,
              "folder for the records of matches (default: rink/matches in $XDG_DATA_HOME or "
              "~/.local/share)")
      .value_name("FOLDER");
  flags
      .option("--camera", options.camera,
              "viewpoint; C changes it, V gives each of two players their own again")
      .check(one_of({"left", "right", "side", "above"}));
  flags
      .option("--control", options.control,
              "what moves the bat of the only player, or of the left of two: keys; pointer, mouse "
              "or touch, which the bat follows; gamepad, its left stick. Keys go on beside it "
              "(default: the setting control)")
      .check(one_of({"keys", "pointer", "gamepad"}));
  flags
      .option("--size", options.size,
              "size of the window (without it: as it was when it was closed last)")
      .value_name("WIDTHxHEIGHT")
      .shows_default();
  flags.flag("--full-screen", options.is_full_screen, "fill the screen; F11 changes it");
  flags.flag("--mute", options.is_muted, "no sound; M changes it");
  flags.flag("--figures", options.shows_figures,
             "show frames per second and the connection's figures; F3 changes it");
  flags
      .option("--settings", options.settings_file,
              "file of the settings (default: rink/play.toml in $XDG_CONFIG_HOME or ~/.config)")
      .value_name("FILE");
  flags.flag("!--no-discovery", options.is_discovered,
             "neither ask the local network for matches nor answer who asks it (setting "
             "finds_matches)");
  const auto pictures =
      flags
          .option("--pictures", options.pictures,
                  "with --replay: write the match as pictures frame-000001.png and so on into this "
                  "new or empty folder, without a window, and end")
          .needs(replay)
          .value_name("FOLDER");
  flags.option("--picture-rate", options.picture_rate, "pictures for each second of the match")
      .needs(pictures)
      .check(game::number_from(0.1, film_frames_per_s_max))
      .shows_default();
  flags
      .option("--frame-limit", options.frame_limit,
              "pictures a second that the window draws at most, where the screen does not limit "
              "them; a menu that nobody touches for 5 s draws one")
      .check(game::number_from(10.0, 1000.0))
      .shows_default();
  flags.option("--seed", options.seed, "seed of the bots").shows_default();
  flags
      .option(
          "--script", options.script,
          "press keys and take pictures by the script FILE: lines TIME down|up|tap KEY, TIME text "
          "WORDS, TIME pointer X Y, TIME stick X Y, TIME gamepad on|off, TIME picture FILE.png, "
          "TIME end")
      .value_name("FILE");
  const auto screenshot = flags
                              .option("--screenshot", options.screenshot,
                                      "write the picture at --at to FILE.png and end")
                              .value_name("FILE");
  flags.option("--at", options.at_s, "seconds after the start")
      .needs(screenshot)
      .check(game::number_from(0.0, game::seconds_max))
      .shows_default();
  flags.flag(
      "--offscreen", options.is_offscreen,
      "draw without a window or a display, 60 frames to a second; needs --script or --screenshot");
}

/// The match to play at once by the command line; nothing: the menu.
std::optional<MatchWish> wish_of(const PlayOptions& options) {
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

std::optional<Viewpoint> viewpoint_of(const PlayOptions& options) {
  if (options.camera == "left") return Viewpoint::left_end;
  if (options.camera == "right") return Viewpoint::right_end;
  if (options.camera == "side") return Viewpoint::side;
  if (options.camera == "above") return Viewpoint::above;
  return std::nullopt;
}

/// Nothing unless `text` is two whole numbers like 1280x720, from 320x240 to 8192x8192.
std::optional<WindowSize> size_of(const std::string& text) {
  WindowSize size;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2)
    return std::nullopt;
  if (size.width < 320 || size.height < 240 || size.width > 8192 || size.height > 8192)
    return std::nullopt;
  return size;
}

}  // namespace rink::view
