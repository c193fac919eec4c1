// Adds up reports under the names of a server's and its bots'.
#include "loadgen/run/nodes/node_reports.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

#include "game/model/report_fields.h"
#include "game/model/report_schema.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/measure/statistics/histogram.h"
#include "loadgen/run/run_ending.h"

namespace rink::loadgen {
namespace {

namespace report = game::report;
using Json = nlohmann::ordered_json;
using Reports = std::vector<const nlohmann::json*>;

const nlohmann::json* value_of(const nlohmann::json& of, const char* key) {
  if (!of.is_object()) return nullptr;
  const auto found = of.find(key);
  return found == of.end() ? nullptr : &*found;
}

/// The numbers of all reports; none if one of them has none.
template <class Number>
std::vector<Number> numbers(const Reports& reports, game::ReportField<Number> field) {
  std::vector<Number> all;
  for (const nlohmann::json* each : reports) {
    const nlohmann::json* value = value_of(*each, field.key);
    if (value == nullptr || !value->is_number()) return {};
    all.push_back(value->get<Number>());
  }
  return all;
}

template <class Number>
Json sum(const Reports& reports, game::ReportField<Number> field) {
  const std::vector<Number> all = numbers(reports, field);
  return all.empty() ? Json(nullptr) : Json(std::accumulate(all.begin(), all.end(), Number{}));
}

template <class Number>
Json most(const Reports& reports, game::ReportField<Number> field) {
  const std::vector<Number> all = numbers(reports, field);
  return all.empty() ? Json(nullptr) : Json(*std::ranges::max_element(all));
}

Json least(const Reports& reports, game::AmountField field) {
  const std::vector<double> all = numbers(reports, field);
  return all.empty() ? Json(nullptr) : Json(*std::ranges::min_element(all));
}

Json mean(const Reports& reports, game::AmountField field) {
  const std::vector<double> all = numbers(reports, field);
  if (all.empty()) return nullptr;
  return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

Json merged(const Reports& reports, game::DurationsField field) {
  Histogram all;
  for (const nlohmann::json* each : reports) {
    const nlohmann::json* value = value_of(*each, field.key);
    const std::optional<Histogram> own = value ? Histogram::from_json(*value) : std::nullopt;
    if (!own) return nullptr;
    all.merge(*own);
  }
  return all.to_json();
}

/// The texts of all reports that have one, each behind `beginning` and its node's number.
std::string texts(const Reports& reports, game::TextField field, const std::string& beginning) {
  std::string all;
  for (std::size_t node = 0; node < reports.size(); ++node) {
    const nlohmann::json* value = value_of(*reports[node], field.key);
    if (value == nullptr || !value->is_string() || value->get_ref<const std::string&>().empty())
      continue;
    all += (all.empty() ? "" : "; ") + beginning + std::to_string(node) + ": " +
           value->get<std::string>();
  }
  return all;
}

Json joined(const Reports& reports, game::AmountsField field) {
  Json all = Json::array();
  for (const nlohmann::json* each : reports)
    if (const nlohmann::json* own = value_of(*each, field.key); own != nullptr && own->is_array())
      for (const nlohmann::json& amount : *own) all.push_back(Json(amount));
  return all;
}

/// Of all keys that were sent.
Json late_fraction(const Reports& crowds) {
  const std::vector<std::uint64_t> sent = numbers(crowds, report::keys_sent);
  const std::vector<double> late = numbers(crowds, report::late_sends_fraction);
  if (sent.empty() || sent.size() != late.size()) return nullptr;
  return std::inner_product(late.begin(), late.end(), sent.begin(), 0.0) /
         std::max(1.0, std::accumulate(sent.begin(), sent.end(), 0.0));
}

/// That of the agreed window, of which the inverse of a rate's inverse may be off by a bit.
Json rate_of(const Reports& servers) {
  const std::vector<double> all = numbers(servers, report::tick_rate_hz);
  return all.empty() ? Json(nullptr) : Json(std::round(1e9 * all.front()) / 1e9);
}

bool are_valid(const Reports& reports) {
  return std::ranges::all_of(reports, [](const nlohmann::json* each) {
    const nlohmann::json* value = value_of(*each, report::valid.key);
    return value != nullptr && value->is_boolean() && value->get<bool>();
  });
}

Reports servers_of(std::span<const NodeResults> nodes) {
  Reports all;
  for (const NodeResults& node : nodes) all.push_back(&node.server);
  return all;
}

Reports crowds_of(std::span<const NodeResults> nodes) {
  Reports all;
  for (const NodeResults& node : nodes) all.push_back(&node.bots);
  return all;
}

double number_in(const nlohmann::json& of, const char* key) {
  const nlohmann::json* value = value_of(of, key);
  if (value == nullptr || !value->is_number())
    throw Failure{std::string("a node or its bots reported no ") + key};
  return value->get<double>();
}

double span_of(const nlohmann::json& of) {
  const double span_s = number_in(of, report::measured_s.key);
  if (!(span_s > 0.0)) throw Failure{"a node or its bots measured nothing"};
  return span_s;
}

/// Bytes per second that one process sent on its clients' or servers' connections, with headers.
double sent_per_s(const nlohmann::json& of) {
  const SentAmounts sent{.bytes = number_in(of, report::bytes_sent.key),
                         .segments = number_in(of, report::segments_sent.key),
                         .acknowledgements = number_in(of, report::acknowledgements_sent.key),
                         .kernel_segments = number_in(of, report::kernel_segments_sent.key)};
  return sent.with_headers() / span_of(of);
}

/// Bytes per second that a node sent another one, with headers.
double sent_per_s(const NodeResults& from, std::size_t to) {
  const auto amount = [&](game::AmountsField field) {
    const nlohmann::json* value = value_of(from.server, field.key);
    if (value == nullptr || !value->is_array() || to >= value->size() || !value->at(to).is_number())
      throw Failure{"node " + std::to_string(from.number) + " reported no " + field.key + " for " +
                    std::to_string(to)};
    return value->at(to).get<double>();
  };
  const SentAmounts sent{.bytes = amount(report::node_bytes_sent),
                         .segments = amount(report::node_segments_sent),
                         .acknowledgements = amount(report::node_acknowledgements_sent),
                         .kernel_segments = amount(report::node_kernel_segments_sent)};
  return sent.with_headers() / span_of(from.server);
}

struct NodeTrafficRates {
  double busiest_link = 0.0, between = 0.0;  ///< bytes per second with headers
};

/// A link carries what its node and its clients send each other, and what the node and the others
/// do; what nodes send each other counts once in `between`, and in the links of both.
NodeTrafficRates rates_of(std::span<const NodeResults> nodes) {
  std::vector<double> links;
  for (const NodeResults& node : nodes)
    links.push_back(sent_per_s(node.server) + sent_per_s(node.bots));
  NodeTrafficRates rates;
  for (std::size_t from = 0; from < nodes.size(); ++from)
    for (std::size_t to = 0; to < nodes.size(); ++to) {
      if (from == to) continue;
      const double rate = sent_per_s(nodes[from], to);
      links[from] += rate, links[to] += rate, rates.between += rate;
    }
  rates.busiest_link = *std::ranges::max_element(links);
  return rates;
}

}  // namespace

std::string end_hash(const NodeResults& node) {
  const nlohmann::json* hash = value_of(node.server, report::state_hash.key);
  if (hash == nullptr || !hash->is_string())
    throw Failure{"node " + std::to_string(node.number) + " reported no " + report::state_hash.key};
  return hash->get<std::string>();
}

Json nodes_report(std::span<const NodeResults> nodes) {
  assert(!nodes.empty());
  const Reports servers = servers_of(nodes);
  const NodeTrafficRates rates = rates_of(nodes);
  Json result{{"schema", game::report_schema}, {"nodes", nodes.size()}};
  for (const game::AmountField field :
       {report::clients, report::bytes_sent, report::bytes_received, report::writes_sent,
        report::messages_sent, report::segments_sent, report::acknowledgements_sent,
        report::kernel_segments_sent, report::state_bytes_sent, report::key_bytes_received,
        report::total_bytes_sent, report::total_bytes_received, report::kernel_bytes_sent,
        report::kernel_bytes_received})
    result[field.key] = sum(servers, field);
  for (const game::CountField field : {report::lost_federates, report::dropped_connections})
    result[field.key] = sum(servers, field);
  for (const game::CountField field : {report::entities, report::ticks, report::server_rss_bytes})
    result[field.key] = most(servers, field);
  for (const game::AmountField field : {report::filter_us_per_tick, report::send_us_per_tick})
    result[field.key] = most(servers, field);
  result[report::tick_rate_hz.key] = rate_of(servers);
  result[report::ticks_on_time_fraction.key] = least(servers, report::ticks_on_time_fraction);
  result[report::physics_us_per_tick.key] = nullptr;
  result[report::measured_s.key] = mean(servers, report::measured_s);
  result[report::state_hash.key] = end_hash(nodes.front());
  const double span_s = mean(servers, report::measured_s).get<double>();
  result[report::busiest_link_bytes.key] = rates.busiest_link * span_s;
  result[report::between_nodes_bytes.key] = rates.between * span_s;
  result[report::valid.key] = are_valid(servers);
  result[report::why_invalid.key] = texts(servers, report::why_invalid, "node ");
  return result;
}

Json bots_report_of(std::span<const NodeResults> nodes) {
  assert(!nodes.empty());
  const Reports crowds = crowds_of(nodes);
  Json result{{"schema", game::report_schema}, {"nodes", nodes.size()}};
  for (const game::AmountField field :
       {report::clients, report::bytes_sent, report::bytes_received, report::segments_sent,
        report::acknowledgements_sent, report::kernel_segments_sent, report::total_bytes_sent,
        report::total_bytes_received, report::kernel_bytes_sent, report::kernel_bytes_received})
    result[field.key] = sum(crowds, field);
  for (const game::CountField field :
       {report::keys_due, report::keys_sent, report::keys_unanswered, report::federates_lost})
    result[field.key] = sum(crowds, field);
  for (const game::DurationsField field :
       {report::update_age_ms, report::key_to_effect_ms, report::send_lateness_ms})
    result[field.key] = merged(crowds, field);
  for (const game::AmountField field :
       {report::measured_s, report::cpu_share, report::histogram_ns_per_record})
    result[field.key] = mean(crowds, field);
  result[report::late_sends_fraction.key] = late_fraction(crowds);
  result[report::bytes_received_by_bot.key] = joined(crowds, report::bytes_received_by_bot);
  result[report::schedule_trouble.key] = texts(crowds, report::schedule_trouble, "at node ");
  result[report::valid.key] = are_valid(crowds);
  result[report::why_invalid.key] = texts(crowds, report::why_invalid, "bots of node ");
  return result;
}

}  // namespace rink::loadgen
