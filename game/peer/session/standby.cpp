// Sends and receives records of parts, and snapshots in pieces.
#include "game/peer/session/standby.h"

#include <cassert>
#include <optional>
#include <string>
#include <utility>

#include "game/peer/session/others_states.h"
#include "game/peer/session/part_change.h"
#include "game/peer/standby/known_bodies.h"
#include "game/peer/standby/packed_states.h"

namespace rink::peer {

namespace {

/// Nobody has bodies beyond its halo, but in a group with others. The first that is so far, or
/// nothing.
std::optional<std::uint32_t> first_far(const std::vector<Handover::Body>& bodies, double time,
                                       const Halos& halos, PeerNumber peer) {
  constexpr double rounding = 1e-6;  // m: far more than a place is rounded by
  for (const auto& [body, state] : bodies) {
    const Box place = Box::around(place_of(state, time), state.extent()).grown(rounding);
    if (state.flags == 0 && !halos.is_near(peer, place)) return body;
  }
  return std::nullopt;
}

}  // namespace

void Standby::begin_others(const Start& start, const State& now) {
  replicas_.begin(start, now, settings_.halo, inbox_.validator());
}

void Standby::begin_own(PartLog& log) {
  log.begin(inbox_.validator());
  replicas_.of(settings_.number).begin(log.snapshot());
}

void Standby::enter(const State& now, PartLog& log) {
  StandbyCopy& own = replicas_.of(settings_.number);
  own.add(PartRecord{.step = now.step, .piece_count = 1, .time = now.time});
  own.add(log.snapshot());
}

void Standby::pass(const Step& step, Peer& peer, PartRecord record) {
  const PeerNumber own = settings_.number;
  const auto& [now, next, is_anew] = step;
  record.step = next.step, record.time = next.time;
  const PeerNumber keeper = next.has(own) ? Replicas::keeper_of(own, next).value_or(own) : own;
  const bool is_kept = keeper != own;  // else nobody else is left
  const bool is_first =
      is_anew || (is_kept && (keeper != Replicas::keeper_of(own, now) || now.is_fresh(own)));
  note_own(step, peer.part_log(), record, is_first);
  if (is_kept) {
    leave_out_known(record, keeper, peer.share(), inbox_.validator());
    tell(keeper, std::move(record), is_first);
  } else {
    feed_.take(true);
  }
  for (const PeerNumber from : next.members)
    if (from != own && now.has(from) && replicas_.keeps(from, next)) hear(from, step, peer);
  replicas_.drop_others(now, next);
}

void Standby::note_own(const Step& step, PartLog& log, const PartRecord& record, bool is_first) {
  StandbyCopy& copy = replicas_.of(settings_.number);
  feed_.note(record);
  [[maybe_unused]] const bool is_next = copy.add(record);
  assert(is_next);
  if (!is_first && !feed_.is_due()) return;
  snapshots_ += !is_first;
  PartSnapshot whole = log.snapshot();
  if (is_first) whole.is_first = true, whole.log = copy.log();
  feed_.begin(step.next.step, written(whole));
  copy.add(std::move(whole));
}

void Standby::tell(PeerNumber keeper, PartRecord record, bool is_first) {
  assert(keeper != settings_.number);
  std::vector<SnapshotPiece> pieces = feed_.take(is_first);
  record.piece_count = static_cast<std::uint32_t>(pieces.size());
  const auto send = [&](std::vector<std::uint8_t> bytes) {
    bytes_ += bytes.size();
    mail_.send(keeper, std::move(bytes));
  };
  send(written(std::move(record)));
  for (SnapshotPiece& piece : pieces) send(written(std::move(piece)));
}

void Standby::hear(PeerNumber from, const Step& step, const Peer& peer) {
  const auto& [now, next, is_anew] = step;
  const Validator& scene = inbox_.validator();
  auto record = inbox_.received<PartRecord>(from, now);
  record.time = next.time;
  if (const std::string fault = put_back_known(record, peer.share(), scene); !fault.empty())
    inbox_.give_up(from, fault);
  if (const std::string fault = fault_of(record, scene, now.time, next.time); !fault.empty())
    inbox_.give_up(from, fault);
  const auto bodies = unpacked(record.committed.states, scene);
  if (const auto body = first_far(*bodies, next.time, peer.halos(), from))
    inbox_.give_up(
        from, "sends body " + std::to_string(*body) + " as its own, which is in another's zone");
  if (const std::string fault = fault_of_record(peer.share(), from, record, *bodies);
      !fault.empty())
    inbox_.give_up(from, fault);
  const std::uint32_t piece_count = record.piece_count;
  StandbyCopy& copy = replicas_.of(from);
  const bool is_next = record.step == next.step && copy.add(std::move(record));
  for (std::uint32_t piece = 0; piece < piece_count && is_next; ++piece) {
    const std::string fault = copy.add(inbox_.received<SnapshotPiece>(from, now), scene);
    if (!fault.empty()) inbox_.give_up(from, fault);
  }
  if (!is_next || !copy.is_at(next.step))
    inbox_.give_up(from, "sent what is not its part at step " + std::to_string(next.step));
}

std::vector<Part> Standby::played_parts(const State& now, const physics::WorldSpec& spec,
                                        std::vector<Key>& inherited) const {
  std::vector<Part> parts;
  const Division division = now.division();
  for (const PeerNumber peer : Replicas::parts_of(settings_.number, now, inbox_.losses())) {
    const StandbyCopy& copy = replicas_.of(peer);
    if (!copy.is_at(now.step))
      inbox_.halt("the copy of what peer " + std::to_string(peer) + " had is not of step " +
                  std::to_string(now.step));
    parts.push_back(copy.part(spec, inbox_.validator(), division, peer));
    if (peer == settings_.number) continue;
    if (settings_.losses.are_set())
      settings_.losses.when_taken_over(peer, parts.back(), copy.last_keys());
    const std::vector<Key> log = copy.log();
    inherited.insert(inherited.end(), log.begin(), log.end());
  }
  return parts;
}

}  // namespace rink::peer
