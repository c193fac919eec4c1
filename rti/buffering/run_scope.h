// Which records of a run of updates a federate receives.
#pragma once

#include <bit>

#include "rti/buffering/update_runs.h"
#include "rti/distribution/interest.h"

namespace rink::rti {

/// True if every member of the run is in scope.
inline bool is_all_in_scope(const UpdateRun& run, const Bitmap& in_scope) {
  for (std::size_t i = run.first_word; i <= run.last_word; ++i)
    if ((run.members.word(i) & ~in_scope.word(i)) != 0) return false;
  return true;
}

/// Calls `visit(index of the record)` for each member that is in scope, whose turn it is and whose
/// full state is not due anyway.
template <class Visit>
void for_each_record(const UpdateRun& run, const FederateInterest& interest, Visit visit) {
  const Bitmap& reflected = interest.reflected();
  if (run.slots.size() <= UpdateRun::short_run) {
    for (std::size_t i = 0; i < run.slots.size(); ++i)
      if (reflected.contains(run.slots[i]) && !interest.needs_full_state.contains(run.slots[i]))
        visit(i);
    return;
  }
  for (std::size_t i = run.first_word; i <= run.last_word; ++i) {
    std::uint64_t bits =
        run.members.word(i) & reflected.word(i) & ~interest.needs_full_state.word(i);
    for (; bits != 0; bits &= bits - 1)
      visit(run.record_of[i * 64 + static_cast<std::size_t>(std::countr_zero(bits))]);
  }
}

/// Takes an object out of a federate's scope for as long as it lives.
class LeftOut {
 public:
  LeftOut(FederateInterest& interest, ObjectSlot object)
      : interest_(interest),
        object_(object),
        is_in_scope_(object != no_object && interest.in_scope.contains(object)),
        is_reflected_(object != no_object && interest.turns &&
                      interest.turns->reflected.contains(object)) {
    if (is_in_scope_) interest_.in_scope.erase(object_);
    if (is_reflected_) interest_.turns->reflected.erase(object_);
  }
  LeftOut(const LeftOut&) = delete;
  LeftOut& operator=(const LeftOut&) = delete;
  ~LeftOut() {
    if (is_in_scope_) interest_.in_scope.insert(object_);
    if (is_reflected_) interest_.turns->reflected.insert(object_);
  }

 private:
  FederateInterest& interest_;
  const ObjectSlot object_;
  const bool is_in_scope_, is_reflected_;
};

}  // namespace rink::rti
