// Makes the match that the player has chosen, with its records and messages.
#include "game/apps/play_matches.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "game/apps/command.h"
#include "game/control/begun_match.h"
#include "game/control/match_flow.h"
#include "game/control/match_records.h"
#include "game/match/local_match.h"
#include "game/match/replay_match.h"
#include "game/model/scene_file.h"
#include "game/net/client/returning_match.h"
#include "game/net/peer/network/listening_place.h"
#include "game/net/peer/playing_peer.h"
#include "game/view/host_process.h"
#include "game/view/match_among_peers.h"

namespace rink::view {
namespace {

std::string bot_kind(const std::string& strength) {
  return strength == "club" ? "chaser" : "chaser-" + strength;
}

std::string records_folder(const PlayOptions& options) {
  if (!options.records.empty()) return options.records;
  if (const char* folder = std::getenv("XDG_DATA_HOME"); folder != nullptr && *folder != '\0')
    return std::string(folder) + "/rink/matches";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return std::string(home) + "/.local/share/rink/matches";
  return "matches";
}

/// The folder of a host's records: one that cannot be written is reported and left out, since the
/// match matters more.
std::string host_records(const std::string& folder) {
  const auto problem = game::MatchRecords(folder).test();
  if (!problem) return folder;
  const std::string other = (std::filesystem::temp_directory_path() / "rink-matches").string();
  game::complain(*problem + "; they are kept in " + other);
  return other;
}

/// `Match`, made of the arguments, for a source that does more than it at each advance.
template <class Match>
class MatchWithin : public game::MatchSource {
 public:
  template <class... Arguments>
  explicit MatchWithin(const Arguments&... arguments) : match_(arguments...) {}
  void advance(double now_s) override { match_.advance(now_s); }
  const game::MatchSight& sight() const override { return match_.sight(); }
  std::uint32_t hand_count() const override { return match_.hand_count(); }
  void press(std::uint32_t hand, game::Key key, bool is_down) override {
    match_.press(hand, key, is_down);
  }
  void reach(std::uint32_t hand, const std::optional<game::Vector2>& place) override {
    match_.reach(hand, place);
  }
  std::string why_keys_alone() const override { return match_.why_keys_alone(); }
  void pause(bool is_wanted) override { match_.pause(is_wanted); }
  void rematch() override { match_.rematch(); }

 protected:
  Match& match() { return match_; }

 private:
  Match match_;
};

/// A local match whose records are kept, also of one that is abandoned. A record that cannot be
/// written is reported; the match goes on.
class RecordedMatch final : public MatchWithin<game::LocalMatch> {
 public:
  RecordedMatch(const game::Scene& scene, const game::LocalMatchSettings& settings,
                const std::string& folder)
      : MatchWithin(scene, settings), records_(folder) {}
  ~RecordedMatch() override {
    match().finish();
    keep();
  }
  void advance(double now_s) override {
    MatchWithin::advance(now_s);
    keep();
    const auto record_so_far = [this] { return match().record_so_far(); };
    if (const auto problem = records_.follow(now_s, record_so_far)) game::complain(*problem);
  }

 private:
  void keep() {
    for (const game::KeyLog& log : match().take_finished()) {
      if (const auto problem = records_.keep(log)) game::complain(*problem);
      match().set_notice(records_.is_failing() ? "The last match could not be recorded" : "");
    }
  }
  game::MatchRecords records_;
};

/// The server of a match that is hosted here. One that was killed is started again, and its match
/// goes on from its record.
class MatchServer {
 public:
  explicit MatchServer(const HostSettings& settings) : settings_(settings) { start(); }
  void attend() {
    std::cerr << server_->take_words();
    if (server_->has_ended() && starts_left_ > 0) start_again();
  }

 private:
  void start() {
    started_ = std::filesystem::file_time_type::clock::now();
    server_ = std::make_unique<HostProcess>(settings_);
  }
  void start_again() {
    --starts_left_;
    const auto record = game::newest_record(settings_.records, started_);
    if (record) settings_.continued = record->string();
    game::complain("the match's server has ended; it is started again" +
                   (record ? ", from " + record->string() : std::string()));
    try {
      start();
    } catch (const std::exception& error) {
      game::complain(error.what());
    }
  }

  HostSettings settings_;
  std::filesystem::file_time_type started_;
  std::unique_ptr<HostProcess> server_;
  int starts_left_ = 5;  ///< for a match that cannot be played must end
};

/// A match that is hosted and played here: the server, as the first base, starts before the
/// connection to it, and ends after it.
class HostedMatch final : private MatchServer, public MatchWithin<game::ReturningMatch> {
 public:
  explicit HostedMatch(const HostSettings& settings)
      : MatchServer(settings),
        MatchWithin("127.0.0.1:" + settings.port, game::NetworkMatchSettings{.name = "host"},
                    settings.key_file) {}
  void advance(double now_s) override {
    MatchWithin::advance(now_s);
    attend();
  }
};

/// A part of a game that peers share, with its messages for the terminal.
template <class Peer>
class SharedMatch final : public MatchWithin<Peer> {
 public:
  using MatchWithin<Peer>::MatchWithin;
  void advance(double now_s) override {
    MatchWithin<Peer>::advance(now_s);
    std::cout << this->match().take_words() << std::flush;
  }
};

/// Throws SceneError for a scene that is for no match.
game::Scene match_scene(const std::string& name) {
  game::Scene scene = game::load_scene(name);
  if (const auto objection = game::match_objection(scene))
    throw game::SceneError("--scene: '" + name + "' is for no match: " + *objection);
  return scene;
}

/// What only a game without rules of a match has.
void require_match_flags(const PlayOptions& options) {
  for (const auto& [flag, why] :
       {std::pair{"--until", "a match is played until it is won"},
        std::pair{"--scheme", "in a match every player receives everything"},
        std::pair{"--view", "in a match every player receives everything"},
        std::pair{"--record", "matches are recorded in the folder --records"}})
    if (options.given.count(flag) != 0)
      throw std::invalid_argument(flag + std::string(": ") + why + ": expected none for scene '" +
                                  options.sharing.scene + "'");
}

/// Of rink serve, which is one of the nodes that share the match.
HostSettings node_settings(const PlayOptions& options, const std::string& records) {
  const game::PlayingPeerSettings& sharing = options.sharing;
  const game::Place place = game::listening_place(options.peer_listen, options.peer, true,
                                                  {.listen = "--peer-listen", .join = "--peer"});
  HostSettings settings{.scene = sharing.scene,
                        .address = place.address,
                        .records = records,
                        .key_file = options.key_file};
  const auto add = [&](const char* flag, const std::string& value) {
    settings.sharing.insert(settings.sharing.end(), {flag, value});
  };
  const auto text_of = [](double value) {
    std::ostringstream text;
    text << std::setprecision(17) << value;
    return text.str();
  };
  if (options.peer.empty()) add("--nodes", std::to_string(sharing.terms.peer_count));
  else add("--join", options.peer);
  add("--node-listen", place.text());
  add("--node-patience", text_of(sharing.patience_s));
  add("--patience", text_of(sharing.gathering_s));
  if (options.given.count("--window") != 0) add("--rate", text_of(1.0 / sharing.terms.window));
  return settings;
}

/// A match is small: each peer plays all of it, and they tell each other keys alone. Other games
/// they divide.
std::unique_ptr<game::MatchSource> make_shared_match(const PlayOptions& options,
                                                     const std::string& records) {
  game::PlayingPeerSettings settings = options.sharing;
  settings.join = options.peer, settings.listen = options.peer_listen;
  const game::Scene scene = game::load_scene(settings.scene);
  if (settings.bats > 0 || game::match_objection(scene))
    return std::make_unique<SharedMatch<game::PlayingPeer>>(settings, &game::now_s);
  require_match_flags(options);
  return std::make_unique<SharedMatch<MatchAmongPeers>>(
      scene, node_settings(options, host_records(records)), "player-" + std::to_string(getpid()));
}

}  // namespace

std::unique_ptr<game::MatchSource> make_match(const MatchWish& wish, const PlayOptions& options) {
  using Kind = MatchWish::Kind;
  const std::string records = records_folder(options);
  if (wish.kind == Kind::host) {
    match_scene(options.sharing.scene);
    return std::make_unique<HostedMatch>(HostSettings{.scene = options.sharing.scene,
                                                      .port = wish.address,
                                                      .records = host_records(records),
                                                      .key_file = options.key_file,
                                                      .is_announced = options.is_discovered,
                                                      .continued = options.continued});
  }
  if (wish.kind == Kind::join)
    return std::make_unique<game::ReturningMatch>(
        wish.address, game::NetworkMatchSettings{.name = "player-" + std::to_string(getpid())},
        options.key_file);
  if (wish.kind == Kind::watch)
    return std::make_unique<game::ReturningMatch>(
        wish.address,
        game::NetworkMatchSettings{.name = "watcher-" + std::to_string(getpid()),
                                   .only_watches = true},
        options.key_file);
  if (wish.kind == Kind::replay) return std::make_unique<game::ReplayMatch>(wish.address);
  if (wish.kind == Kind::peer) return make_shared_match(options, records);
  // Behind the menu two bots play, whatever is to be played.
  const std::string name = wish.kind == Kind::bots ? "match" : options.sharing.scene;
  const game::Scene scene = match_scene(name);
  game::LocalMatchSettings settings{.seed = options.seed, .scene_text = game::scene_text(name)};
  if (wish.kind == Kind::bots) {
    settings.players = {"chaser", "chaser"};
    settings.times.countdown_s = 0.0;
    return std::make_unique<game::LocalMatch>(scene, settings);
  }
  if (wish.kind == Kind::bot) {
    settings.players = {game::Playing::hand, bot_kind(wish.strength)};
    settings.left_name = "You";
    settings.right_name = "Bot";
  }
  return std::make_unique<RecordedMatch>(scene, settings, records);
}

}  // namespace rink::view
