// Implements rink serve --status.
#include "game/net/server/serve_status.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "game/net/gate.h"
#include "game/net/interrupt.h"
#include "rti/ambassador.h"
#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/socket_transport.h"

namespace rink::game {

namespace {

struct Asker : rti::FederateAmbassador {
  std::optional<std::vector<rti::FederationReport>> reports;
  std::string loss;
  void report_management(const std::vector<rti::FederationReport>& all) override { reports = all; }
  void connection_lost(std::string_view why) override { loss = why; }
};

template <class... Values>
std::string line(const char* format, Values... values) {
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string drops_of(const rti::FederationReport& report) {
  std::string text;
  for (std::size_t reason = 0; reason < rti::violation_count; ++reason)
    if (report.drops[reason] > 0)
      text += line("%s%llu %s", text.empty() ? "" : ", ",
                   static_cast<unsigned long long>(report.drops[reason]),
                   to_string(static_cast<rti::Violation>(reason)));
  return text.empty() ? "none" : text;
}

bool is_utf8(const std::string& text) {
  try {
    return !nlohmann::json(text).dump().empty();
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

/// Names are not trusted, so bytes that control a terminal or cannot be shown are replaced.
std::string shown(const std::string& name) {
  std::string text = name;
  const bool is_text = is_utf8(name);
  for (char& letter : text)
    if (static_cast<unsigned char>(letter) < 32 || letter == 127 ||
        (!is_text && static_cast<unsigned char>(letter) > 127))
      letter = '?';
  return text;
}

/// Regulating, constrained, both, or neither; with the logical time if it has one.
std::string time_of(const rti::FederateCounts& counts) {
  if (counts.is_time_regulating == 0 && counts.is_time_constrained == 0) return "-";
  const std::string now = line("%s%s %.6g s", counts.is_time_regulating != 0 ? "R" : "",
                               counts.is_time_constrained != 0 ? "C" : "", counts.logical_time);
  return counts.is_time_regulating != 0 ? now + line(", sends from %.6g s", counts.earliest_stamp)
                                        : now;
}

}  // namespace

StatusAnswer ask_status(const StatusQuestion& question, const std::function<double()>& now_s,
                        double patience_s) {
  const rti::Fom no_model;
  Asker asker;
  rti::Ambassador ambassador(no_model, asker);
  rti::SocketTransport socket(question.transport);
  rti::StagedTransport gate(socket.get());
  add_gate(gate,
           {.key_file = question.key_file,
            .role = rti::Role::federate,
            .federation = question.federation},
           now_s);
  rti::FederateLink link(ambassador, gate, socket.connect(question.address, question.port));
  rti::FederateLinks links;
  links.add(link);
  ambassador.query_management();
  const double give_up_s = now_s() + patience_s;
  while (!asker.reports && asker.loss.empty() && !link.is_finished() && now_s() < give_up_s) {
    links.flush(now_s());
    gate.poll(std::chrono::milliseconds(20), links);
  }
  if (asker.reports) return {std::move(asker.reports), ""};
  if (link.is_finished() && link.close_reason() == rti::CloseReason::refused)
    return {{}, "no server listens there: " + asker.loss};
  const std::string other = "what listens there does not speak version " +
                            std::to_string(rti::protocol_version) +
                            " of the protocol, or asks for a key";
  if (asker.loss.empty())
    return {{}, "no answer within " + line("%g", patience_s) + " s: " + other};
  return {{}, other + ": " + asker.loss};
}

std::string status_table(const std::vector<rti::FederationReport>& reports) {
  std::string text = reports.empty() ? "no federation execution\n" : "";
  for (const rti::FederationReport& report : reports) {
    text += line(
        "federation %s: object model %s, filter %s, %zu federates, %u objects; connections "
        "dropped: %s\n",
        shown(report.federation).c_str(), shown(report.model).c_str(), shown(report.filter).c_str(),
        report.federates.size(), report.objects, drops_of(report).c_str());
    text += line("%-20.20s %-10.10s %7s %8s %7s %10s %10s %8s %8s %9s %9s %7s %7s %s\n", "federate",
                 "type", "owned", "in scope", "regions", "updates", "reflected", "int sent",
                 "int recv", "kB sent", "kB recv", "queued", "silent", "time");
    for (const rti::FederateReport& each : report.federates) {
      const rti::FederateCounts& counts = each.counts;
      const auto number = [](std::uint64_t value) {
        return static_cast<unsigned long long>(value);
      };
      text += line(
          "%-20.20s %-10.10s %7u %8u %7u %10llu %10llu %8llu %8llu %9.1f %9.1f %7llu %6.1fs %s\n",
          shown(each.name).c_str(), shown(each.type).c_str(), counts.objects_owned,
          counts.objects_in_scope, counts.regions, number(counts.updates_sent),
          number(counts.reflections_received), number(counts.interactions_sent),
          number(counts.interactions_received), 1e-3 * static_cast<double>(counts.bytes_sent),
          1e-3 * static_cast<double>(counts.bytes_received), number(counts.queue_bytes),
          counts.silence_s, time_of(counts).c_str());
    }
  }
  return text;
}

std::optional<std::string> print_status(const StatusQuestion& question, double every_s,
                                        const std::function<double()>& now_s) {
  do {
    const StatusAnswer answer = ask_status(question, now_s);
    if (!answer.reports) return answer.error;
    std::fputs(status_table(*answer.reports).c_str(), stdout);
    std::fflush(stdout);
    const double next_s = now_s() + every_s;
    while (every_s > 0.0 && !is_interrupted && now_s() < next_s)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  } while (every_s > 0.0 && !is_interrupted);
  return std::nullopt;
}

}  // namespace rink::game
