// Presses keys and takes samples at their instants, while the peer waits for mail.
#include "game/net/peer/run_recorder.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "game/net/peer/network/frames.h"

namespace rink::game {

void RunRecorder::CountedMail::send(peer::PeerNumber to, std::vector<std::uint8_t> content) {
  bytes[static_cast<std::size_t>(about)] += framed_size(content.size());
  ++messages[static_cast<std::size_t>(about)];
  network_.send(to, std::move(content));
}

RunRecorder::RunRecorder(const SharedGame& game, const InterestSettings& settings,
                         PeerNetwork& network, const SamplingSettings& sampling, double (*now_s)())
    : Viewer(game, settings, network),
      network_(network),
      sampling_(sampling),
      now_s_(now_s),
      rate_hz_(settings.rate_hz),
      mail_(network),
      bats_(settings.bats) {
  trace_.peer = network.number(), trace_.peer_count = network.terms().peer_count;
  const std::vector<std::uint32_t> players = sampled_players(sampling);
  for (const std::uint32_t player : players)
    for (peer::PeerNumber peer = 0; peer < bats_.size(); ++peer)
      if (bats_[peer] == game.start().bat(player)->index) watched_.push_back(peer);
  decisions_ = sampled_instants(sampling, 1);
  if (std::find(watched_.begin(), watched_.end(), network.number()) != watched_.end())
    samples_ = sampled_instants(sampling, 2);
  const std::optional<std::uint32_t> own = game.start().entity({bats_[network.number()]}).player;
  for (const InputEvent& key : game.keys())
    if (own && key.player == *own && key.time < sampling.until_s) keys_.push_back(key.time);
}

RunRecorder::~RunRecorder() { network_.before_wait = {}; }

void RunRecorder::begin(const peer::Session& session) {
  Viewer::begin(session);
  session_ = &session;
  if (!samples_.empty()) player_.emplace(interest());
  on_final = [this] {
    if (const std::uint32_t felt = interest().felt(); std::exchange(felt_, felt) != felt)
      trace_.events.push_back({PeerTrace::Kind::final, simulated_s(), simulated_s(), felt});
  };
  on_commit = [this] {
    const double end_s = static_cast<double>(windows()) / rate_hz_, now_s = simulated_s();
    felt_ = interest().felt();
    trace_.events.push_back({PeerTrace::Kind::known, end_s, now_s, felt_});
    if (player_) player_->note_commit(now_s, end_s);
  };
  network_.before_wait = [this] { return attend(); };
}

void RunRecorder::when_sending(peer::Subject about) { mail_.about = traffic_of(about); }

/// Does what is due, and returns when it must be called again.
double RunRecorder::attend() {
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto next = [](const std::vector<double>& instants, std::size_t k) {
    return k < instants.size() ? instants[k] : never;
  };
  const double now_s = simulated_s();
  if (!has_begun_ && now_s >= sampling_.from_s) has_begun_ = true, trace_.begin = load();
  if (!has_ended_ && now_s >= sampling_.until_s) has_ended_ = true, trace_.end = load();
  for (; next(keys_, next_key_) <= now_s; ++next_key_) {
    interest().press();
    trace_.events.push_back({PeerTrace::Kind::key, keys_[next_key_], simulated_s(), 0});
  }
  for (; next(decisions_, next_decision_) <= now_s; ++next_decision_)
    note_decisions(decisions_[next_decision_]);
  for (; player_ && next(samples_, next_sample_) <= now_s; ++next_sample_)
    player_->sample(simulated_s());
  const double begins_s = has_begun_ ? never : sampling_.from_s,
               ends_s = has_ended_ ? never : sampling_.until_s;
  return start_s_ + std::min({next(keys_, next_key_), next(decisions_, next_decision_),
                              next(samples_, next_sample_), begins_s, ends_s});
}

/// Notes the own bodies in each player's scope, by the latest decision.
void RunRecorder::note_decisions(double instant_s) {
  for (const peer::PeerNumber peer : watched_) {
    PeerTrace::Decision decision{instant_s, peer, {}};
    for (const std::uint32_t body : interest().sender().scope_of(peer))
      if (interest().owns(body)) decision.bodies.push_back(body);
    if (!decision.bodies.empty()) trace_.decisions.push_back(std::move(decision));
  }
}

PeerLoad RunRecorder::load() const {
  PeerLoad load;
  load.instant_s = simulated_s();
  for (std::size_t k = 0; k < traffic_count; ++k) {
    load.messages[k] = mail_.messages[k] + messages_sent()[k];
    load.bytes[k] = mail_.bytes[k] + framed_bytes()[k];
  }
  const rti::TransportCounters counters = network_.transported();
  load.bytes_sent = counters.bytes_sent, load.bytes_received = counters.bytes_received,
  load.writes = counters.writes, load.segments = counters.segments_sent;
  load.acknowledgements = counters.acknowledgements_sent,
  load.kernel_segments = counters.kernel_segments_sent.value_or(counters.segments_sent);
  const peer::PeerCounters played = session_->counters().peer;
  load.events = played.own_events + played.ghost_events;
  return load;
}

void RunRecorder::end() {
  attend();
  if (!has_ended_) trace_.end = load();
  if (player_) trace_.player = player_->trace();
  player_.reset();
  network_.before_wait = {};
  Viewer::end();
}

}  // namespace rink::game
