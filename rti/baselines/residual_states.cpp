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
  const ResidualUpdate update{object_class, set, time};
  if (model_.residual(object_class).includes(set)) {
    BitWriter bits(bits_);
    if (model_.encode(update, values_, state.former, bits)) size = bits.at();
  }
  if (size >= 8 * coded.size()) size = 0;
  Residual residual{bits_, static_cast<std::uint32_t>(size), ++number_};
  Taken* taken = size == 0 ? nullptr : begin_taken(object, set, time, state.former);
  if (taken != nullptr) find_companion(*taken, update, state.former, residual);
  model_.keep(object_class, set, values_, state.former);
  if (taken != nullptr) taken->change.after = state.former.bytes;
  return residual;
}

ResidualStates::Taken* ResidualStates::begin_taken(const Object& object, AttributeSet set,
                                                   double time, const FormerValues& former) {
  constexpr std::size_t taken_max = 256;  // a search among more would cost more than it spares
  const auto key = model_.companion_key(object.object_class, set, values_);
  if (!key) return nullptr;
  if (time != taken_time_ || taken_count_ == taken_max) taken_count_ = 0;
  taken_time_ = time;
  if (taken_count_ == taken_.size()) taken_.emplace_back();
  Taken& taken = taken_[taken_count_++];
  taken.object = object.handle;
  taken.number = number_;
  taken.object_class = object.object_class;
  taken.is_paired = false;
  taken.key = *key;
  taken.change.attributes = set;
  taken.change.before = former;
  return &taken;
}

/// The first that makes the residual shorter: two bodies that hit each other are alone in that.
void ResidualStates::find_companion(Taken& taken, ResidualUpdate update, const FormerValues& former,
                                    Residual& residual) {
  constexpr std::size_t tries_max = 4;     // where all values have one key, none is a hit
  constexpr std::size_t least_spared = 8;  // bits; a companion's handle is longer than a gap
  std::size_t tried = 0;
  for (std::size_t i = 0; i + 1 < taken_count_ && tried < tries_max; ++i) {
    Taken& other = taken_[i];
    if (other.key != taken.key || other.is_paired || other.object_class != taken.object_class ||
        other.object == taken.object)
      continue;
    ++tried;
    update.companion = &other.change;
    companion_bits_.clear();
    BitWriter bits(companion_bits_);
    if (!model_.encode(update, values_, former, bits) || bits.at() + least_spared > residual.size)
      continue;
    residual.companion_size = static_cast<std::uint32_t>(bits.at());
    residual.companion = other.number;
    residual.companion_object = other.object;
    other.is_paired = taken.is_paired = true;
    break;
  }
  residual.companion_bits = companion_bits_;
}

void ResidualStates::bar(const Object& object, ObjectSlot slot) {
  if (model_.kept(object.object_class).is_empty()) return;
  State& state = this->state(object, slot);
  state.is_barred = true;
  state.former.held = {};
}

}  // namespace rink::rti
