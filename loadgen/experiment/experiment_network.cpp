// Reads latency, jitter, loss, order, copies, rates and cuts, for both directions at once or each
// apart.
#include "loadgen/experiment/experiment_network.h"

#include <algorithm>
#include <cmath>

namespace rink::loadgen {
namespace {

constexpr double ns_per_ms = 1e6, ns_per_s = 1e9;

void read_time(ExperimentReader& reader, const char* key, std::int64_t& into_ns) {
  double value_ms = static_cast<double>(into_ns) / ns_per_ms;
  reader.number(key, value_ms, "a number from 0 to 10000",
                [](double v) { return v >= 0.0 && v <= 10'000.0; });
  into_ns = std::llround(value_ms * ns_per_ms);
}

void read_fraction(ExperimentReader& reader, const char* key, double& into) {
  reader.number(key, into, "a number from 0 to 1", [](double v) { return v >= 0.0 && v <= 1.0; });
}

/// `loss` alone means independent losses, with `burst` runs of that mean length; `gilbert_elliott`
/// gives the four probabilities of the chain.
void read_loss(ExperimentReader& reader, rti::PacketLoss& into) {
  if (auto chain = reader.table("gilbert_elliott")) {
    if (reader.has("loss") || reader.has("burst"))
      chain->refuse_all("loss and burst mean the same as gilbert_elliott: expected one of both");
    into = {};
    read_fraction(*chain, "to_bad", into.to_bad);
    read_fraction(*chain, "to_good", into.to_good);
    read_fraction(*chain, "loss_good", into.loss_good);
    read_fraction(*chain, "loss_bad", into.loss_bad);
    return chain->refuse_the_rest();
  }
  if (!reader.has("loss") && !reader.has("burst")) return;
  double loss = 0.0, burst = 0.0;
  reader.number("loss", loss, "a number from 0 to 0.99",
                [](double v) { return v >= 0.0 && v <= 0.99; });
  reader.number(
      "burst", burst,
      "0 (each packet for itself), or a number from 1 to 1000 that is at least loss / (1 - loss)",
      [loss](double v) {
        return v == 0.0 || (v >= 1.0 && v <= 1000.0 && loss / (1.0 - loss) <= v);
      });
  into =
      burst == 0.0 ? rti::PacketLoss::independent(loss) : rti::PacketLoss::in_bursts(loss, burst);
}

void read_link(ExperimentReader& reader, rti::LinkConditions& into) {
  read_time(reader, "latency_ms", into.latency_ns);
  read_time(reader, "jitter_ms", into.jitter_ns);
  read_loss(reader, into.loss);
  read_fraction(reader, "reorder", into.reorder);
  read_time(reader, "reorder_ms", into.held_ns);
  read_fraction(reader, "duplicate", into.duplicate);
  if (const auto rate = reader.whole_number("rate_bits_per_s", 0, 100'000'000'000))
    into.rate_bits_per_s = static_cast<std::uint64_t>(*rate);
  if (const auto queue = reader.whole_number("queue_bytes", 1500, 1'000'000'000))
    into.queue_bytes = static_cast<std::size_t>(*queue);
}

/// `up` is for what clients send, `down` for what the server sends; the table's own keys are for
/// both, and missing keys keep their defaults.
void read_directions(ExperimentReader& reader, rti::LinkConditions& up, rti::LinkConditions& down) {
  for (rti::LinkConditions* direction : {&up, &down}) read_link(reader, *direction);
  const auto read = [&reader](const char* key, rti::LinkConditions& into) {
    if (auto direction = reader.table(key)) {
      read_link(*direction, into);
      direction->refuse_the_rest();
    }
  };
  read("up", up);
  read("down", down);
}

void read_links(ExperimentReader& reader, std::uint32_t& first, std::uint32_t& last) {
  if (const auto link = reader.whole_number("first", 0, 100'000))
    first = static_cast<std::uint32_t>(*link);
  if (const auto link = reader.whole_number("last", first, 100'000))
    last = static_cast<std::uint32_t>(*link);
}

rti::Partition partition_of(ExperimentReader& reader) {
  double from_s = 0.0, until_s = 0.0;
  reader.number("from_s", from_s, "a number from 0 to 4200",
                [](double v) { return v >= 0.0 && v <= 4200.0; });
  reader.number("until_s", until_s, "a number above from_s, at most 4200",
                [from_s](double v) { return v > from_s && v <= 4200.0; });
  if (until_s <= from_s) reader.refuse_all("until_s is missing: a number above from_s is required");
  rti::Partition partition{.from_ns = std::llround(from_s * ns_per_s),
                           .until_ns = std::llround(until_s * ns_per_s)};
  read_links(reader, partition.first, partition.last);
  std::optional<rti::LinkDirection> direction;
  reader.choice<std::optional<rti::LinkDirection>>("direction", direction,
                                                   {{"both", std::nullopt},
                                                    {"up", rti::LinkDirection::to_listener},
                                                    {"down", rti::LinkDirection::from_listener}});
  partition.direction = direction;
  reader.refuse_the_rest();
  return partition;
}

}  // namespace

void read_network(ExperimentReader& reader, Experiment& result) {
  rti::NetworkConditions& network = result.network;
  const std::int64_t delay_ns = std::llround(result.delay_ms * ns_per_ms);
  network.to_listener.latency_ns = network.from_listener.latency_ns = delay_ns;
  auto table = reader.table("network");
  if (!table) return;
  if (result.transport != TransportKind::virtual_time)
    table->refuse_all("only transport = \"virtual\" has a modelled network");
  if (const auto seed = table->whole_number("seed", 0, 1'000'000'000))
    network.seed = static_cast<std::uint64_t>(*seed);
  table->choice<bool>("channels", result.network_carries_datagrams,
                      {{"reliable", false}, {"datagrams", true}});
  read_directions(*table, network.to_listener, network.from_listener);
  for (ExperimentReader& links : table->tables("links")) {
    rti::LinkException exception{.first = 0,
                                 .last = 0,
                                 .to_listener = network.to_listener,
                                 .from_listener = network.from_listener};
    read_links(links, exception.first, exception.last);
    exception.last = std::max(exception.first, exception.last);
    read_directions(links, exception.to_listener, exception.from_listener);
    links.refuse_the_rest();
    network.exceptions.push_back(exception);
  }
  for (ExperimentReader& cut : table->tables("partition"))
    network.partitions.push_back(partition_of(cut));
  table->refuse_the_rest();
  result.network_is_modelled = true;
  result.delay_ms = static_cast<double>(std::max(network.to_listener.latency_ns,
                                                 network.from_listener.latency_ns)) /
                    ns_per_ms;
}

}  // namespace rink::loadgen
