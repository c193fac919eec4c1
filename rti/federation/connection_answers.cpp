// Answers the requests that a connection may make before it has joined.
#include <utility>

#include "rti/federation/connections.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/management_messages.h"

namespace rink::rti {

template <class Message>
Status Connections::answer(ConnectionId id, Message message) {
  if (answers_.empty() || answers_.back().connection != id) answers_.push_back({id, {}, {}});
  const std::vector<std::byte> frame = framed(message);
  answers_.back().bytes.insert(answers_.back().bytes.end(), frame.begin(), frame.end());
  return std::nullopt;
}

/// A host of one execution refuses to create others or to destroy its own.
Status Connections::answer_unjoined(ConnectionId id, MessageKind kind, Reader& reader) {
  if (!connections_[id].limits.ask()) return Violation::over_limit;
  const std::string& own = basis_.settings.federation;
  switch (kind) {
    case MessageKind::create_federation_execution: {
      CreateFederationExecutionMessage message;
      if (!exchange(reader, message)) return Violation::malformed;
      const HlaError error = message.federation == own
                                 ? HlaError::federation_execution_already_exists
                                 : HlaError::unauthorized;
      return answer(id, FederationExecutionCreatedMessage{message.federation,
                                                          static_cast<std::uint8_t>(error)});
    }
    case MessageKind::destroy_federation_execution: {
      DestroyFederationExecutionMessage message;
      if (!exchange(reader, message)) return Violation::malformed;
      const HlaError error = message.federation == own
                                 ? HlaError::unauthorized
                                 : HlaError::federation_execution_does_not_exist;
      return answer(id, FederationExecutionDestroyedMessage{message.federation,
                                                            static_cast<std::uint8_t>(error)});
    }
    case MessageKind::list_federation_executions:
      return list_executions(id);
    case MessageKind::query_management:
      return query_report(id);
    default:
      return Violation::wrong_phase;
  }
}

Status Connections::list_executions(ConnectionId id) {
  if (std::exchange(connections_[id].limits.wants_list, true)) return std::nullopt;
  answer(id,
         FederationExecutionMessage{0, basis_.settings.federation, basis_.fom.name(),
                                    static_cast<std::uint32_t>(basis_.federates.joined_count())});
  return answer(id, FederationExecutionMessage{1, {}, {}, 0});
}

Status Connections::query_report(ConnectionId id) {
  if (!std::exchange(connections_[id].limits.wants_report, true)) report_queries_.push_back(id);
  return std::nullopt;
}

/// Adds to the census how long each connection has been silent.
FederationReport Connections::report(const Outlet* outlet) const {
  FederationReport report = census_.report(outlet);
  for (FederateReport& each : report.federates)
    if (const auto slot = basis_.federates.joined(each.federate))
      each.counts.silence_s =
          connections_[basis_.federates[*slot].connection].silence.lasted_s();
  return report;
}

void Connections::send_answers(Outlet& outlet) {
  for (const PendingClose& each : answers_) {
    const Bytes bytes = each.bytes;
    outlet.send(each.connection, std::span(&bytes, 1));
    connections_[each.connection].limits = {};
  }
  for (const ConnectionId each : report_queries_) connections_[each].limits = {};
  answers_.clear();
  if (!report_queries_.empty()) send_reports(outlet);
}

/// One report serves all requests since the last flush.
void Connections::send_reports(Outlet& outlet) {
  const FederationReport whole = report(&outlet);
  for (const ConnectionId id : report_queries_) {
    if (is_unknown(id)) continue;
    if (is_joined(id)) {
      std::vector<std::byte>& head = basis_.federates[connections_[id].federate].outbox.head();
      const auto append = [&head](auto message) { write(head, message); };
      for_each_message(whole, append);
      append(ReportEndMessage{});
      continue;
    }
    FrameWriter frame(older_frame_max, FrameForm::older);
    const auto append = [&frame](auto message) {
      write(frame.begin_message(measure(message)), message);
      frame.appended();
    };
    for_each_message(whole, append);
    append(ReportEndMessage{});
    const Bytes bytes = frame.bytes();
    outlet.send(id, std::span(&bytes, 1));
  }
  report_queries_.clear();
}

}  // namespace rink::rti
