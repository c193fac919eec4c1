// A viewer that records a trace: it presses its player's keys when they are due, and notes the
// peer's traffic, the instants of its knowledge, and its player's replicas.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "game/net/peer/interest/viewer.h"
#include "game/net/peer/network/peer_network.h"
#include "game/net/peer/peer_trace.h"
#include "game/net/peer/player_recorder.h"
#include "game/net/sampling.h"

namespace rink::game {

/// For a session whose peers are seated, in real time.
class RunRecorder final : public Viewer {
 public:
  /// All must outlive it. `sampling` decides which players are watched when, the same at all peers.
  RunRecorder(const SharedGame& game, const InterestSettings& settings, PeerNetwork& network,
              const SamplingSettings& sampling, double (*now_s)());
  ~RunRecorder() override;

  /// The mail to use instead of the network's, so that traffic is counted.
  peer::Mail& mail() { return mail_; }
  /// The game starts at `start_s` of the clock.
  void start_at(double start_s) { start_s_ = start_s; }
  /// The trace; call it after the last window.
  const PeerTrace& trace() const { return trace_; }

  void begin(const peer::Session& session) override;
  void when_sending(peer::Subject about) override;
  void end() override;

 private:
  class CountedMail final : public peer::Mail {
   public:
    explicit CountedMail(PeerNetwork& network) : network_(network) {}
    void send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override;
    std::vector<std::uint8_t> receive(peer::PeerNumber from) override {
      return network_.receive(from);
    }
    std::pair<peer::PeerNumber, std::vector<std::uint8_t>> receive_any(
        std::span<const peer::PeerNumber> from) override {
      return network_.receive_any(from);
    }
    void part(peer::PeerNumber peer, bool is_lost) override { network_.part(peer, is_lost); }
    Traffic about = Traffic::claims;
    TrafficBytes bytes{}, messages{};

   private:
    PeerNetwork& network_;
  };

  double simulated_s() const { return now_s_() - start_s_; }
  double attend();
  void note_decisions(double instant_s);
  PeerLoad load() const;

  PeerNetwork& network_;
  SamplingSettings sampling_;
  double (*now_s_)();
  double start_s_ = 0.0, rate_hz_;
  CountedMail mail_;
  const peer::Session* session_ = nullptr;
  PeerTrace trace_;
  std::optional<PlayerRecorder> player_;
  std::vector<std::uint32_t> bats_;  ///< by peer
  std::vector<peer::PeerNumber> watched_;
  std::vector<double> keys_, samples_, decisions_;
  std::size_t next_key_ = 0, next_sample_ = 0, next_decision_ = 0;
  bool has_begun_ = false, has_ended_ = false;
  std::uint32_t felt_ = 0;
};

}  // namespace rink::game
