// The definitions, and their table. docs/metrics.md has the whole of each method.
#include "loadgen/report/dictionary.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>

#include "loadgen/experiment/csv_text.h"
#include "loadgen/measure/summary.h"
#include "loadgen/report/table_columns.h"

namespace rink::loadgen {
namespace {

constexpr std::array of_cells{
    Definition{"part", "", "experiment part",
               "Part of the experiment that the run belongs to, empty if it has none"},
    Definition{"mode", "", "architecture",
               "How the federation is distributed: client-server, peer-to-peer, or dds"},
    Definition{"scheme", "", "interest-management filter",
               "Interest-management filter, or an expression of several"},
    Definition{"policy", "", "update policy", "When an entity's state is sent"},
    Definition{"clients", "1", "players, federates", "Number of clients that connect, or of peers"},
    Definition{"pucks", "1", "",
               "Number of pucks on the field, 0 where the scene's own number is taken"},
    Definition{"bats", "1", "",
               "Number of bats on the field, 0 where the scene's own number is taken"},
    Definition{"server_cores", "1", "",
               "1: the server has a processor of its own; 2: server and bots run on any"},
    Definition{"view_fraction", "1", "area fraction",
               "Area of a client's view divided by the area of the field"},
    Definition{"view_margin", "m", "",
               "Distance by which the declared region exceeds the view on each side"},
    Definition{"sweep_ticks", "1", "",
               "Ticks ahead over which update regions are swept, 0 where they are not"},
    Definition{"cell_size", "m", "",
               "Side of a cell of schemes that have cells, 0 where the scheme chooses"},
    Definition{"tick_rate_hz", "Hz", "update rate, frame rate",
               "Ticks of the server per second; interest is decided in each"},
    Definition{"threshold", "m", "dead-reckoning threshold",
               "Error of its receivers at which a dead-reckoning policy sends an update"},
    Definition{"extrapolate", "1", "dead reckoning, first order",
               "1 where clients extrapolate entities that are updated by positions alone, else 0"},
    Definition{"nodes", "1", "cluster size",
               "Servers that share the simulation, each with its part of the clients"},
    Definition{"output_rate_hz", "Hz", "update rate, send rate",
               "Times a second that a client is told of changes, 0 where it is at each tick"},
    Definition{"seed", "1", "replication",
               "Seed of the population and of the keys: replications differ in it alone"},
    Definition{"valid", "", "",
               "Whether the run counts; one that does not enters no mean, ratio or plot"},
};

constexpr std::array of_figures{
    Definition{"entities", "1", "objects", "Bodies that the server publishes"},
    Definition{"ticks", "1", "steps, frames", "Ticks within the measured span"},
    Definition{"measured_s", "s", "observation time",
               "Length of the measured span by the server's clock, over which rates are taken"},
    Definition{"ticks_on_time_fraction", "1", "deadlines met",
               "Ticks that were finished before the next was due divided by all ticks"},
    Definition{
        "down_bytes_per_client_per_s", "B/s", "downstream payload, goodput",
        "Payload that the server sent divided by clients and measured seconds, without headers"},
    Definition{"up_bytes_per_client_per_s", "B/s", "upstream payload",
               "Payload, without headers, that it received divided by clients and seconds"},
    Definition{"wire_bytes_per_client_per_s", "B/s", "bandwidth, network load",
               "Bytes of both directions with headers of Ethernet, IPv4 and TCP and with "
               "acknowledgements, divided by clients and measured seconds"},
    Definition{"messages_per_s", "1/s", "message rate, updates and interactions",
               "Attribute updates and interactions delivered to all clients per measured second"},
    Definition{
        "update_age_ms", "ms", "update latency",
        "Time from the instant at which a tick was due to the first of its news being "
        "applied to the client's replica set, one sample per client and tick that brought any"},
    Definition{
        "update_age_samples", "1", "sample size",
        "Number of samples of update_age_ms: clients times ticks, less what brought no news"},
    Definition{"key_to_effect_ms", "ms", "input latency, response time",
               "Time from the instant at which a key was due to the first state of the own bat in "
               "the client's replica set that has felt it"},
    Definition{"physics_us_per_tick", "us", "", "Wall time of the server's physics, mean per tick"},
    Definition{"filter_us_per_tick", "us", "matching time",
               "Wall time of the server's interest management, mean per tick"},
    Definition{"send_us_per_tick", "us", "",
               "Wall time of the server's encoding and sending, mean per tick"},
    Definition{"server_rss_bytes", "B", "memory",
               "Resident memory of the server at the end of the run"},
    Definition{"segments_per_s", "1/s", "packet rate",
               "TCP segments with payload of both directions and all clients per measured second"},
    Definition{
        "acknowledgements_per_s", "1/s", "pure ACK rate",
        "TCP segments without payload of both directions and all clients per measured second"},
    Definition{"writes_per_s", "1/s", "",
               "Writes of the server to its sockets per measured second"},
    Definition{"keys_due", "1", "", "Keys that the bots' plan has within the run"},
    Definition{"keys_sent", "1", "", "Keys that the bots sent, late ones among them"},
    Definition{"late_sends_fraction", "1", "",
               "Keys that the bots sent more than 10 ms late divided by all that they sent"},
    Definition{"server_cpu_s", "s", "CPU time of the server",
               "Processor time of the server from start to end, by the kernel"},
    Definition{"bots_cpu_s", "s", "CPU time of the load generator",
               "Processor time of the bots from start to end, by the kernel"},
    Definition{"filter_precision", "1", "filtering precision",
               "Of the pairs of player and entity that the filter let through, the fraction that "
               "truth calls relevant"},
    Definition{"filter_recall", "1", "filtering recall, completeness",
               "Of the pairs of player and entity that truth calls relevant, the fraction that the "
               "filter let through"},
    Definition{
        "delivered_precision", "1", "",
        "Of the pairs of player and entity that the players' replica sets held, the fraction "
        "that truth calls relevant at the displayed instant"},
    Definition{"delivered_recall", "1", "",
               "Of the pairs of player and entity that truth calls relevant at the displayed "
               "instant, the fraction that the players' replica sets held"},
    Definition{"interactions", "1", "events",
               "Contacts of watched players' bats with other bodies within the measured span"},
    Definition{"missed_interactions", "1", "missed events",
               "Contacts of watched players' bats with bodies that the player did not know of at "
               "that instant"},
    Definition{"late_entry_ms", "ms", "discovery latency",
               "Time from the instant at which an entity became relevant to a player to its first "
               "delivered state"},
    Definition{
        "position_error_mm", "mm", "dead-reckoning error at the time stamp, replica error",
        "Distance from where a replica set has an entity to where it was at the set's newest "
        "time stamp"},
    Definition{
        "displayed_error_mm", "mm", "dead-reckoning error now, replica error, inconsistency",
        "Distance from where a client shows an entity at an instant to where it truly is then"},
    Definition{"churn_per_client_per_s", "1/s", "changes of interest set",
               "Entries and exits delivered divided by watched players and measured seconds"},
    Definition{"flapping_fraction", "1", "thrashing",
               "Entries of an entity that had left less than 1 s before divided by all entries"},
    Definition{
        "wasted_bytes_fraction", "1", "irrelevant traffic",
        "Bytes of updates of entities that were not relevant divided by all bytes of updates"},
    Definition{
        "control_bytes_fraction", "1", "protocol overhead",
        "Payload of both directions that is neither entity states nor keys divided by all payload"},
    Definition{"fairness_jain", "1", "Jain's index",
               "Square of the sum of the payloads that the clients received divided by clients "
               "times the sum of their squares: 1 if all received the same"},
    Definition{"bots_cpu_share", "1", "CPU utilisation of the load generator",
               "Processor time of the bots within the measured span divided by its wall time and "
               "the number of processors that they may use"},
    Definition{"histogram_ns_per_record", "ns", "measurement overhead",
               "What recording one latency costs the bots, mean of 100,000 at their start"},
    Definition{"tick_us", "us", "frame time, step time",
               "Wall time of a whole tick (physics, filter, sending) within the measured span"},
    Definition{"halo_bytes_per_client_per_s", "B/s", "ghost exchange",
               "Payload of states handed over between peers at the end of a window, divided by "
               "clients and measured seconds"},
    Definition{"claims_bytes_per_client_per_s", "B/s", "",
               "Payload of what proves a window among peers, per client and measured second"},
    Definition{"agreement_bytes_per_client_per_s", "B/s", "consensus traffic",
               "Payload of the peers' verdicts, divided by clients and measured seconds"},
    Definition{"interest_bytes_per_client_per_s", "B/s", "subscription traffic",
               "Payload of where players look (with a server all control), per client and second"},
    Definition{"updates_bytes_per_client_per_s", "B/s", "attribute update traffic",
               "Payload of entity states, divided by clients and measured seconds"},
    Definition{"keys_bytes_per_client_per_s", "B/s", "input traffic",
               "Payload of keys and of how many were felt, per client and measured second"},
    Definition{"busiest_node_bytes_per_s", "B/s", "bottleneck bandwidth",
               "Payload that the busiest node sent and received per measured second"},
    Definition{"busiest_node_events_per_s", "1/s", "bottleneck computation",
               "Physics events of the busiest node per measured second, ghosts' included"},
    Definition{"busiest_node_cpu_s", "s", "CPU time of the bottleneck",
               "Processor time of the busiest node from start to end, by the kernel"},
    Definition{"mean_node_cpu_s", "s", "CPU time per node",
               "Processor time from start to end, by the kernel, mean over all nodes: server and "
               "bots, or peers"},
    Definition{"standby_bytes_per_client_per_s", "B/s", "fault tolerance",
               "Payload of standby copies, divided by clients and measured seconds"},
    Definition{"busiest_link_bytes_per_s", "B/s", "bottleneck bandwidth",
               "busiest_node_bytes_per_s with headers, of acknowledgements too"},
    Definition{"between_nodes_bytes_per_s", "B/s", "inter-server bandwidth",
               "Bytes that nodes send each other per measured second, with headers"},
};

struct NameEnding {
  std::string_view suffix, meaning;
  std::string_view unit{};  ///< empty: that of the field
};

/// The endings that figures add to their field's name.
constexpr std::array endings{
    NameEnding{"", ""},
    NameEnding{"_rms", "; root mean square over all samples"},
    NameEnding{"_p50", "; median of the samples"},
    NameEnding{"_p90", "; 90th percentile of the samples"},
    NameEnding{"_p95", "; 95th percentile of the samples"},
    NameEnding{"_p99", "; 99th percentile of the samples"},
    NameEnding{"_p999", "; 99.9th percentile of the samples"},
    NameEnding{"_max", "; maximum of the samples"},
    NameEnding{"_replaced_samples", "; number of samples of pucks put back, left out", "1"},
    NameEnding{"_replaced_rms", "; root mean square over those samples"}};

const NameEnding* ending_of(const std::string& name, const Definition& definition) {
  const std::string_view field = definition.field;
  if (!name.starts_with(field)) return nullptr;
  const auto ending =
      std::ranges::find(endings, std::string_view(name).substr(field.size()), &NameEnding::suffix);
  return ending == endings.end() ? nullptr : &*ending;
}

/// A line of the dictionary; `kind` is "cell", "figure" or the table that has the column.
std::string line_of(const std::string& name, const std::string& kind, const Definition& definition,
                    const std::string& field, const std::string& meaning) {
  return name + "," + kind + "," + definition.unit + "," + csv_text(definition.alias) + "," +
         field + "," + csv_text(meaning) + "\n";
}

std::string figure_line(const std::string& name) {
  const Definition* found = definition_of(name);
  assert(found != nullptr);
  Definition definition = *found;
  const std::string unit = unit_of(name);
  definition.unit = unit.c_str();
  return line_of(
      name, "figure", definition, definition.field,
      std::string(definition.meaning) + std::string(ending_of(name, definition)->meaning));
}

}  // namespace

std::span<const Definition> cell_definitions() { return of_cells; }

std::span<const Definition> figure_definitions() { return of_figures; }

const Definition* definition_of(const std::string& name) {
  const auto found = std::ranges::find_if(of_figures, [&name](const Definition& definition) {
    return ending_of(name, definition) != nullptr;
  });
  return found == of_figures.end() ? nullptr : &*found;
}

std::string unit_of(const std::string& name) {
  const Definition* definition = definition_of(name);
  assert(definition != nullptr);
  const std::string_view own = ending_of(name, *definition)->unit;
  return own.empty() ? definition->unit : std::string(own);
}

std::string data_dictionary_csv() {
  std::string csv = "name,kind,unit,alias,field,definition\n";
  for (const Definition& cell : of_cells)
    csv += line_of(cell.field, "cell", cell, cell.field, cell.meaning);
  for (const Figure& figure : figures()) csv += figure_line(figure.name);
  for (const TableColumns& each : table_columns())
    for (const Definition& column : each.columns)
      csv += line_of(column.field, each.table, column, "",
                     "In " + std::string(each.table) + ".csv: " + column.meaning);
  return csv;
}

}  // namespace rink::loadgen
