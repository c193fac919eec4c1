// One peer's side of a window without waiting: it continues as far as the received messages allow.
#pragma once

#include <cassert>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "game/peer/protocol.h"

namespace rink::peer {

/// play_window without waiting. Messages come whole and in order from each peer, from one that is
/// ahead also those of the next window.
class WindowPlay {
 public:
  using Send = std::function<void(PeerNumber to, Subject about, std::vector<std::uint8_t> bytes)>;
  /// `peer` and the data of `say` must outlive it.
  WindowPlay(Peer& peer, PeerNumber peer_count, Send say)
      : peer_(peer), peer_count_(peer_count), send_(std::move(say)), inboxes_(peer_count) {
    assert(peer.number() < peer_count && send_);
  }

  /// Called when all have accepted, before the handovers: the states of own bodies are final.
  std::function<void()> on_final;
  /// Called when the next window is prepared.
  std::function<void()> on_commit;

  bool is_playing() const { return step_ != Step::resting; }
  /// Plays the window that is prepared (only if none is being played), and prepares the next, which
  /// ends at `next` [s], once it is final. Throws ProtocolError, as `receive` does.
  void begin(double next);
  /// `from` is another peer.
  void receive(PeerNumber from, std::vector<std::uint8_t> bytes);

  /// Asserts that received messages are counted, and that none is from the own peer.
  void check() const;

 private:
  enum class Step : std::uint8_t { resting, claims, verdicts, repeats, handover };

  template <class Make>
  void send_to_all(Subject about, Make&& make);
  template <class Message>
  void receive_from_all();
  void go_on();
  void advance();

  Peer& peer_;
  PeerNumber peer_count_;
  Send send_;
  std::vector<std::deque<std::vector<std::uint8_t>>> inboxes_;  ///< by peer
  PeerNumber received_ = 0;                                     ///< how many of them hold something
  Step step_ = Step::resting;
  double next_ = 0.0;
};

}  // namespace rink::peer
