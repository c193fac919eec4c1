// Synchronisation points, and the answers to those who have not joined.
#include <algorithm>
#include <utility>

#include "rti/federation/federation_parts.h"

namespace rink::rti {

using Outcome = std::optional<Violation>;

Outcome FederationParts::register_point(Reader& reader, std::uint32_t slot) {
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
  for (const std::uint32_t member : point.members) announce(point, member);
  points_.push_back(std::move(point));
  return std::nullopt;
}

std::optional<SynchronizationFailure> FederationParts::find_members(
    const RegisterSynchronizationPointMessage& message, SynchronizationPoint& point) const {
  std::size_t own = 0;
  for (const SynchronizationPoint& other : points_) {
    if (other.label == message.label) return SynchronizationFailure::label_not_unique;
    own += other.registrar == point.registrar ? 1 : 0;
  }
  if (own >= synchronization_point_max) return SynchronizationFailure::over_limit;
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
  std::sort(point.members.begin(), point.members.end());
  point.members.erase(std::unique(point.members.begin(), point.members.end()), point.members.end());
  return std::nullopt;
}

void FederationParts::announce(const SynchronizationPoint& point, std::uint32_t slot) {
  federates_[slot].outbox.before_updates(
      AnnounceSynchronizationPointMessage{point.label, point.tag});
}

Outcome FederationParts::achieve_point(Reader& reader, std::uint32_t slot) {
  SynchronizationPointAchievedMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const auto point =
      std::find_if(points_.begin(), points_.end(),
                   [&](const SynchronizationPoint& each) { return each.label == message.label; });
  // Nobody who is awaited can lose a race: the point stays until all have spoken.
  if (point == points_.end() || std::erase(point->awaited, slot) == 0)
    return Violation::unknown_name;
  if (message.is_success == 0) point->failed.push_back(federates_[slot].handle);
  complete_points();
  return std::nullopt;
}

void FederationParts::join_points(std::uint32_t slot) {
  for (SynchronizationPoint& point : points_) {
    if (!point.is_for_all) continue;
    point.members.push_back(slot);
    point.awaited.push_back(slot);
    announce(point, slot);
  }
}

void FederationParts::leave_points(std::uint32_t slot) {
  // Points outlive who registered them, but not so many that joining, registering and leaving over
  // and over grows for ever.
  auto left = std::ranges::count_if(
      points_, [](const SynchronizationPoint& each) { return !each.registrar; });
  std::vector<SynchronizationPoint> kept;
  for (SynchronizationPoint& point : points_) {
    const bool is_left = point.registrar == federates_[slot].handle;
    if (is_left && static_cast<std::size_t>(left) >= points_left_max) continue;
    if (is_left) ++left, point.registrar = {};
    kept.push_back(std::move(point));
  }
  points_ = std::move(kept);
  for (SynchronizationPoint& point : points_) {
    std::erase(point.members, slot);
    std::erase(point.awaited, slot);
    std::erase(point.failed, federates_[slot].handle);
  }
  complete_points();
}

void FederationParts::complete_points() {
  for (const SynchronizationPoint& point : points_)
    if (point.awaited.empty())
      for (const std::uint32_t member : point.members)
        federates_[member].outbox.before_updates(
            FederationSynchronizedMessage{point.label, list_of(point.failed)});
  std::erase_if(points_, [](const SynchronizationPoint& point) { return point.awaited.empty(); });
}

template <class Message>
void FederationParts::answer(ConnectionId connection, Message message) {
  if (answers_.empty() || answers_.back().connection != connection)
    answers_.push_back({connection, {}, {}});
  const std::vector<std::byte> frame = framed(message);
  answers_.back().bytes.insert(answers_.back().bytes.end(), frame.begin(), frame.end());
}

void FederationParts::query_management(ConnectionId connection) {
  if (!std::exchange(connections_[connection].questions.wants_report, true))
    management_queries_.push_back(connection);
}

void FederationParts::send_answers(Outlet& outlet) {
  for (const Farewell& each : answers_) {
    const Bytes bytes = each.bytes;
    outlet.send(each.connection, std::span(&bytes, 1));
    connections_[each.connection].questions = {};
  }
  for (const ConnectionId each : management_queries_) connections_[each].questions = {};
  answers_.clear();
  answer_queries(outlet);
}

/// A host of one execution makes no others and keeps the one it has.
Outcome FederationParts::answer_stranger(ConnectionId connection, MessageKind kind,
                                         Reader& reader) {
  CreateFederationExecutionMessage creation;
  DestroyFederationExecutionMessage destruction;
  Questions& questions = connections_[connection].questions;
  if (!questions.ask()) return Violation::over_limit;
  switch (kind) {
    case MessageKind::create_federation_execution: {
      if (!exchange(reader, creation)) return Violation::malformed;
      const bool exists = creation.federation == settings_.federation;
      const auto error = static_cast<std::uint8_t>(
          exists ? HlaError::federation_execution_already_exists : HlaError::unauthorized);
      return answer(connection, FederationExecutionCreatedMessage{creation.federation, error}),
             std::nullopt;
    }
    case MessageKind::destroy_federation_execution: {
      if (!exchange(reader, destruction)) return Violation::malformed;
      const bool exists = destruction.federation == settings_.federation;
      const auto error = static_cast<std::uint8_t>(
          exists ? HlaError::unauthorized : HlaError::federation_execution_does_not_exist);
      return answer(connection, FederationExecutionDestroyedMessage{destruction.federation, error}),
             std::nullopt;
    }
    case MessageKind::list_federation_executions:
      if (std::exchange(questions.wants_list, true)) return std::nullopt;
      answer(connection,
             FederationExecutionMessage{0, settings_.federation, fom_.name(),
                                        static_cast<std::uint32_t>(federates_.joined_count())});
      return answer(connection, FederationExecutionMessage{1, {}, {}, 0}), std::nullopt;
    case MessageKind::query_management:
      return query_management(connection), std::nullopt;
    default:
      return Violation::wrong_phase;
  }
}

}  // namespace rink::rti
