// The books of energy, for worlds that keep them: what thrust put in, and what drag, friction and
// impacts took out.
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

#include "game/physics/flight/motion.h"
#include "game/physics/real.h"
#include "game/physics/sum.h"

namespace rink::physics::inline RINK_PRECISION {

struct EnergyTransfer {
  Real work, loss;  ///< of thrust; by drag and friction [J]
};

/// What the law of a body of `mass` [kg] has cost since its last event, at `time`, from the closed
/// forms. `slowing` is friction's part in its acceleration, nothing for what it does not slow.
EnergyTransfer energy_transfer_of(const Motion& motion, Real time, Real mass,
                                  const RealVector* slowing);

/// Three sums, and the energies that bodies had before the event at hand. Nothing is entered where
/// no books are kept.
class EnergyLedger {
 public:
  explicit EnergyLedger(bool is_kept) : is_kept_(is_kept) {}

  bool is_kept() const { return is_kept_; }
  /// Of a body that was added or placed; what one had that was removed or scored is below 0.
  void introduce(Real energy) {
    if (is_kept_) introduced_.add(energy);
  }
  void spend(const EnergyTransfer& transfer) {
    assert(is_kept_);
    if (postponed_ != nullptr) return postponed_->push_back(transfer);
    work_.add(transfer.work);
    loss_.add(transfer.loss);
  }

  /// A body's energy before the event at hand touches it. Bodies are numbered in this order.
  void note_before(Real energy) {
    assert(is_kept_);
    before_.push_back(energy);
  }
  /// And after it: the event has taken the difference.
  void note_after(std::size_t number, Real energy) {
    assert(number < before_.size());
    const Real taken = before_[number] - energy;
    postponed_ != nullptr ? postponed_->push_back({0.0, taken}) : loss_.add(taken);
  }
  void close_event() { before_.clear(); }
  /// From now on transfers are added to `list`, which must outlive that, and are spent later, in
  /// the order of their events: a sum depends on it. Null: no longer.
  void postpone(std::vector<EnergyTransfer>* list) { postponed_ = list; }

  Real introduced() const { return introduced_.value(); }
  /// Without what the laws of the bodies have cost since their last events.
  const Sum& work() const { return work_; }
  const Sum& loss() const { return loss_; }

  /// Saves or restores the sums (snapshot_stream.h).
  template <class Stream>
  bool exchange(Stream& stream) {
    return introduced_.exchange(stream) && work_.exchange(stream) && loss_.exchange(stream);
  }

 private:
  bool is_kept_;
  Sum introduced_, work_, loss_;
  std::vector<Real> before_;
  std::vector<EnergyTransfer>* postponed_ = nullptr;
};

}  // namespace rink::physics::inline RINK_PRECISION
