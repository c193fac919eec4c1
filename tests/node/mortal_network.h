// A node's network for tests, by TCP, that dies or falls silent with a certain word.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "game/net/peer/network/peer_network.h"
#include "game/node/match/last_words.h"
#include "game/node/socket_meeting.h"
#include "game/peer/message_bytes.h"

namespace rink::game {

/// When the node dies, counted in words of mail that it has sent; and what is left of it.
struct Mortality {
  static constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last_word = never;
  bool is_frozen = false;            ///< instead it says nothing until `thaw`
  std::atomic<bool> is_due = false;  ///< or as soon as it looks at its network
  std::atomic<bool> is_dead = false, is_thawed = false;
  std::atomic<std::uint64_t> words = 0;  ///< that it has sent
  /// What it says of lost nodes instead of the truth, if anything.
  std::function<void(LastWords&)> lie{};
};

/// What dies takes no leave: its connections close, as those of a killed process.
class MortalNetwork final : public SessionNetwork {
 public:
  MortalNetwork(std::unique_ptr<SessionNetwork> network, Mortality& mortality)
      : network_(std::move(network)), mortality_(mortality) {}

  const Terms& terms() const override { return network_->terms(); }
  peer::PeerNumber number() const override { return network_->number(); }
  const std::vector<PeerInfo>& peer_infos() const override { return network_->peer_infos(); }
  void gather() override { network_->gather(); }
  void begin() override { network_->begin(); }
  void note_window() override { network_->note_window(); }
  void rest_until(double time_s) override {
    listen();
    network_->rest_until(time_s);
  }
  std::optional<std::vector<std::uint8_t>> next_mail(peer::PeerNumber from) override {
    listen();
    return network_->next_mail(from);
  }
  void defer(peer::PeerNumber from, std::vector<std::uint8_t> bytes) override {
    network_->defer(from, std::move(bytes));
  }
  rti::TransportCounters sent_to(peer::PeerNumber member) const override {
    return network_->sent_to(member);
  }
  void leave(const Farewell& farewell) override {
    if (mortality_.is_dead) static_cast<PeerNetwork&>(*network_).abandon();
    else network_->leave(farewell);
  }
  void send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override {
    live();
    if (LastWords last; mortality_.lie && peer::read_whole(bytes, last)) {
      mortality_.lie(last);
      bytes = peer::bytes_from(last);
    }
    network_->send(to, std::move(bytes));
  }
  std::vector<std::uint8_t> receive(peer::PeerNumber from) override {
    listen();
    return network_->receive(from);
  }
  std::pair<peer::PeerNumber, std::vector<std::uint8_t>> receive_any(
      std::span<const peer::PeerNumber> from) override {
    listen();
    return network_->receive_any(from);
  }
  void part(peer::PeerNumber peer, bool is_lost) override { network_->part(peer, is_lost); }
  void rejoin(peer::PeerNumber peer) override { network_->rejoin(peer); }
  void send_aside(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override {
    network_->send_aside(to, std::move(bytes));
  }

 private:
  void live() {
    if (mortality_.words++ >= mortality_.last_word) die();
  }
  void die() {
    mortality_.is_dead = !mortality_.is_frozen;
    if (mortality_.is_dead) throw std::runtime_error("dead");
    while (!mortality_.is_thawed) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void listen() {
    if (mortality_.is_due) die();
    network_->receive_aside = receive_aside;
    network_->before_wait = [this] {
      if (mortality_.is_due) die();
      return before_wait ? before_wait() : std::numeric_limits<double>::infinity();
    };
  }

  std::unique_ptr<SessionNetwork> network_;
  Mortality& mortality_;
};

class MortalMeeting final : public Meeting {
 public:
  MortalMeeting(std::unique_ptr<SocketMeeting> meeting, Mortality& mortality)
      : meeting_(std::move(meeting)), mortality_(mortality) {}

  std::optional<Place> place() const override { return meeting_->place(); }
  std::unique_ptr<SessionNetwork> enter(PeerNetworkSettings self, double (*now_s)()) override {
    return std::make_unique<MortalNetwork>(meeting_->enter(std::move(self), now_s), mortality_);
  }

 private:
  std::unique_ptr<SocketMeeting> meeting_;
  Mortality& mortality_;
};

}  // namespace rink::game
