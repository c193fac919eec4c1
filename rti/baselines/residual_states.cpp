// Decodes each update that residuals may refer to, and codes its residual.
#include "rti/baselines/residual_states.h"

#include <cassert>

#include "rti/fom/coded_values.h"

namespace rink::rti {

ResidualStates::State& ResidualStates::state(const Object& object, ObjectSlot slot) {
  if (slot >= states_.size()) states_.resize(slot + std::size_t{1});
  State& state = states_[slot];
  if (state.object != object.handle) {
    state.object = object.handle;
    state.is_barred = false;
    state.former.held = {};
  }
  return state;
}

Residual ResidualStates::take(const Object& object, ObjectSlot slot, AttributeSet set, double time,
                              Bytes coded) {
  assert(object.is_alive && slot != no_object);
  const std::uint16_t object_class = object.object_class;
  if ((model_.kept(object_class) & set).is_empty()) return {};
  State& state = this->state(object, slot);
  if (state.is_barred) return {};
  values_.clear();
  if (!decode(fom_.object_classes()[object_class], set, coded, time, values_)) {
    state.former.held = {};  // what no federate can read is no basis either
    return {};
  }
  bits_.clear();
  std::size_t size = 0;
  if (model_.residual(object_class).includes(set)) {
    BitWriter bits(bits_);
    if (model_.encode({object_class, set, time}, values_, state.former, bits)) size = bits.at();
  }
  model_.keep(object_class, set, values_, state.former);
  if (size >= 8 * coded.size()) size = 0;
  return {bits_, static_cast<std::uint32_t>(size)};
}

void ResidualStates::bar(const Object& object, ObjectSlot slot) {
  if (model_.kept(object.object_class).is_empty()) return;
  State& state = this->state(object, slot);
  state.is_barred = true;
  state.former.held = {};
}

}  // namespace rink::rti
