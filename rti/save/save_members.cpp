// Who takes part in a save or a restore: matches federates with saved ones, and tells how far each
// is.
#include <algorithm>
#include <utility>

#include "rti/save/save_service.h"

namespace rink::rti {

/// Once for each flush, since the answer is longer than the question.
void SaveService::answer_queries() {
  for_each_joined([&](std::uint32_t slot) {
    if (std::exchange(part(slot).asks_for_save, false)) answer_query(slot, false);
    if (std::exchange(part(slot).asks_for_restore, false)) answer_query(slot, true);
  });
}

void SaveService::answer_query(std::uint32_t slot, bool is_restore) {
  std::vector<std::byte> records;
  Writer writer(records);
  SaveStatusMessage answer{is_restore, 0, {}};
  for_each_joined([&](std::uint32_t each) {
    const std::uint32_t handle = basis_.federates[each].handle.value;
    SaveStatusRecord record{handle, handle, static_cast<std::uint8_t>(part(each).save)};
    if (is_restore) {
      RestoreStatus status = part(each).restore;
      if (restore_ && restore_->slot == each) status = RestoreStatus::request_pending;
      record.status = static_cast<std::uint8_t>(status);
      if (uses_.phase == SavePhase::restoring)
        for (const SavedFederate& saved : saved_.federates)
          if (saved.slot == mapping_[each]) record.after = saved.handle.value;
    }
    exchange(writer, record);
    ++answer.count;
  });
  answer.records = records;
  tell(slot, answer);
}

/// Every saved federate needs a present one of its type, of its name if there is one of that.
std::string SaveService::match_federates() {
  if (saved_.federation != basis_.settings.federation)
    return "it is of federation '" + saved_.federation + "'";
  if (saved_.fom_hash != basis_.fom.hash()) return "it is of another object model";
  std::vector<const SavedFederate*> left;
  left.reserve(saved_.federates.size());
  for (const SavedFederate& each : saved_.federates) left.push_back(&each);
  mapping_.assign(basis_.federates.size(), no_federate);
  std::string why;
  for (const bool is_by_name : {true, false})
    for_each_joined([&](std::uint32_t slot) {
      if (mapping_[slot] != no_federate) return;
      const JoinedFederate& federate = basis_.federates[slot];
      const auto found = std::ranges::find_if(left, [&](const SavedFederate* each) {
        return each->type == federate.type && (!is_by_name || each->name == federate.name);
      });
      if (found != left.end()) {
        mapping_[slot] = (*found)->slot;
        left.erase(found);
      } else if (!is_by_name && why.empty()) {
        why = "it has no federate of type '" + federate.type + "' for '" + federate.name + "'";
      }
    });
  if (why.empty() && !left.empty())
    why = "a federate of type '" + left.front()->type + "' is missing, as was '" +
          left.front()->name + "'";
  return why;
}

}  // namespace rink::rti
