// Keeps a snapshot and the records since, until a newer one has come.
#include "game/peer/standby/standby_copy.h"

#include <cassert>
#include <utility>

#include "im/basics/checked.h"

namespace rink::peer {

namespace {

void add_keys(const PartRecord& record, std::vector<Key>& log) {
  for (const std::vector<Key>* keys : {&record.own_keys, &record.inherited})
    log.insert(log.end(), keys->begin(), keys->end());
}

}  // namespace

void StandbyCopy::begin(PartSnapshot start) {
  *this = {};
  base_ = Mark{.step = 0, .time = 0.0, .part = std::move(start)};
}

std::optional<std::uint64_t> StandbyCopy::last_step() const {
  if (!records_.empty()) return records_.back().step;
  if (next_) return next_->step;
  if (base_) return base_->step;
  return std::nullopt;
}

bool StandbyCopy::add(PartRecord record) {
  const std::optional<std::uint64_t> last = last_step();
  if (!last || record.step != *last + 1) {
    if (record.piece_count == 0) return false;
    *this = {};
  }
  if (next_) move_on();
  records_.push_back(std::move(record));
  if constexpr (checks_whole_structures) check();
  return true;
}

/// Whoever is at the step before the last can go on from the snapshot of that step.
void StandbyCopy::move_on() {
  while (!records_.empty() && records_.front().step <= next_->step) {
    add_keys(records_.front(), log_);
    next_->keys = std::move(records_.front().own_keys);
    records_.pop_front();
  }
  if (next_->part.is_first) log_ = std::exchange(next_->part.log, {});
  base_ = std::exchange(next_, {});
}

void StandbyCopy::add(PartSnapshot snapshot) {
  assert(!records_.empty());
  next_ =
      Mark{.step = records_.back().step, .time = records_.back().time, .part = std::move(snapshot)};
  coming_.reset();
}

std::string StandbyCopy::add(SnapshotPiece piece, const Validator& scene) {
  assert(!records_.empty());
  const PartRecord& last = records_.back();
  if (piece.offset == 0 && piece.step == last.step)
    coming_ = Coming{.step = last.step, .total = piece.total, .time = last.time};
  const bool is_next = coming_ && piece.step == coming_->step && piece.total == coming_->total &&
                       piece.offset == coming_->bytes.size();
  if (!is_next) return "sends a piece of its part that does not follow the last";
  coming_->bytes.insert(coming_->bytes.end(), piece.bytes.begin(), piece.bytes.end());
  if (coming_->bytes.size() < coming_->total) return {};
  const Coming whole = *std::exchange(coming_, {});
  Mark mark{.step = whole.step, .time = whole.time};
  if (!read(whole.bytes, mark.part)) return "sends what is no snapshot of its part";
  if (std::string fault = fault_of(mark.part, scene, mark.time); !fault.empty()) return fault;
  next_ = std::move(mark);
  if constexpr (checks_whole_structures) check();
  return {};
}

bool StandbyCopy::is_at(std::uint64_t step) const {
  return last_step() == step && (base_ || next_);
}

bool StandbyCopy::rewind(std::uint64_t step) {
  if (next_ && next_->step > step) next_.reset();
  if (coming_ && coming_->step > step) coming_.reset();
  while (!records_.empty() && records_.back().step > step) records_.pop_back();
  return is_at(step);
}

Part StandbyCopy::part(const physics::WorldSpec& spec, const Validator& scene,
                       const Division& division, PeerNumber peer) const {
  assert(base_ || next_);
  const Mark& from = newest();
  PartReplay replay(spec, scene, from.part, from.time);
  for (const PartRecord& record : records_)
    if (record.step > from.step) replay.play(record);
  return replay.part(division, peer);
}

std::vector<Key> StandbyCopy::log() const {
  const bool is_told_whole = next_ && next_->part.is_first;
  std::vector<Key> all = is_told_whole ? next_->part.log : log_;
  for (const PartRecord& record : records_)
    if (!is_told_whole || record.step > next_->step) add_keys(record, all);
  return all;
}

const std::vector<Key>& StandbyCopy::last_keys() const {
  assert(base_ || next_);
  return records_.empty() ? newest().keys : records_.back().own_keys;
}

std::size_t StandbyCopy::snapshot_size() const {
  std::size_t size = coming_ ? coming_->bytes.size() : 0;
  for (const std::optional<Mark>* mark : {&base_, &next_})
    if (*mark) size += (*mark)->part.states.size();
  return size;
}

std::uint64_t StandbyCopy::replay_work() const {
  std::uint64_t work = 0;
  for (const PartRecord& record : records_)
    if (record.step > newest().step) work += record.work;
  return work;
}

void StandbyCopy::check() const {
  assert(!base_ || records_.empty() || records_.front().step == base_->step + 1);
  for (std::size_t i = 1; i < records_.size(); ++i)
    assert(records_[i].step == records_[i - 1].step + 1);
  assert(!next_ || !base_ || next_->step > base_->step);
  assert(!next_ || (records_.empty() ? base_ && next_->step <= base_->step
                                     : next_->step <= records_.back().step));
  assert(!coming_ || coming_->bytes.size() < coming_->total);
}

}  // namespace rink::peer
