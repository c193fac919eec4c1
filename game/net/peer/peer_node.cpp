// Plays windows as their ends come, and updates players' interest around them.
#include "game/net/peer/peer_node.h"

#include <utility>

namespace rink::game {

namespace {}  // namespace

PeerNode::PeerNode(const SharedGame& game, const InterestSettings& settings,
                   const peer::Division& division, peer::PeerNumber number, Send send)
    : rate_hz_(settings.rate_hz),
      division_(division),
      send_(std::move(send)),
      peer_(game.peer(division, number, 1.0 / settings.rate_hz)),
      play_(*peer_, division.peer_count(),
            [this](peer::PeerNumber to, peer::Subject about, std::vector<std::uint8_t> bytes) {
              count_and_send(to, traffic_of(about), std::move(bytes));
            }),
      interest_(game.start(), settings, *peer_, division_,
                [this](peer::PeerNumber to, Traffic about, std::vector<std::uint8_t> bytes) {
                  count_and_send(to, about, std::move(bytes));
                }) {
  play_.on_final = [this] { finish(); };
  play_.on_commit = [this] {
    interest_.note_places();
    if (on_commit) on_commit();
    if (waiting_ > 0) --waiting_, play_next();
  };
  peer_->begin(end_of(1));
  interest_.note_places();
}

void PeerNode::count_and_send(peer::PeerNumber to, Traffic about,
                              std::vector<std::uint8_t> content) {
  sent_[static_cast<std::size_t>(about)] += content.size();
  ++messages_sent_[static_cast<std::size_t>(about)];
  send_(to, about, std::move(content));
}

void PeerNode::due() {
  if (is_idle()) play_next();
  else ++waiting_;
}

void PeerNode::play_next() {
  interest_.begin_window();
  ++begun_;
  play_.begin(end_of(begun_ + 1));
  interest_.look_around();
}

/// All peers have accepted.
void PeerNode::finish() {
  ++final_;
  interest_.finish(final_);
  if (on_final) on_final();
}

bool PeerNode::receive(peer::PeerNumber from, Traffic about, std::vector<std::uint8_t> content) {
  const bool is_of_windows =
      about == Traffic::halo || about == Traffic::claims || about == Traffic::agreement;
  if (!is_of_windows) return interest_.receive(from, about, std::as_bytes(std::span(content)));
  play_.receive(from, std::move(content));
  return true;
}

}  // namespace rink::game
