// Sends messages as frames, turns instants into latencies, and notes changes of a player's scope.
#include "loadgen/run/peers/peer_station.h"

#include <cstring>

namespace rink::loadgen {

PeerStation::PeerStation(const game::SharedGame& game, const game::InterestSettings& settings,
                         const peer::Division& division, peer::PeerNumber number,
                         const PeerMeasuring& measuring)
    : clock_(measuring.clock),
      measurements_(measuring.measurements),
      rate_hz_(settings.rate_hz),
      readers_(division.peer_count()),
      outboxes_(division.peer_count()),
      probe_(measurements_),
      node_(game, settings, division, number,
            [this](peer::PeerNumber to, game::Traffic about,
                   const std::vector<std::uint8_t>& content) {
              const std::vector<std::byte> frame =
                  game::framed(game::FrameKind::mail, game::with_purpose(about, content));
              std::vector<std::uint8_t>& outbox = outboxes_[to];
              const std::size_t before = outbox.size();
              outbox.resize(before + frame.size());
              std::memcpy(outbox.data() + before, frame.data(), frame.size());
            }) {
  node_.on_final = [this] { probe_.keys_felt(clock_.now_s, node_.interest().felt()); };
  node_.on_commit = [this] { note_commit(); };
}

void PeerStation::watch() { recorder_.emplace(node_.interest()); }

void PeerStation::press(double instant) {
  const bool is_counted = measurements_.is_counted(instant);
  measurements_.keys_due += is_counted;
  node_.press();
  probe_.key_sent(clock_.start_s + instant, clock_.now_s, is_counted);
}

void PeerStation::receive(peer::PeerNumber from, rti::Bytes bytes) {
  game::FrameQueue& reader = readers_[from];
  reader.add(bytes);
  while (auto frame = reader.next(game::peer_frame_max)) {
    const bool is_mail = frame->kind == game::FrameKind::mail && !frame->content.empty() &&
                         frame->content[0] < game::traffic_count;
    if (!is_mail ||
        !node_.receive(from, static_cast<game::Traffic>(frame->content[0]),
                       std::vector<std::uint8_t>(frame->content.begin() + 1, frame->content.end())))
      throw peer::ProtocolError("peer " + std::to_string(from) + " sent what is no message");
  }
  if (reader.is_broken())
    throw peer::ProtocolError("peer " + std::to_string(from) + " sent what is no frame");
}

/// All of a window is known, which counts as an update does for a client.
void PeerStation::note_commit() {
  const double simulated_s = node_.windows_final() / rate_hz_;
  probe_.news_applied(clock_.start_s + simulated_s, clock_.now_s,
                      measurements_.is_counted(simulated_s));
  probe_.keys_felt(clock_.now_s, node_.interest().felt());
  constexpr double rounding_s = 1e-9;
  known_ += measurements_.is_counted(simulated_s);
  on_time_ += measurements_.is_counted(simulated_s) &&
              clock_.simulated_s() <= simulated_s + 1.0 / rate_hz_ + rounding_s;
  if (recorder_) recorder_->note_commit(clock_.simulated_s(), simulated_s);
}

}  // namespace rink::loadgen
