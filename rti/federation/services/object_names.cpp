// Grants, uses and releases reservations of names.
#include "rti/federation/services/object_names.h"

#include <algorithm>
#include <cassert>

namespace rink::rti {

Status ObjectNames::handle(std::uint32_t slot, Reader& reader) {
  InstanceNamesMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  std::vector<std::string> names;
  if (!for_each_name(message.names, [&](std::string_view name) { names.emplace_back(name); }))
    return Violation::malformed;
  const FederateHandle federate = federates_[slot].handle;
  const auto request = static_cast<NameRequest>(message.word);
  if (request == NameRequest::reserve && names.size() != 1) return Violation::malformed;
  if (request == NameRequest::release) return release(federate, names);
  const bool is_set = request == NameRequest::reserve_set;
  if (reserve(federate, names))
    answer(slot, is_set ? NameAnswer::set_granted : NameAnswer::granted, message.names);
  else answer(slot, is_set ? NameAnswer::set_refused : NameAnswer::refused, message.names);
  return std::nullopt;
}

/// A set is granted whole or not at all (6.5).
bool ObjectNames::reserve(FederateHandle federate, std::vector<std::string>& names) {
  std::ranges::sort(names);
  const bool is_unique = std::ranges::adjacent_find(names) == names.end();
  const bool is_free = is_unique && std::ranges::none_of(names, [this](const std::string& name) {
                         return name.starts_with("HLA") || names_.contains(name);
                       });
  if (!is_free || names_.size() + names.size() > name_max_) return false;
  assert(federate);  // or the names would seem to be in use
  for (const std::string& name : names) names_.emplace(name, federate);
  return true;
}

Status ObjectNames::release(FederateHandle federate, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto found = names_.find(name);
    if (found == names_.end() || found->second != federate) return Violation::unknown_name;
    names_.erase(found);
  }
  return std::nullopt;
}

void ObjectNames::answer(std::uint32_t slot, NameAnswer answer, Bytes names) {
  federates_[slot].outbox.before_updates(
      InstanceNamesAnswerMessage{static_cast<std::uint8_t>(answer), names});
}

bool ObjectNames::take(std::uint32_t slot, std::string_view name) {
  const auto [found, is_new] = names_.emplace(name, FederateHandle{});
  if ((is_new && !name.starts_with("HLA")) ||
      (!is_new && found->second && found->second == federates_[slot].handle)) {
    found->second = {};
    return true;
  }
  if (is_new) names_.erase(found);
  std::vector<std::byte> text;
  Writer(text).text(name, text_max);
  answer(slot, NameAnswer::registration_refused, text);
  return false;
}

void ObjectNames::left(std::uint32_t slot) {
  const FederateHandle federate = federates_[slot].handle;
  assert(federate);
  std::erase_if(names_,
                [federate](const auto& each) { return each.second && each.second == federate; });
}

}  // namespace rink::rti
