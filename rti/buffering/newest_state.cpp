// Finds the federates that have stopped reading.
#include "rti/buffering/newest_state.h"

#include <cassert>

namespace rink::rti {

NewestState::NewestState(const NewestStateSettings& settings) : settings_(settings) {
  assert(settings.resume_below <= settings.hold_above);
}

std::span<const UpdateRun> NewestState::seal() {
  runs_.seal();
  return runs_.runs();
}

bool NewestState::holds_back(std::uint32_t federate, std::size_t waiting_bytes) {
  assert(federate != no_federate);
  if (federate >= is_held_.size()) is_held_.resize(federate + 1);
  const bool is_held =
      waiting_bytes > (is_held_[federate] ? settings_.resume_below : settings_.hold_above);
  is_held_[federate] = is_held;
  return is_held;
}

void NewestState::remove_federate(std::uint32_t federate) {
  if (federate < is_held_.size()) is_held_[federate] = false;
}

}  // namespace rink::rti
