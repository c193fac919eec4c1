// Sessions over a modelled network under a virtual clock: a thread for each peer, of which one runs
// at a time, so that the same seed always goes the same way.
#pragma once

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "game/peer/session/session.h"
#include "rti/transport/modelled/network_model.h"

namespace rink::peer::test {

/// From `from_ns` on and before `until_ns` nothing that sets out between those for whom
/// `is_minority` is true and the others gets there; as TCP does, it is sent again after 0.2,
/// 0.6, 1.4, ... s.
struct Cut {
  std::int64_t from_ns = 0, until_ns = 0;
  std::function<bool(PeerNumber)> is_minority = [](PeerNumber) { return false; };
};

class CutNetwork final : public rti::LinkModel {
 public:
  CutNetwork(const rti::NetworkConditions& conditions, Cut cut)
      : inner_(conditions), cut_(std::move(cut)) {}
  void open_line(std::uint32_t line, const rti::LineIdentity& identity) override {
    inner_.open_line(line, identity);
    // All connect in order of their numbers, each to all below its own.
    const auto listener = static_cast<PeerNumber>(std::stoul(std::string(identity.listener)));
    if (crosses_.size() <= line) crosses_.resize(line + 1);
    crosses_[line] = cut_.is_minority(listener) != cut_.is_minority(listener + 1 + identity.link);
  }
  rti::Delivery deliver(std::uint32_t line, std::int64_t now_ns, std::size_t size) override {
    rti::Delivery delivery = inner_.deliver(line, now_ns, size);
    if (!crosses_[line] || now_ns < cut_.from_ns) return delivery;
    std::int64_t wait_ns = 0;
    for (std::int64_t timeout_ns = rti::NetworkModel::timeout_min_ns;
         now_ns + wait_ns < cut_.until_ns; timeout_ns *= 2)
      wait_ns += timeout_ns;
    delivery.instant_ns += wait_ns;
    return delivery;
  }
  std::int64_t arrival_ns(std::uint32_t line, std::int64_t now_ns, std::size_t size) override {
    return deliver(line, now_ns, size).instant_ns;
  }

 private:
  rti::NetworkModel inner_;
  Cut cut_;
  std::vector<bool> crosses_;  ///< by line
};

/// Lets threads run one at a time, each until it waits.
class Turns {
 public:
  explicit Turns(std::size_t count) : wake_ns_(count, 0), is_over_(count, false), turn_(count) {}

  /// Of a thread: gives its turn back, to have it again when something has come for it or the clock
  /// shows `until_ns`.
  void wait(std::size_t who, std::int64_t until_ns) {
    std::unique_lock lock(mutex_);
    wake_ns_[who] = until_ns;
    turn_ = wake_ns_.size();
    has_changed_.notify_all();
    has_changed_.wait(lock, [&] { return turn_ == who; });
  }
  void await_first(std::size_t who) {
    std::unique_lock lock(mutex_);
    has_changed_.wait(lock, [&] { return turn_ == who; });
  }
  void end(std::size_t who) {
    const std::lock_guard lock(mutex_);
    is_over_[who] = true;
    turn_ = wake_ns_.size();
    has_changed_.notify_all();
  }

  /// Of who keeps the clock: returns when the thread waits again, or has ended.
  void run(std::size_t who) {
    std::unique_lock lock(mutex_);
    turn_ = who;
    has_changed_.notify_all();
    has_changed_.wait(lock, [&] { return turn_ == wake_ns_.size(); });
  }
  std::int64_t wake_ns(std::size_t who) const { return wake_ns_[who]; }
  bool is_over(std::size_t who) const { return is_over_[who]; }

 private:
  std::mutex mutex_;
  std::condition_variable has_changed_;
  std::vector<std::int64_t> wake_ns_;
  std::vector<bool> is_over_;
  std::size_t turn_;  ///< whose it is; the number of threads: the clock's
};

/// One peer's end, with the rules of `rink peer`'s: silence beyond the patience is a loss, and who
/// waits shows signs of life.
class VirtualMail final : public Mail, private rti::TransportListener {
 public:
  VirtualMail(rti::VirtualNetwork& network, Turns& turns, PeerNumber number, PeerNumber count,
              std::int64_t patience_ns)
      : network_(network),
        turns_(turns),
        end_(network),
        number_(number),
        patience_ns_(patience_ns),
        links_(count) {
    end_.listen(std::to_string(number));
  }
  void connect() {
    for (PeerNumber other = 0; other < number_; ++other)
      note(end_.connect(std::to_string(other)), other);
  }
  bool is_connected() const {
    return std::all_of(links_.begin(), links_.end(),
                       [&](const Link& link) { return &link == &links_[number_] || link.is_open; });
  }
  /// Takes what has arrived; answers whether anything had.
  bool poll() {
    if (!end_.has_arrivals()) return false;
    end_.poll({}, *this);
    return true;
  }
  void rest_until(std::int64_t instant_ns) {
    while (network_.now_ns() < instant_ns) turns_.wait(number_, instant_ns);
  }
  /// Good-bye, after the end; or without a word.
  void leave(bool is_in_order) {
    for (PeerNumber to = 0; to < links_.size(); ++to) {
      if (is_in_order) say(to, Kind::farewell, {});
      else if (to != number_) close(to);
    }
  }

  void send(PeerNumber to, std::vector<std::uint8_t> bytes) override { say(to, Kind::mail, bytes); }
  std::vector<std::uint8_t> receive(PeerNumber from) override {
    return receive_any({&from, 1}).second;
  }
  std::pair<PeerNumber, std::vector<std::uint8_t>> receive_any(
      std::span<const PeerNumber> from) override {
    const std::int64_t begin_ns = network_.now_ns();
    for (;;) {
      for (PeerNumber peer = 0; peer < links_.size(); ++peer)
        if (!links_[peer].loss.empty() && !links_[peer].is_parted)
          throw PeerGone(peer, false, links_[peer].loss);
      for (const PeerNumber peer : from)
        if (!links_[peer].inbox.empty()) {
          std::vector<std::uint8_t> first = std::move(links_[peer].inbox.front());
          links_[peer].inbox.pop_front();
          return {peer, std::move(first)};
        }
      for (const PeerNumber peer : from)
        if (links_[peer].has_finished)
          throw PeerGone(peer, true, "peer " + std::to_string(peer) + " has left");
      const auto give_up_at = [&](PeerNumber peer) {
        return std::max(begin_ns, links_[peer].heard_ns) + patience_ns_;
      };
      const PeerNumber last = *std::ranges::min_element(from, {}, give_up_at);
      const std::int64_t give_up_ns = give_up_at(last);
      if (network_.now_ns() >= give_up_ns) {
        links_[last].loss = "peer " + std::to_string(last) + " has said nothing for " +
                            std::to_string(patience_ns_ / 1'000'000) + " ms";
        continue;
      }
      if (network_.now_ns() >= sign_ns_) {
        for (PeerNumber to = 0; to < links_.size(); ++to) say(to, Kind::sign, {});
        sign_ns_ = network_.now_ns() + patience_ns_ / 4;
      }
      turns_.wait(number_, std::min(give_up_ns, sign_ns_));
    }
  }
  void part(PeerNumber peer, bool is_lost) override {
    links_[peer].is_parted = true;
    if (is_lost) close(peer);
  }
  void rejoin(PeerNumber peer) override { links_[peer].is_parted = false; }

 private:
  enum class Kind : std::uint8_t { greeting, mail, sign, farewell };
  static constexpr PeerNumber nobody = 0xffffffffu;
  struct Link {
    rti::ConnectionId connection = 0;
    bool is_open = false, is_parted = false, has_finished = false;
    std::string loss;
    std::int64_t heard_ns = 0;
    std::vector<std::uint8_t> stream;
    std::deque<std::vector<std::uint8_t>> inbox;
  };

  void close(PeerNumber peer) {
    if (std::exchange(links_[peer].is_open, false)) end_.close(links_[peer].connection);
  }
  void say(PeerNumber to, Kind kind, const std::vector<std::uint8_t>& content) {
    if (!links_[to].is_open) return;
    std::array<std::uint8_t, 5> head{};
    const auto size = static_cast<std::uint32_t>(content.size());
    std::memcpy(head.data(), &size, sizeof size);
    head[4] = static_cast<std::uint8_t>(kind);
    const std::array<rti::Bytes, 2> parts{std::as_bytes(std::span(head)),
                                          std::as_bytes(std::span(content))};
    end_.send(links_[to].connection, parts);
  }
  void note(rti::ConnectionId connection, PeerNumber other) {
    if (others_.size() <= connection) others_.resize(connection + 1, nobody);
    others_[connection] = other;
    if (other != nobody) links_[other].connection = connection;
  }
  void on_open(rti::ConnectionId connection) override {
    if (connection >= others_.size() || others_[connection] == nobody)
      return note(connection, nobody);
    links_[others_[connection]].is_open = true;
    say(others_[connection], Kind::greeting, {static_cast<std::uint8_t>(number_)});
  }
  void on_bytes(rti::ConnectionId connection, rti::Bytes bytes) override {
    constexpr std::size_t head = 5;
    if (others_[connection] == nobody)
      note(connection, static_cast<PeerNumber>(bytes[head])),
          links_[others_[connection]].is_open = true, bytes = bytes.subspan(head + 1);
    Link& link = links_[others_[connection]];
    link.heard_ns = network_.now_ns();
    const auto* from = reinterpret_cast<const std::uint8_t*>(bytes.data());
    link.stream.insert(link.stream.end(), from, from + bytes.size());
    for (std::uint32_t size = 0; link.stream.size() >= head;
         link.stream.erase(link.stream.begin(), link.stream.begin() + head + size)) {
      std::memcpy(&size, link.stream.data(), sizeof size);
      if (link.stream.size() < head + size) return;
      if (link.stream[4] == static_cast<std::uint8_t>(Kind::mail))
        link.inbox.emplace_back(link.stream.begin() + head, link.stream.begin() + head + size);
      link.has_finished =
          link.has_finished || link.stream[4] == static_cast<std::uint8_t>(Kind::farewell);
    }
  }
  void on_close(rti::ConnectionId connection, rti::CloseReason reason,
                const std::string&) override {
    Link& link = links_[others_[connection]];
    link.is_open = false;
    if (!link.has_finished && link.loss.empty())
      link.loss =
          "peer " + std::to_string(others_[connection]) + " is gone: " + rti::to_string(reason);
  }

  rti::VirtualNetwork& network_;
  Turns& turns_;
  rti::VirtualEndpoint end_;
  PeerNumber number_;
  std::int64_t patience_ns_, sign_ns_ = 0;
  std::vector<Link> links_;         ///< by peer
  std::vector<PeerNumber> others_;  ///< by connection
};

}  // namespace rink::peer::test
