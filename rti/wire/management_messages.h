// The messages of the management service: a question, and an answer of one message for each
// federation execution and each of its federates.
#pragma once

#include "rti/management/federation_report.h"
#include "rti/wire/message.h"

namespace rink::rti {

/// Before the join it asks about all executions of the host, after it about the own one.
using QueryManagementMessage = BareMessage<MessageKind::query_management>;

/// Begins the report of one execution; what follows up to the next one are its federates.
struct FederationReportMessage {
  static constexpr MessageKind kind = MessageKind::federation_report;
  std::string_view federation, model, filter;
  std::uint32_t objects = 0;
  std::array<std::uint64_t, FederationReport::drop_count_max> drops{};
};
template <class Stream>
bool exchange(Stream& stream, FederationReportMessage& message) {
  if (!stream.text(message.federation, text_max) || !stream.text(message.model, text_max) ||
      !stream.text(message.filter, text_max) || !stream.varint(message.objects))
    return false;
  for (std::uint64_t& drops : message.drops)
    if (!stream.varint(drops)) return false;
  return true;
}

struct FederateReportMessage {
  static constexpr MessageKind kind = MessageKind::federate_report;
  std::uint32_t federate = 0;
  std::string_view name, type;
  FederateCounts counts;
};
template <class Stream>
bool exchange(Stream& stream, FederateReportMessage& message) {
  FederateCounts& counts = message.counts;
  if (!stream.number(message.federate) || !stream.text(message.name, text_max) ||
      !stream.text(message.type, text_max))
    return false;
  for (std::uint64_t* count : {&counts.updates_sent, &counts.reflections_received,
                               &counts.interactions_sent, &counts.interactions_received,
                               &counts.bytes_sent, &counts.bytes_received, &counts.queue_bytes})
    if (!stream.varint(*count)) return false;
  for (std::uint32_t* count : {&counts.objects_owned, &counts.objects_in_scope, &counts.regions})
    if (!stream.varint(*count)) return false;
  return stream.range(counts.is_time_regulating, 1) &&
         stream.range(counts.is_time_constrained, 1) && stream.number(counts.logical_time) &&
         stream.number(counts.earliest_stamp) && stream.finite(counts.silence_s);
}

/// The answer is complete.
using ReportEndMessage = BareMessage<MessageKind::report_end>;

/// Calls `enqueue(message)` for every message of one report; the end is not among them.
template <class Enqueue>
void for_each_message(const FederationReport& report, Enqueue enqueue) {
  enqueue(FederationReportMessage{report.federation, report.model, report.filter, report.objects,
                                  report.drops});
  for (const FederateReport& each : report.federates)
    enqueue(FederateReportMessage{each.federate.value, each.name, each.type, each.counts});
}

}  // namespace rink::rti
