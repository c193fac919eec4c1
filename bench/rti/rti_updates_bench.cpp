// Updates per second from one publisher over TCP through the RTI to its subscribers over TCP,
// beside a raw batched sender; what counts is what arrived with the right content.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <asio.hpp>
#include <atomic>
#include <chrono>
#include <cstring>
#include <deque>
#include <string>
#include <thread>
#include <vector>

#include "bench/clock.h"
#include "rti/ambassador.h"
#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::bench::rti_updates_bench {
namespace {

using namespace rink::rti;
using namespace std::chrono_literals;

constexpr const char* model_xml =
    R"(<objectModel><objects><objectClass><name>Root</name><objectClass><name>Entity</name>
<attribute><name>state</name><dataType>State</dataType></attribute>
</objectClass></objectClass></objects><dataTypes><fixedRecordDataTypes><fixedRecordData><name>State</name>
<field><name>object</name><dataType>HLAinteger64LE</dataType></field><field><name>round</name><dataType>HLAinteger64LE</dataType></field>
<field><name>check</name><dataType>HLAinteger64LE</dataType></field></fixedRecordData></fixedRecordDataTypes></dataTypes></objectModel>)";

const Fom& model() {
  static const Fom fom = Fom::parse(model_xml, "bench");
  return fom;
}

constexpr std::uint64_t object_count = 256;  ///< updates in one write of the publisher
constexpr std::uint64_t round_window =
    64;  ///< rounds under way at most: 400 kB, below what any queue holds

/// One update's content, 24 bytes: any mix-up of objects, rounds or bytes shows.
struct State {
  std::uint64_t object = 0, round = 0, check = 0;
  static State of(std::uint64_t object, std::uint64_t round) {
    return {object, round, (object * 0x9E3779B97F4A7C15u) ^ (round * 0xC2B2AE3D27D4EB4Fu)};
  }
  bool is_sound() const { return check == of(object, round).check; }
};
static_assert(sizeof(State) == 24);

double process_seconds() { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

/// What has arrived at all subscribers of a thread; `least`: at the one that is furthest behind.
struct Arrivals {
  std::atomic<std::uint64_t> delivered{0}, least{0}, discovered{0};
  std::atomic<bool> is_spoilt{false}, is_over{false};
};

/// Hears of all objects; each must be told each round once, in order.
struct Subscriber : FederateAmbassador {
  Ambassador ambassador{model(), *this};
  std::uint64_t delivered = 0, discovered = 0;
  bool is_spoilt = false;
  std::array<std::uint64_t, object_count> next_round{};
  void discover_object_instance(ObjectHandle, ObjectClassHandle, std::string_view) override {
    ++discovered;
  }
  void reflect_attribute_values(ObjectHandle, AttributeSet, Bytes values, const Stamp&) override {
    State state;
    std::memcpy(&state, values.data(), sizeof state);
    is_spoilt |= !state.is_sound() || state.object >= object_count ||
                 next_round[state.object]++ != state.round;
    ++delivered;
  }
};

void run_subscribers(std::uint16_t port, int count, Arrivals& arrivals) {
  TcpTransport tcp;
  FederateLinks links;
  std::deque<Subscriber> subscribers;
  std::deque<FederateLink> ends;
  const ObjectClassHandle entity = *model().object_class("Entity");
  for (int i = 0; i < count; ++i) {
    Subscriber& subscriber = subscribers.emplace_back();
    links.add(ends.emplace_back(subscriber.ambassador, tcp, tcp.connect("127.0.0.1", port)));
    subscriber.ambassador.join("rink", "subscriber " + std::to_string(i), "subscriber");
    subscriber.ambassador.subscribe_object_class_attributes(entity, model().attributes(entity));
  }
  while (!arrivals.is_over) {
    links.flush(0.0);
    tcp.poll(1ms, links);
    std::uint64_t sum = 0, least = UINT64_MAX, discovered = 0;
    for (const Subscriber& each : subscribers) {
      sum += each.delivered, least = std::min(least, each.delivered), discovered += each.discovered;
      if (each.is_spoilt) arrivals.is_spoilt = true;
    }
    arrivals.delivered = sum, arrivals.least = least, arrivals.discovered = discovered;
  }
}

void run_rti(std::atomic<std::uint16_t>& port, std::atomic<std::size_t>& federates,
             const std::atomic<bool>& is_over) {
  FederationSettings settings;
  settings.timeouts.lost_after_s = 1e9;
  FederationExecution execution(model(), settings);
  FederationHost host(execution);
  TcpTransport tcp;
  host.add(tcp);
  port = tcp.listen("127.0.0.1", 0);
  while (!is_over) {
    host.poll(1ms);
    host.match();
    host.flush();
    federates = execution.federate_count();
  }
}

/// Publishes rounds by `publish(round)`, never more than the window ahead of what each subscriber
/// has: for whoever is further behind, the RTI keeps the newest round only.
template <class Publish>
void measure_updates(benchmark::State& state, Arrivals& arrivals, Publish publish) {
  std::uint64_t round = 0;
  const auto await_rounds = [&](std::uint64_t rounds) {
    while (arrivals.least < rounds * object_count && !arrivals.is_spoilt)
      std::this_thread::sleep_for(20us);
  };
  const double start_s = process_seconds();
  for (auto _ : state) {
    publish(round++);
    if (round > round_window) await_rounds(round - round_window);
    if (arrivals.is_spoilt) return state.SkipWithError("a wrong update arrived");
  }
  await_rounds(round);
  const auto delivered = static_cast<double>(arrivals.delivered);
  state.SetItemsProcessed(static_cast<std::int64_t>(delivered));
  state.counters["cpu_us_per_delivery"] = 1e6 * (process_seconds() - start_s) / delivered;
}

/// One publisher, the RTI and the subscribers have a thread each.
void rink_updates(benchmark::State& state) {
  const int subscribers = static_cast<int>(state.range(0));
  std::atomic<std::uint16_t> port{0};
  std::atomic<std::size_t> federates{0};
  Arrivals arrivals;
  std::thread rti([&] { run_rti(port, federates, arrivals.is_over); });
  while (port == 0) std::this_thread::sleep_for(100us);
  TcpTransport tcp;
  Subscriber publisher;
  FederateLink link(publisher.ambassador, tcp, tcp.connect("127.0.0.1", port));
  FederateLinks links;
  links.add(link);
  const ObjectClassHandle entity = *model().object_class("Entity");
  const AttributeSet all = model().attributes(entity);
  publisher.ambassador.join("rink", "publisher", "publisher");
  publisher.ambassador.publish_object_class_attributes(entity, all);
  std::thread sinks([&] { run_subscribers(port, subscribers, arrivals); });
  while (federates < static_cast<std::size_t>(subscribers) + 1 ||
         !publisher.ambassador.is_joined()) {
    links.flush(0.0);
    tcp.poll(1ms, links);
  }
  std::vector<ObjectHandle> objects;
  for (std::uint64_t i = 0; i < object_count; ++i)
    objects.push_back(publisher.ambassador.register_object_instance(entity));
  links.flush(0.0);
  // Whoever had not discovered an object yet would get its first rounds as one state.
  while (arrivals.discovered < object_count * static_cast<std::uint64_t>(subscribers)) {
    links.flush(0.0);
    tcp.poll(1ms, links);
  }
  measure_updates(state, arrivals, [&](std::uint64_t round) {
    for (std::uint64_t i = 0; i < object_count; ++i) {
      const State content = State::of(i, round);
      publisher.ambassador.update_attribute_values(
          objects[i], all, std::as_bytes(std::span(&content, 1)), {static_cast<double>(round), 0});
    }
    links.flush(0.0);
    tcp.poll(0ms, links);
  });
  arrivals.is_over = true;
  rti.join();
  sinks.join();
}

/// Reads updates one after the other from a stream cut anywhere, as a subscriber without an RTI
/// would.
class RawSink final : public TransportListener {
 public:
  std::uint64_t delivered = 0;
  bool is_spoilt = false;
  /// At the one of `count` connections that is furthest behind.
  std::uint64_t least(std::size_t count) const {
    return by_connection_.size() < count
               ? 0
               : *std::min_element(by_connection_.begin(), by_connection_.end());
  }
  void on_open(ConnectionId) override {}
  void on_close(ConnectionId, CloseReason, const std::string&) override {}
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    if (connection >= partial_.size())
      partial_.resize(connection + 1), by_connection_.resize(connection + 1);
    std::vector<std::byte>& partial = partial_[connection];
    while (!bytes.empty()) {
      if (partial.empty() && bytes.size() >= sizeof(State)) {
        take(connection, bytes);
        bytes = bytes.subspan(sizeof(State));
        continue;
      }
      const Bytes taken = bytes.first(std::min(bytes.size(), sizeof(State) - partial.size()));
      partial.insert(partial.end(), taken.begin(), taken.end());
      bytes = bytes.subspan(taken.size());
      if (partial.size() < sizeof(State)) return;
      take(connection, partial);
      partial.clear();
    }
  }

 private:
  void take(ConnectionId connection, Bytes bytes) {
    State state;
    std::memcpy(&state, bytes.data(), sizeof state);
    is_spoilt |= !state.is_sound();
    ++delivered, ++by_connection_[connection];
  }
  std::vector<std::vector<std::byte>> partial_;
  std::vector<std::uint64_t> by_connection_;
};

/// The same updates in the same batches, by one blocking write per subscriber from the publisher
/// itself: no RTI between.
void raw_updates(benchmark::State& state) {
  const int subscribers = static_cast<int>(state.range(0));
  asio::io_context context;
  asio::ip::tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
  Arrivals arrivals;
  std::thread sinks([&, port = acceptor.local_endpoint().port()] {
    TcpTransport tcp;
    RawSink sink;
    for (int i = 0; i < subscribers; ++i) tcp.connect("127.0.0.1", port);
    while (!arrivals.is_over) {
      tcp.poll(1ms, sink);
      if (sink.is_spoilt) arrivals.is_spoilt = true;
      arrivals.delivered = sink.delivered,
      arrivals.least = sink.least(static_cast<std::size_t>(subscribers));
    }
  });
  std::vector<asio::ip::tcp::socket> sockets;
  for (int i = 0; i < subscribers; ++i) {
    sockets.push_back(acceptor.accept());
    sockets.back().set_option(asio::ip::tcp::no_delay(true));
  }
  std::vector<State> batch(object_count);
  measure_updates(state, arrivals, [&](std::uint64_t round) {
    for (std::uint64_t i = 0; i < object_count; ++i) batch[i] = State::of(i, round);
    for (asio::ip::tcp::socket& socket : sockets) asio::write(socket, asio::buffer(batch));
  });
  arrivals.is_over = true;
  sinks.join();
}

BENCHMARK(raw_updates)
    ->Name("rti/updates/raw_asio")
    ->ArgName("subscribers")
    ->Arg(1)
    ->Arg(64)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(rink_updates)
    ->Name("rti/updates/rink")
    ->ArgName("subscribers")
    ->Arg(1)
    ->Arg(64)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace rink::bench::rti_updates_bench
