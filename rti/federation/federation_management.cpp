// The answers to those who have not joined.
#include <utility>

#include "rti/federation/federation_parts.h"
#include "rti/wire/management_messages.h"

namespace rink::rti {

template <class Message>
void FederationParts::answer(ConnectionId connection, Message message) {
  if (answers_.empty() || answers_.back().connection != connection)
    answers_.push_back({connection, {}, {}});
  const std::vector<std::byte> frame = framed(message);
  answers_.back().bytes.insert(answers_.back().bytes.end(), frame.begin(), frame.end());
}

Outcome FederationParts::query_management(ConnectionId connection) {
  if (!std::exchange(connections_[connection].questions.wants_report, true))
    management_queries_.push_back(connection);
  return std::nullopt;
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
      return query_management(connection);
    default:
      return Violation::wrong_phase;
  }
}

/// How long each has been silent is the connections' to say.
FederationReport FederationParts::report(const Outlet* outlet) const {
  FederationReport report = census_.report(outlet);
  for (FederateReport& each : report.federates)
    if (const auto slot = federates_.joined(each.federate))
      each.counts.silence_s = now_ - connections_[federates_[*slot].connection].last_heard;
  return report;
}

/// One report serves all who asked since the last flush.
void FederationParts::answer_queries(Outlet& outlet) {
  if (management_queries_.empty()) return;
  const FederationReport whole = report(&outlet);
  for (const ConnectionId id : management_queries_) {
    if (id >= connections_.size() || connections_[id].phase == Phase::unknown) continue;
    FrameWriter frame(frame_max_to_federate);
    const auto append = [&frame](auto message) {
      write(frame.begin_message(measure(message)), message);
      frame.appended();
    };
    for_each_message(whole, append);
    append(ReportEndMessage{});
    const Bytes bytes = frame.bytes();
    if (connections_[id].phase != Phase::joined) {
      outlet.send(id, std::span(&bytes, 1));
      continue;
    }
    std::vector<std::byte>& head = federates_[connections_[id].federate].outbox.head();
    head.insert(head.end(), bytes.begin() + frame_header_size, bytes.end());
  }
  management_queries_.clear();
}

}  // namespace rink::rti
