// Runs a peer from its first message to its last, and shows the window each stage.
#include "game/net/peer/playing_peer.h"
#include "game/net/peer/network/unguessable_number.h"

#include <chrono>
#include <cstdio>

#include "game/control/key_log_file.h"
#include "game/model/scene_file.h"
#include "game/net/address.h"
#include "game/net/interrupt.h"
#include "game/net/peer/interest/viewing_options.h"
#include "game/net/peer/local_player.h"
#include "game/net/peer/network/listening_place.h"
#include "im/basics/hexadecimal.h"

namespace rink::game {

namespace {

Scene scene_of(const PlayingPeerSettings& settings) {
  Scene scene = load_scene(settings.scene);
  return settings.bats > 0 ? scaled_to_bats(std::move(scene), settings.bats) : scene;
}

}  // namespace

PlayingPeer::PlayingPeer(const PlayingPeerSettings& settings, double (*now_s)())
    : settings_(settings),
      record_file_("--record", settings.record),
      now_s_(now_s),
      game_(scene_of(settings), {}),
      match_(game_, input_) {
  settings_.terms.interest.always = relevant_kinds_of(game_.scene()).bits();
  if (game_.bat_count() == 0)
    throw SceneError("scene '" + settings.scene + "' has no bats: expected one that can be played");
  if (game_.has_keys())
    throw SceneError("scene '" + settings.scene + "' has keys already, so no player can be live");
  game_.require_divisible();
  if (settings.join.empty()) game_.require_window(settings.terms.window);
  Place place = listening_place(settings.listen, settings.join, true,
                                {.listen = "--peer-listen", .join = "--peer"});
  place.port = sockets_.listen(place.address, place.port);
  input_.print("listening on " + place.text() + "\n");
  place_ = place;
  meet();
  input_.set_stage(PeerStage::Step::gathering, settings.join.empty()
                                                   ? "this peer listens on " + place.text() +
                                                         "; there will be " +
                                                         std::to_string(settings.terms.peer_count)
                                                   : "asking the peer at " + settings.join);
  thread_ = std::thread([this] { run(); });
}

/// Connects again, with another token.
void PlayingPeer::meet() {
  const PeerInfo self{
      .place = place_, .bat_count = 1, .hand_count = 1, .token = unguessable_number()};
  const auto must_end = [this] { return is_interrupted != 0 || input_.wants_to_leave(); };
  network_ = std::make_unique<PeerNetwork>(
      sockets_,
      PeerNetworkSettings{.self = self,
                          .bats = game_.bat_count(),
                          .session_fingerprint = game_.session_fingerprint(),
                          .session = unguessable_number(),
                          .patience_s = settings_.patience_s,
                          .gathering_s = settings_.gathering_s,
                          .must_end = must_end},
      now_s_);
}

PlayingPeer::~PlayingPeer() {
  input_.leave();
  thread_.join();
}

void PlayingPeer::run() {
  const auto end_badly = [this](FarewellKind kind, const std::string& why) {
    network_->leave({kind, why});
    input_.set_stage(PeerStage::Step::lost, why);
  };
  try {
    for (int tries = 1; !share_or_come_again(tries); ++tries) {
    }
  } catch (const SessionError& error) {
    end_badly(error.status() == ExitStatus::interrupted ? FarewellKind::interrupted
                                                        : FarewellKind::trouble,
              error.what());
  } catch (const std::exception& error) {  // peer::Halt, peer::ProtocolError, a transport's
    end_badly(FarewellKind::trouble, error.what());
  }
}

/// False if it was sent away before it was admitted, and may try again.
bool PlayingPeer::share_or_come_again(int tries) {
  constexpr int tries_max = 10;
  constexpr auto pause =
      std::chrono::milliseconds(200);  // in which the playing peers may agree on their members
  try {
    share();
    return true;
  } catch (const peer::SentAway&) {
    if (tries == tries_max) throw;
    network_->abandon();
    std::this_thread::sleep_for(pause);
    meet();
    return false;
  }
}

void PlayingPeer::share() {
  if (settings_.join.empty()) {
    network_->found(settings_.terms);
  } else {
    const auto [address, port] = address_and_port("--peer", settings_.join);
    network_->join({address, port});
    input_.set_stage(PeerStage::Step::gathering, "peer " + std::to_string(network_->number()) +
                                                     " of " +
                                                     std::to_string(network_->terms().peer_count));
  }
  const bool is_late = !network_->members().empty();
  if (!is_late) network_->gather();
  const Terms& terms = network_->terms();
  if (terms.is_seated)
    throw SessionError(
        ExitStatus::not_admitted,
        "the peers there are seated, and their players' keys are known: nobody can play "
        "at a window");
  const Viewing viewing =
      make_viewing(game_, *network_,
                   {.view_fraction = settings_.view_fraction, .trace = {}, .always = {}}, now_s_);
  const PeerInfo self = network_->peer_infos()[network_->number()];
  input_.set_player(self.first_bat);
  if (!is_late) input_.set_stage(PeerStage::Step::countdown, "", settings_.countdown_s);
  network_->begin();
  if (!is_late) network_->rest_until(now_s_() + settings_.countdown_s);
  input_.set_stage(PeerStage::Step::playing, "");
  LocalPlayer player(game_, self.first_bat, input_);
  player.viewer = viewing.viewer.get();
  if (player.viewer == nullptr)
    input_.notice(
        "The first peer has no --scheme: bodies beyond the halo are not sent, and not shown");
  player.bytes_sent = [this] { return network_->bytes_sent(); };
  PartOptions part_options;
  std::optional<double> start_s;  // of the simulated time
  part_options.before_window = [&](double time) {
    if (!start_s) start_s = now_s_() - time;
    network_->note_window();
    network_->rest_until(*start_s + time);
  };
  part_options.members = network_->members();
  part_options.wants_to_leave = [this] { return input_.wants_to_leave() || is_interrupted != 0; };
  part_options.notify = [this](const std::string& what) { input_.notice(what); };
  part_options.participant = &player;
  part_options.observer = viewing.viewer.get();
  const PlayedPart part =
      game_.play(terms, network_->peer_infos(), network_->number(), *network_, part_options);
  network_->leave({});
  end(part);
}

void PlayingPeer::end(const PlayedPart& part) {
  if (part.has_left)
    return input_.set_stage(PeerStage::Step::over, part.was_last
                                                       ? "no peer was left to continue"
                                                       : "all that this peer had is with others");
  char words[160];
  std::snprintf(words, sizeof words, "The game is over at %g s: hash %s, %zu keys", part.time,
                hexadecimal(part.hash).c_str(), part.keys.size());
  std::string problem;
  try {
    write_record(part);
  } catch (const std::exception& error) {
    problem = std::string("; ") + error.what();
  }
  input_.print(words + problem + "\n");
  input_.set_stage(PeerStage::Step::over, words + problem);
}

void PlayingPeer::write_record(const PlayedPart& part) {
  if (!settings_.record.empty())
    write_key_log(std::filesystem::path(settings_.record),
                  game_.record_of(part, scene_text(settings_.scene)));
}

}  // namespace rink::game
