// Plays windows as their ends come, and updates players' interest around them.
#include "game/net/peer/peer_node.h"

#include <utility>

#include "game/net/peer/network/frames.h"
#include "game/peer/standby/known_bodies.h"
#include "game/peer/standby/part_at_start.h"

namespace rink::game {

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
      interest_({game.scene(), game.start(), game.extent_max()}, settings, *peer_, division_,
                [this](peer::PeerNumber to, Traffic about, std::vector<std::uint8_t> bytes) {
                  count_and_send(to, about, std::move(bytes));
                }),
      validator_(game.start().world()) {
  play_.on_final = [this] { finish(); };
  play_.on_commit = [this] {
    interest_.note_places();
    ++committed_;
    tell_standby();
    if (!hear_standby()) throw peer::ProtocolError("a peer told its standby what cannot be");
    if (on_commit) on_commit();
    if (waiting_ > 0) --waiting_, play_next();
  };
  peer_->begin(end_of(1));
  peer_->part_log().begin(validator_);
  const peer::PeerNumber count = division_.peer_count();
  kept_.begin(peer::part_at_start(game.start().world(), division_, (number + count - 1) % count,
                                  peer_->halos().own(), validator_));
  interest_.note_places();
}

void PeerNode::count_and_send(peer::PeerNumber to, Traffic about,
                              std::vector<std::uint8_t> content) {
  sent_[static_cast<std::size_t>(about)] += framed_size(1 + content.size());
  ++messages_sent_[static_cast<std::size_t>(about)];
  send_(to, about, std::move(content));
}

/// As peer::Session does, to the next peer in the ring: each has a zone, and none is ever lost.
void PeerNode::tell_standby() {
  const peer::PeerNumber count = division_.peer_count(), to = (peer_->number() + 1) % count;
  if (count == 1) return;
  peer::PartRecord record = peer_->part_log().record();
  record.step = final_;
  feed_.note(record);
  if (feed_.is_due()) feed_.begin(final_, written(peer_->part_log().snapshot()));
  std::vector<peer::SnapshotPiece> pieces = feed_.take(false);
  record.piece_count = static_cast<std::uint32_t>(pieces.size());
  leave_out_known(record, to, peer_->share(), validator_);
  count_and_send(to, Traffic::standby, written(std::move(record)));
  for (peer::SnapshotPiece& piece : pieces)
    count_and_send(to, Traffic::standby, written(std::move(piece)));
}

/// A record waits until this peer is at its step, and the pieces that follow it wait with it.
bool PeerNode::hear_standby() {
  for (; !unheard_.empty(); unheard_.pop_front()) {
    if (pieces_due_ > 0) {
      peer::SnapshotPiece piece;
      if (!read(unheard_.front(), piece) || !kept_.add(std::move(piece), validator_).empty())
        return false;
      --pieces_due_;
      continue;
    }
    peer::PartRecord record;
    if (!read(unheard_.front(), record) || record.step < committed_) return false;
    if (record.step > committed_) return true;
    record.time = end_of(record.step);
    pieces_due_ = record.piece_count;
    if (!put_back_known(record, peer_->share(), validator_).empty() ||
        !fault_of(record, validator_, end_of(record.step - 1), record.time).empty() ||
        !kept_.add(std::move(record)))
      return false;
  }
  return true;
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
  if (about == Traffic::standby) {
    if ((from + 1) % division_.peer_count() != peer_->number()) return false;
    unheard_.push_back(std::move(content));
    return hear_standby();
  }
  const bool is_of_windows =
      about == Traffic::halo || about == Traffic::claims || about == Traffic::agreement;
  if (!is_of_windows) return interest_.receive(from, about, std::as_bytes(std::span(content)));
  play_.receive(from, std::move(content));
  return true;
}

}  // namespace rink::game
