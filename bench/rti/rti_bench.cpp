// The RTI beside raw Asio: one tick sent to many clients; every figure counts what arrived.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <asio.hpp>
#include <atomic>
#include <chrono>
#include <deque>
#include <string>
#include <thread>
#include <vector>

#include "bench/clock.h"
#include "bench/rti/entity_federation.h"
#include "rti/transport/staged/guard.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::bench::rti_bench {
namespace {

using namespace rink::rti;
using namespace std::chrono_literals;

/// Puts a guard with this key on top, if there is one.
void guard(StagedTransport& transport, const SharedKey* key, Role role) {
  if (key != nullptr)
    transport.add<Guard>(*key, GuardSettings{.role = role}, [] { return seconds_of(); });
}

/// Reads and forgets on as many connections as asked for, in a thread of its own.
class Sinks {
 public:
  Sinks(std::uint16_t port, int count, bool are_federates, const SharedKey* key = nullptr) {
    thread_ = std::thread([this, port, count, are_federates, key] {
      TcpTransport sockets;
      StagedTransport tcp(sockets);
      guard(tcp, key, Role::federate);
      FederateLinks links;
      std::deque<CountingFederate> federates;
      std::deque<FederateLink> ends;
      for (int i = 0; i < count; ++i) {
        CountingFederate& federate = federates.emplace_back(reliable_entities());
        links.add(ends.emplace_back(federate.ambassador, tcp, sockets.connect("127.0.0.1", port)));
        if (!are_federates) continue;
        federate.join("client " + std::to_string(i), "client");
        federate.subscribe(reliable_entities());
      }
      Raw raw;
      while (!is_over_) {
        if (are_federates) links.flush(0.0);
        tcp.poll(1ms, are_federates ? static_cast<TransportListener&>(links) : raw);
        std::uint64_t sum = raw.bytes;
        for (const CountingFederate& federate : federates)
          sum += federate.ambassador.counters().bytes_received;
        received_ = sum;
      }
    });
  }
  ~Sinks() {
    is_over_ = true;
    thread_.join();
  }
  std::uint64_t received() const { return received_; }

 private:
  struct Raw final : TransportListener {
    std::uint64_t bytes = 0;
    void on_open(ConnectionId) override {}
    void on_bytes(ConnectionId, Bytes received) override { bytes += received.size(); }
    void on_close(ConnectionId, CloseReason, const std::string&) override {}
  };
  std::atomic<bool> is_over_{false};
  std::atomic<std::uint64_t> received_{0};
  std::thread thread_;
};

/// Ticks of 275 positions to each client; the figure is the sender's processor time per client and
/// tick.
void tick_send(benchmark::State& state, const SharedKey* key) {
  const int clients = static_cast<int>(state.range(0));
  ensure_file_limit(static_cast<std::size_t>(2 * clients) + 64);
  FederationSettings settings;
  settings.timeouts.lost_after_s = 1e9;
  TcpTransport sockets;
  StagedTransport tcp(sockets);
  guard(tcp, key, Role::rti);
  EntityFederation federation(reliable_entities(), settings, tcp);
  Sinks sinks(sockets.listen("127.0.0.1", 0), clients, true, key);
  while (!federation.has(clients)) federation.tick(0.0);
  federation.register_entities();
  double busy_s = 0.0;
  const auto arrived = [&] {
    return sinks.received() >= federation.execution.counters().bytes_sent -
                                   federation.federate.ambassador.counters().bytes_received;
  };
  const std::uint64_t bytes_before = sinks.received();
  for (auto _ : state) {
    federation.update_all({busy_s, 1});
    const double start = seconds_of();
    federation.tick(0.0);
    busy_s += seconds_of() - start;
    while (!arrived()) std::this_thread::sleep_for(100us);
  }
  const double ticks = static_cast<double>(state.iterations());
  state.counters["cpu_us_per_client"] = 1e6 * busy_s / ticks / clients;
  state.counters["bytes_per_client"] =
      static_cast<double>(sinks.received() - bytes_before) / ticks / clients;
}

void rink_tick_send(benchmark::State& state) { tick_send(state, nullptr); }
void sealed_tick_send(benchmark::State& state) {
  const SharedKey key(std::as_bytes(std::span("a key that is long enough")));
  tick_send(state, &key);
}

/// The same bytes by one raw send per client.
void raw_tick_send(benchmark::State& state) {
  const int clients = static_cast<int>(state.range(0));
  ensure_file_limit(static_cast<std::size_t>(2 * clients) + 64);
  asio::io_context context;
  asio::ip::tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
  Sinks sinks(acceptor.local_endpoint().port(), clients, false);
  std::vector<asio::ip::tcp::socket> sockets;
  for (int i = 0; i < clients; ++i) {
    sockets.push_back(acceptor.accept());
    sockets.back().set_option(asio::ip::tcp::no_delay(true));
  }
  const std::vector<std::byte> message(
      4 + 21 +
      EntityFederation::seen_count *
          9);  // as long as Rink's: frame, stamp and block, then a step and 8 bytes for each
  double busy_s = 0.0;
  std::uint64_t sent = 0;
  for (auto _ : state) {
    const double start = seconds_of();
    for (asio::ip::tcp::socket& socket : sockets)
      sent += asio::write(socket, asio::buffer(message));
    busy_s += seconds_of() - start;
    while (sinks.received() < sent) std::this_thread::sleep_for(100us);
  }
  const double ticks = static_cast<double>(state.iterations());
  state.counters["cpu_us_per_client"] = 1e6 * busy_s / ticks / clients;
  state.counters["bytes_per_client"] = static_cast<double>(sinks.received()) / ticks / clients;
}

BENCHMARK(raw_tick_send)->Name("rti/tick_send/raw_tcp")->Apply(send_to_crowds);
BENCHMARK(rink_tick_send)->Name("rti/tick_send/rink")->Apply(send_to_crowds);
BENCHMARK(sealed_tick_send)->Name("rti/tick_send/sealed")->Apply(send_to_crowds);

}  // namespace
}  // namespace rink::bench::rti_bench
