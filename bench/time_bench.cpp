// A whole federation advancing in lockstep: steps per second over TCP and in process; every figure
// counts grants that arrived.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "rti/ambassador.h"
#include "rti/federation_execution.h"
#include "rti/time/federate_clock.h"
#include "rti/transport/bundle.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"
#include "rti/transport/shared_memory/shared_memory.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::bench::time_bench {
namespace {

using namespace rink::rti;
using namespace std::chrono_literals;

/// Nothing is said but when to go on.
const Fom& empty_model() {
  static const Fom fom = Fom::parse(
      "<objectModel><objects><objectClass><name>Root</name></objectClass></objects>"
      "<interactions><interactionClass><name>Root</name></interactionClass></interactions></"
      "objectModel>",
      "bench");
  return fom;
}

/// Regulating and constrained, with a lookahead of one step, so that nobody can be a step ahead of
/// anybody.
struct Stepper : FederateAmbassador {
  static constexpr double step = 1.0;
  Ambassador ambassador{empty_model(), *this};
  std::uint64_t grants = 0;
  int enabled = 0;
  std::string lost;
  void joined(FederateHandle) override {
    ambassador.enable_time_regulation(step);
    ambassador.enable_time_constrained();
  }
  void time_regulation_enabled(LogicalTime) override { ++enabled; }
  void time_constrained_enabled(LogicalTime) override { ++enabled; }
  void time_advance_grant(LogicalTime) override { ++grants; }
  void connection_lost(std::string_view why) override { lost = why; }
  void ask() { ambassador.time_advance_request(LogicalTime(ambassador.clock().time() + step)); }
};

/// So many federates on one transport, driven by the calling thread.
struct Crowd {
  template <class Connect>
  Crowd(Transport& transport, int count, Connect connect) : transport(transport) {
    for (int i = 0; i < count; ++i) {
      Stepper& stepper = steppers.emplace_back();
      links.add(ends.emplace_back(stepper.ambassador, transport, connect()));
      stepper.ambassador.join("rink", "federate " + std::to_string(i), "stepper");
    }
  }
  void send() {
    for (FederateLink& each : ends) each.flush(0.0);
  }
  bool is_ready() const {
    for (const Stepper& each : steppers)
      if (each.enabled < 2) return false;
    return true;
  }
  bool have_all(std::uint64_t grants) const {
    for (const Stepper& each : steppers)
      if (each.grants < grants) return false;
    return true;
  }
  bool is_lost() const {
    for (const Stepper& each : steppers)
      if (!each.lost.empty()) return true;
    return false;
  }
  std::uint64_t grants() const {
    std::uint64_t sum = 0;
    for (const Stepper& each : steppers) sum += each.grants;
    return sum;
  }
  Transport& transport;
  FederateLinks links;
  std::deque<Stepper> steppers;
  std::deque<FederateLink> ends;
};

/// `turn` carries what there is to carry, once.
template <class Turn>
void measure_steps(benchmark::State& state, Crowd& crowd, Turn turn) {
  while (!crowd.is_ready() && !crowd.is_lost()) crowd.send(), turn();
  std::uint64_t steps = 0;
  for (auto _ : state) {
    for (Stepper& each : crowd.steppers) each.ask();
    crowd.send();
    for (++steps; !crowd.have_all(steps);) {
      turn();
      if (crowd.is_lost()) return state.SkipWithError("a federate was lost");
    }
  }
  state.counters["steps_per_s"] =
      benchmark::Counter(static_cast<double>(steps), benchmark::Counter::kIsRate);
  state.counters["grants_arrived"] = static_cast<double>(crowd.grants());
}

/// The RTI in one thread and all federates in another, over the two ends of `Carriers`, whose polls
/// wait for at most `longest_wait`; with zero, both spin.
template <class Carriers>
void time_advance_over(benchmark::State& state, Carriers& carriers,
                       std::chrono::nanoseconds longest_wait) {
  const int count = static_cast<int>(state.range(0));
  ensure_file_limit(static_cast<std::size_t>(2 * count) + 64);
  std::atomic<bool> is_over{false}, is_listening{false};
  std::thread rti([&] {
    FederationExecution execution(empty_model(), {});
    FederationHost host(execution);
    carriers.listen();
    host.add(carriers.server_end());
    is_listening = true;
    while (!is_over) {
      host.poll(longest_wait);
      host.flush();
    }
  });
  while (!is_listening) std::this_thread::yield();
  {
    Transport& transport = carriers.federates_end();
    Crowd crowd(transport, count, [&] { return carriers.connect(); });
    measure_steps(state, crowd, [&] { transport.poll(longest_wait, crowd.links); });
  }
  is_over = true;
  rti.join();
}

/// A TCP connection for each federate.
struct Sockets {
  explicit Sockets(std::chrono::nanoseconds spin = {})
      : server(TcpSettings{.spin = spin}), federates(TcpSettings{.spin = spin}) {}
  void listen() { port = server.listen("127.0.0.1", 0); }
  Transport& server_end() { return server; }
  Transport& federates_end() { return federates; }
  ConnectionId connect() { return federates.connect("127.0.0.1", port); }
  TcpTransport server, federates;
  std::uint16_t port = 0;
};

/// One TCP connection for all of them.
struct Bundled {
  explicit Bundled(std::chrono::nanoseconds spin = {}) : sockets(spin) {}
  void listen() { sockets.listen(); }
  Transport& server_end() { return server; }
  Transport& federates_end() { return federates; }
  ConnectionId connect() {
    if (!trunk) trunk = sockets.connect();
    return federates.connect(*trunk);
  }
  Sockets sockets;
  BundledTransport server{sockets.server}, federates{sockets.federates};
  std::optional<ConnectionId> trunk;
};

/// Rings in shared memory, a pair for each federate.
struct Rings {
  explicit Rings(std::chrono::nanoseconds spin)
      : server(SharedMemorySettings{.spin = spin}), federates(SharedMemorySettings{.spin = spin}) {}
  void listen() { server.listen(name); }
  Transport& server_end() { return server; }
  Transport& federates_end() { return federates; }
  ConnectionId connect() { return federates.connect(name); }
  std::string name = "rink-bench-" + std::to_string(getpid());
  SharedMemoryTransport server, federates;
};

constexpr std::chrono::nanoseconds blocking = 10ms, spinning = 0ms;
constexpr std::chrono::nanoseconds spin_first = 50us;  ///< and then block

template <class Carriers>
void advance(benchmark::State& state, std::chrono::nanoseconds longest_wait,
             std::chrono::nanoseconds spin) {
  Carriers carriers{spin};
  time_advance_over(state, carriers, longest_wait);
}

/// The same without sockets: one thread, bytes handed over in memory.
void time_advance_in_process(benchmark::State& state) {
  FederationExecution execution(empty_model(), {});
  FederationHost host(execution);
  InProcessNetwork network;
  InProcessEndpoint near(network), own(network);
  near.listen("rti");
  host.add(near);
  Crowd crowd(own, static_cast<int>(state.range(0)), [&] { return own.connect("rti"); });
  measure_steps(state, crowd, [&] {
    own.poll(0ms, crowd.links);
    crowd.send();
    host.poll(0ms);
    host.flush();
    own.poll(0ms, crowd.links);
  });
}

void register_rows(const char* name,
                   void (*run)(benchmark::State&, std::chrono::nanoseconds,
                               std::chrono::nanoseconds),
                   std::chrono::nanoseconds longest_wait, std::chrono::nanoseconds spin) {
  benchmark::RegisterBenchmark(name, run, longest_wait, spin)
      ->ArgName("federates")
      ->Arg(2)
      ->Arg(8)
      ->Arg(64)
      ->UseRealTime()
      ->MinTime(0.5);
}

const bool are_registered = [] {
  register_rows("rti/time_advance", advance<Sockets>, blocking, {});
  register_rows("rti/time_advance_spinning", advance<Sockets>, spinning, {});
  register_rows("rti/time_advance_spin_first", advance<Sockets>, blocking, spin_first);
  register_rows("rti/time_advance_bundled", advance<Bundled>, blocking, {});
  register_rows("rti/time_advance_bundled_spinning", advance<Bundled>, spinning, {});
  register_rows("rti/time_advance_bundled_spin_first", advance<Bundled>, blocking, spin_first);
  register_rows("rti/time_advance_shared_memory", advance<Rings>, blocking, spin_first);
  return true;
}();

BENCHMARK(time_advance_in_process)
    ->Name("rti/time_advance_in_process")
    ->ArgName("federates")
    ->Arg(2)
    ->Arg(8)
    ->Arg(64)
    ->Arg(1000)
    ->UseRealTime()
    ->MinTime(0.5);

}  // namespace
}  // namespace rink::bench::time_bench
