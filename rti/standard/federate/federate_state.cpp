// Objects that a federate deletes.
#include "rti/standard/federate/federate_state.h"

#include <algorithm>

namespace rink::standard {

void FederateState::forget(rti::ObjectHandle object, const rti::RetractionHandle& handle) {
  // What is past is not retracted any more.
  std::erase_if(deletions,
                [this](const TimedDeletion& each) { return each.handle.time < time.now; });
  const auto found = objects.find(object);
  if (handle && found != objects.end()) deletions.push_back({handle, object, found->second});
  forget(object);
}

void FederateState::retract(const rti::RetractionHandle& handle) {
  const auto found = std::find_if(deletions.begin(), deletions.end(),
                                  [&](const TimedDeletion& each) { return each.handle == handle; });
  if (found == deletions.end()) return;
  objects[found->object] = found->known;
  deliveries.undo_drop(found->object);
  deletions.erase(found);
}

void FederateState::begin(rti1516e::FederateAmbassador& user) {
  leave();
  deliveries.begin(user);
  times = Times();
  resign_directive = rti::ResignAction::cancel_then_delete_then_divest;
  answers = {};
  core = nullptr;
  model.reset();
  lost_because.reset();
}

void FederateState::leave() {
  deliveries.clear();
  declarations = {};
  objects.clear();
  deletions.clear();
  reserved_names.clear();
  time = {};
}

}  // namespace rink::standard
