// Messages as frames, instants as latencies, and a player's scope as changes.
#include "loadgen/peer_station.h"

#include <algorithm>
#include <cstring>

namespace rink::loadgen {

namespace {

constexpr double window_s = 0.05;  ///< over which updates are counted for a sample: that of BotsWitness

}  // namespace

PeerStation::PeerStation(const game::SharedGame& game, const game::NodeSettings& settings, const peer::Division& division, peer::PeerNumber number, const RunClock& clock,
                         Measurements& measurements)
    : clock_(clock),
      measurements_(measurements),
      rate_hz_(settings.rate_hz),
      readers_(division.peer_count()),
      outboxes_(division.peer_count()),
      probe_(measurements),
      node_(game, settings, division, number, [this](peer::PeerNumber to, game::Traffic about, const std::vector<std::uint8_t>& content) {
        std::vector<std::uint8_t> words(content.size() + 1);
        words[0] = static_cast<std::uint8_t>(about);
        if (!content.empty()) std::memcpy(words.data() + 1, content.data(), content.size());
        const std::vector<std::uint8_t> frame = game::framed(game::FrameKind::mail, words);
        std::vector<std::uint8_t>& outbox = outboxes_[to];
        const std::size_t before = outbox.size();
        outbox.resize(before + frame.size());
        std::memcpy(outbox.data() + before, frame.data(), frame.size());
      }) {
  node_.on_final = [this] { probe_.batch_applied(clock_.now_s, clock_.now_s, node_.felt(), false); };
  node_.on_commit = [this] { note_commit(); };
}

void PeerStation::watch() { evidence_.emplace().bot.object = node_.bat(); }

void PeerStation::press(double instant) {
  const bool is_counted = measurements_.is_counted(instant);
  measurements_.keys_due += is_counted;
  node_.press();
  probe_.key_sent(clock_.start_s + instant, clock_.now_s, is_counted);
}

void PeerStation::hear(peer::PeerNumber from, rti::Bytes bytes) {
  game::FrameReader& reader = readers_[from];
  reader.add(bytes);
  while (auto frame = reader.next(game::peer_frame_max)) {
    const bool is_mail = frame->kind == game::FrameKind::mail && !frame->content.empty() && frame->content[0] < game::traffic_count;
    if (!is_mail || !node_.hear(from, static_cast<game::Traffic>(frame->content[0]), std::vector<std::uint8_t>(frame->content.begin() + 1, frame->content.end())))
      throw peer::ProtocolError("peer " + std::to_string(from) + " sent what is no message");
  }
  if (reader.is_broken()) throw peer::ProtocolError("peer " + std::to_string(from) + " sent what is no frame");
}

/// All of a window is known: as old as it is now, it is what an update is to a client.
void PeerStation::note_commit() {
  const double simulated_s = node_.windows_final() / rate_hz_;
  probe_.batch_applied(clock_.start_s + simulated_s, clock_.now_s, node_.felt(), measurements_.is_counted(simulated_s));
  matched_s_ = simulated_s;
  constexpr double rounding_s = 1e-9;
  known_ += measurements_.is_counted(simulated_s);
  on_time_ += measurements_.is_counted(simulated_s) && clock_.simulated_s() <= simulated_s + 1.0 / rate_hz_ + rounding_s;
  if (evidence_) note_scope();
}

void PeerStation::note_scope() {
  node_.list_scope(listed_);
  std::sort(listed_.begin(), listed_.end());
  const double instant_s = clock_.simulated_s();
  const auto note = [&](const std::vector<std::uint32_t>& these, const std::vector<std::uint32_t>& others, bool is_in) {
    for (const std::uint32_t body : these)
      if (!std::binary_search(others.begin(), others.end(), body)) evidence_->bot.changes.push_back({instant_s, body, is_in});
  };
  note(scope_, listed_, false);
  note(listed_, scope_, true);
  scope_ = listed_;
  matched_.clear();
  for (const std::uint32_t body : scope_) matched_.push_back(node_.position_at(body, matched_s_));
  for (const game::PlayerPicture::Heard& heard : node_.picture().heard()) received_.push_back({instant_s, heard});
  node_.picture().forget_heard();
}

void PeerStation::sample() {
  const double now_s = clock_.simulated_s();
  std::erase_if(received_, [&](const auto& heard) { return heard.first <= now_s - window_s; });
  const std::size_t first = evidence_->beliefs.size();
  for (std::size_t k = 0; k < scope_.size(); ++k)
    evidence_->beliefs.push_back({.object = scope_[k], .bytes = 0, .is_in_scope = true, .matched = matched_[k], .displayed = node_.position_at(scope_[k], now_s)});
  for (const auto& [instant_s, heard] : received_) {
    const auto place = std::lower_bound(scope_.begin(), scope_.end(), heard.body);
    if (place != scope_.end() && *place == heard.body) evidence_->beliefs[first + static_cast<std::size_t>(place - scope_.begin())].bytes += heard.bytes;
    else evidence_->beliefs.push_back({.object = heard.body, .bytes = heard.bytes});
  }
  evidence_->samples.push_back({.bot = 0, .displayed_s = now_s, .matched_s = matched_s_, .window_s = window_s, .first = first, .last = evidence_->beliefs.size()});
}

}  // namespace rink::loadgen
