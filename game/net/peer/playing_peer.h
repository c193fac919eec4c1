// A whole peer with a person: connections, windows and record in a thread of its own, and the match
// that its window shows.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "game/net/peer/input_queue.h"
#include "game/net/peer/network/greetings.h"
#include "game/net/peer/network/peer_network.h"
#include "game/net/peer/peer_match.h"
#include "game/net/peer/shared_game.h"
#include "game/net/record_file.h"
#include "rti/transport/socket_transport.h"

namespace rink::game {

struct PlayingPeerSettings {
  std::string scene = "match";  ///< see load_scene; the same for all peers
  std::uint32_t bats = 0;       ///< number to scale to, if not 0
  std::string join;             ///< HOST:PORT of any playing peer; empty: become the first one
  std::string listen;        ///< ADDRESS:PORT where others reach this one; may be empty if there is
                             ///< `join`, of peers on this machine
  Terms terms;               ///< set by a first peer
  double patience_s = 10.0;  ///< with silent peers
  double gathering_s = 600.0;  ///< until all first peers are there
  double countdown_s = 3.0;
  double view_fraction = 1.0;  ///< of the field's area, about the own bat; from 1 on everything
  std::string record;          ///< everybody's keys go to this file in the end; empty: nowhere
};

class PlayingPeer final : public MatchSource {
 public:
  /// `now_s` is the clock by which windows are played. A later failure of connections shows as a
  /// match that is lost. Throws std::exception that names a fault of the settings.
  PlayingPeer(const PlayingPeerSettings& settings, double (*now_s)());
  /// Hands over its bodies, which takes two windows, or a few seconds if no peer answers.
  ~PlayingPeer() override;

  void advance(double now_s) override { match_.advance(now_s); }
  const MatchSight& sight() const override { return match_.sight(); }
  std::uint32_t hand_count() const override { return match_.hand_count(); }
  void press(std::uint32_t hand, Key key, bool is_down) override {
    match_.press(hand, key, is_down);
  }
  void pause(bool is_wanted) override { match_.pause(is_wanted); }
  void rematch() override { match_.rematch(); }

  /// Text for the standard output: where it listens, and how it ended.
  std::string take_words() { return input_.take_words(); }

 private:
  void run();
  void meet();
  bool share_or_come_again(int tries);
  void share();
  void end(const PlayedPart& part);
  void write_record(const PlayedPart& part);

  PlayingPeerSettings settings_;
  RecordFile record_file_;
  double (*now_s_)();
  SharedGame game_;
  InputQueue input_;
  PeerMatch match_;
  Place place_;
  rti::SocketTransport sockets_{"tcp"};
  std::unique_ptr<PeerNetwork> network_;
  std::thread thread_;
};

}  // namespace rink::game
