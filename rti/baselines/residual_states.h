// The values at the RTI that residuals of the next updates refer to.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/baselines/residual_model.h"
#include "rti/objects/object_table.h"

namespace rink::rti {

/// An update as the residual to the one before it.
struct Residual {
  Bytes bits;
  std::uint32_t size = 0;    ///< bits; 0: the update must travel whole
  std::uint32_t number = 0;  ///< of the update, from 1 on
  /// The shorter residual for who is sent the companion's update, too: that of number `companion`.
  Bytes companion_bits{};
  std::uint32_t companion_size = 0, companion = 0;
  ObjectHandle companion_object{};
};

/// Follows the updates of all objects in the order in which federates receive them. Codes each once
/// for all federates.
class ResidualStates {
 public:
  explicit ResidualStates(const Fom& fom) : fom_(fom), model_(fom) {}

  const ResidualModel& model() const { return model_; }
  /// Takes an update of the object in `slot`, whose values are as they travel. The residual is
  /// valid until the next call.
  Residual take(const Object& object, ObjectSlot slot, AttributeSet set, double time, Bytes coded);
  /// True if every federate that was sent all updates of the object by the stream holds the newest
  /// values of `set`.
  bool holds(const Object& object, ObjectSlot slot, AttributeSet set) const {
    if (slot >= states_.size() || states_[slot].object != object.handle) return false;
    return !states_[slot].is_barred && states_[slot].former.held.includes(set);
  }
  /// The owner took values back: the next update of `set` travels whole.
  void forget(const Object& object, ObjectSlot slot, AttributeSet set) {
    State& state = this->state(object, slot);
    state.former.held = state.former.held.without(set);
  }
  /// Updates of the object travel whole from now on: federates may receive others than those that
  /// are taken here, or in another order.
  void bar(const Object& object, ObjectSlot slot);

 private:
  /// An update that later ones of the same time may refer to, one of them at most.
  struct Taken {
    ObjectHandle object;
    std::uint32_t number = 0;
    std::uint16_t object_class = 0;
    bool is_paired = false;
    std::uint64_t key = 0;
    FormerChange change;
  };
  struct State {
    ObjectHandle object;  ///< slots are used again
    bool is_barred = false;
    FormerValues former;
  };
  State& state(const Object& object, ObjectSlot slot);
  /// Begins to keep the update, or does not if it may be nobody's companion.
  Taken* begin_taken(const Object& object, AttributeSet set, double time,
                     const FormerValues& former);
  void find_companion(Taken& taken, ResidualUpdate update, const FormerValues& former,
                      Residual& residual);

  const Fom& fom_;
  ResidualModel model_;
  std::vector<State> states_;  ///< by slot
  std::vector<std::byte> values_, bits_, companion_bits_;
  std::vector<Taken> taken_;  ///< the first `taken_count_`, all of `taken_time_`
  std::size_t taken_count_ = 0;
  double taken_time_ = 0.0;
  std::uint32_t number_ = 0;
};

}  // namespace rink::rti
