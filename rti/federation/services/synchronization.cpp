// Registers synchronisation points, and announces them as reached when the last federate has
// achieved them.
#include "rti/federation/services/synchronization.h"
#include "im/basics/sorted_set.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rink::rti {

Status Synchronization::handle_register(std::uint32_t slot, Reader& reader) {
  RegisterSynchronizationPointMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  SynchronizationPoint point;
  point.registrar = federates_[slot].handle;
  const auto failure = find_members(message, point);
  federates_[slot].outbox.before_updates(SynchronizationPointRegisteredMessage{
      message.label, static_cast<std::uint8_t>(failure.value_or(SynchronizationFailure{}))});
  if (failure) return std::nullopt;
  point.label = message.label;
  point.tag.assign(message.tag.begin(), message.tag.end());
  point.awaited = point.members;
  assert(!point.members.empty() && std::ranges::is_sorted(point.members));
  for (const std::uint32_t member : point.members) announce(point, member);
  points_.push_back(std::move(point));
  return std::nullopt;
}

std::optional<SynchronizationFailure> Synchronization::find_members(
    const RegisterSynchronizationPointMessage& message, SynchronizationPoint& point) const {
  std::size_t own = 0;
  for (const SynchronizationPoint& other : points_) {
    if (other.label == message.label) return SynchronizationFailure::label_not_unique;
    own += other.registrar == point.registrar ? 1 : 0;
  }
  if (own >= point_max) return SynchronizationFailure::over_limit;
  point.is_for_all = message.members.count == 0;
  if (point.is_for_all) {
    for (std::uint32_t slot = 0; slot < federates_.size(); ++slot)
      if (federates_[slot].is_joined) point.members.push_back(slot);
  }
  for (const FederateHandle handle : handles_of(message.members)) {
    const std::optional<std::uint32_t> member = federates_.joined(handle);
    if (!member) return SynchronizationFailure::member_not_joined;
    point.members.push_back(*member);
  }
  make_sorted_set(point.members);
  return std::nullopt;
}

void Synchronization::announce(const SynchronizationPoint& point, std::uint32_t slot) {
  federates_[slot].outbox.before_updates(
      AnnounceSynchronizationPointMessage{point.label, point.tag});
}

Status Synchronization::handle_achieved(std::uint32_t slot, Reader& reader) {
  SynchronizationPointAchievedMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const auto point =
      std::find_if(points_.begin(), points_.end(),
                   [&](const SynchronizationPoint& each) { return each.label == message.label; });
  // An awaited federate always finds the point, which stays until all have answered.
  if (point == points_.end() || std::erase(point->awaited, slot) == 0)
    return Violation::unknown_name;
  if (message.is_success == 0) point->failed.push_back(federates_[slot].handle);
  complete();
  return std::nullopt;
}

void Synchronization::joined(std::uint32_t slot) {
  for (SynchronizationPoint& point : points_) {
    if (!point.is_for_all) continue;
    assert(std::ranges::find(point.members, slot) == point.members.end());
    point.members.push_back(slot);
    point.awaited.push_back(slot);
    announce(point, slot);
  }
}

void Synchronization::left(std::uint32_t slot) {
  orphan(federates_[slot].handle);
  for (SynchronizationPoint& point : points_) {
    std::erase(point.members, slot);
    std::erase(point.awaited, slot);
    std::erase(point.failed, federates_[slot].handle);
  }
  complete();
}

/// Points outlive the federates that registered them, but only up to a limit, so that joining,
/// registering and leaving over and over cannot grow for ever.
void Synchronization::orphan(FederateHandle registrar) {
  auto left = std::ranges::count_if(
      points_, [](const SynchronizationPoint& each) { return !each.registrar; });
  std::vector<SynchronizationPoint> kept;
  for (SynchronizationPoint& point : points_) {
    const bool is_left = point.registrar == registrar;
    if (is_left && static_cast<std::size_t>(left) >= left_max) continue;
    if (is_left) ++left, point.registrar = {};
    kept.push_back(std::move(point));
  }
  points_ = std::move(kept);
}

void Synchronization::complete() {
  for (const SynchronizationPoint& point : points_)
    if (point.awaited.empty())
      for (const std::uint32_t member : point.members)
        federates_[member].outbox.before_updates(
            FederationSynchronizedMessage{point.label, list_of(point.failed)});
  std::erase_if(points_, [](const SynchronizationPoint& point) { return point.awaited.empty(); });
}

}  // namespace rink::rti
