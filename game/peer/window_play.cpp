// Runs the steps of play_window, each when the messages of all peers are there.
#include "game/peer/window_play.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "im/basics/checked.h"

namespace rink::peer {

template <class Make>
void WindowPlay::send_to_all(Subject about, Make&& make) {
  for (PeerNumber to = 0; to < peer_count_; ++to)
    if (to != peer_.number()) send_(to, about, written(make(to)));
}

template <class Message>
void WindowPlay::receive_from_all() {
  for (PeerNumber from = 0; from < peer_count_; ++from) {
    if (from == peer_.number()) continue;
    assert(!inboxes_[from].empty());
    Message message;
    if (!read(inboxes_[from].front(), message))
      throw ProtocolError("peer " + std::to_string(from) + " sent what is no message");
    inboxes_[from].pop_front();
    received_ -= inboxes_[from].empty();
    peer_.receive(from, std::move(message));
  }
  if (peer_.accusation().is_made()) throw ProtocolError(peer_.accusation().text());
}

void WindowPlay::begin(double next) {
  assert(!is_playing() && std::isfinite(next) && next > peer_.end());
  next_ = next;
  peer_.play();
  send_to_all(Subject::claims, [&](PeerNumber to) { return peer_.claims_for(to); });
  step_ = Step::claims;
  go_on();
}

void WindowPlay::receive(PeerNumber from, std::vector<std::uint8_t> bytes) {
  assert(from < peer_count_ && from != peer_.number());
  received_ += inboxes_[from].empty();
  inboxes_[from].push_back(std::move(bytes));
  go_on();
}

void WindowPlay::go_on() {
  while (is_playing() && received_ + 1 == peer_count_) advance();
  if constexpr (checks_whole_structures) check();
}

void WindowPlay::check() const {
  assert(inboxes_.size() == peer_count_ && inboxes_[peer_.number()].empty());
  assert(received_ == static_cast<PeerNumber>(std::ranges::count_if(
                          inboxes_, [](const auto& inbox) { return !inbox.empty(); })));
  assert((!is_playing() || received_ + 1 < peer_count_) && "what all have said was taken at once");
}

void WindowPlay::advance() {
  switch (step_) {
    case Step::resting:
      return;
    case Step::claims:
      receive_from_all<Claims>();
      peer_.judge();
      if (peer_.accusation().is_made()) throw ProtocolError(peer_.accusation().text());
      send_to_all(Subject::verdict, [&](PeerNumber) { return peer_.verdicts().own(); });
      step_ = Step::verdicts;
      return;
    case Step::verdicts:
      receive_from_all<Verdict>();
      if (peer_.conclude() == Outcome::final) {
        send_to_all(Subject::handover,
                    [&](PeerNumber to) { return peer_.handover_for(to, next_); });
        step_ = Step::handover;
        if (on_final) on_final();
      } else {
        send_to_all(Subject::handover, [&](PeerNumber to) {
          return peer_.verdicts().repeats(to) ? peer_.handover_for(to) : Handover{};
        });
        step_ = Step::repeats;
      }
      return;
    case Step::repeats:
      receive_from_all<Handover>();
      if (peer_.verdicts().repeats(peer_.number())) peer_.replay();
      send_to_all(Subject::claims, [&](PeerNumber to) { return peer_.claims_for(to); });
      step_ = Step::claims;
      return;
    case Step::handover:
      receive_from_all<Handover>();
      peer_.commit(next_);
      step_ = Step::resting;
      if (on_commit) on_commit();
      return;
  }
}

}  // namespace rink::peer
