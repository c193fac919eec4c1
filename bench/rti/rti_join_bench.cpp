// Joins of many federates, and what each costs the server in memory while it is idle; their own
// ends live in processes of their own, so that nothing of theirs is counted.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <deque>
#include <string>
#include <vector>

#include "bench/clock.h"
#include "bench/rti/entity_federation.h"
#include "rti/transport/socket_transport.h"

namespace rink::bench::rti_join_bench {
namespace {

using namespace rink::rti;
using namespace std::chrono_literals;

double seconds() { return seconds_of(CLOCK_MONOTONIC); }

/// Memory of this process that is not in files or shared [bytes].
double own_bytes() {
  long pages = 0, resident = 0, shared = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr || std::fscanf(file, "%ld %ld %ld", &pages, &resident, &shared) != 3)
    resident = shared = 0;
  if (file != nullptr) std::fclose(file);
  return static_cast<double>(resident - shared) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// `count` federates from number `first` on, that join, subscribe and do no more.
[[noreturn]] void be_idle(const std::string& kind, std::uint16_t port, int first, int count) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  ensure_file_limit(static_cast<std::size_t>(2 * count) + 64);
  SocketTransport transport(kind);
  FederateLinks links;
  std::deque<CountingFederate> federates;
  std::deque<FederateLink> ends;
  for (int i = 0; i < count; ++i) {
    CountingFederate& federate = federates.emplace_back(best_effort_entities());
    links.add(ends.emplace_back(federate.ambassador, transport.get(),
                                transport.connect("127.0.0.1", port)));
    federate.ambassador.join("rink", "client " + std::to_string(first + i), "client");
    federate.subscribe(best_effort_entities());
    if (i % 256 == 255) transport.get().poll(0ms, links), links.flush(seconds());
  }
  for (;;) {
    links.flush(seconds());
    transport.get().poll(20ms, links);
  }
}

void join(benchmark::State& state, const char* kind) {
  constexpr int per_process = 5000;
  const int count = static_cast<int>(state.range(0));
  double before = 0.0, after = 0.0;
  for (auto _ : state) {
    try {
      ensure_file_limit(static_cast<std::size_t>(count) + 128);
    } catch (const TransportError& error) {
      return state.SkipWithError(error.what());
    }
    FederationExecution execution(best_effort_entities(), {});
    FederationHost host(execution);
    SocketTransport transport(kind);
    host.add(transport.get());
    const std::uint16_t port = transport.listen("127.0.0.1", 0);
    execution.advance_clock(seconds());  // silence counts from now on
    malloc_trim(0);  // what an earlier run left would serve this one for nothing
    before = own_bytes();
    std::vector<pid_t> children;
    for (int first = 0; first < count; first += per_process) {
      const pid_t child = fork();
      if (child == 0) be_idle(kind, port, first, std::min(per_process, count - first));
      children.push_back(child);
    }
    const auto round = [&] {
      host.poll(1ms);
      host.advance_clock(seconds());
      host.match();
      host.flush();
    };
    const double give_up_s = seconds() + 120.0;
    while (execution.federate_count() < static_cast<std::size_t>(count) && seconds() < give_up_s)
      round();
    state.PauseTiming();
    for (const double until_s = seconds() + 3.0; seconds() < until_s;)
      round();  // ways open, buffers come to rest
    after = own_bytes();
    if (execution.federate_count() < static_cast<std::size_t>(count))
      state.SkipWithError("not all joined");
    for (const pid_t child : children) kill(child, SIGKILL), waitpid(child, nullptr, 0);
    state.ResumeTiming();
  }
  state.counters["bytes_per_client"] = (after - before) / count;
}

void once_for_crowds(benchmark::internal::Benchmark* timed) {
  timed->ArgName("federates")
      ->Arg(1000)
      ->Arg(10'000)
      ->UseRealTime()
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(join, tcp, "tcp")->Name("rti/join")->Apply(once_for_crowds);
BENCHMARK_CAPTURE(join, udp, "udp")->Name("rti/join_udp")->Apply(once_for_crowds);

}  // namespace
}  // namespace rink::bench::rti_join_bench
