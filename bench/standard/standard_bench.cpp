// The standard's C++ API beside Rink's own: the same work at one RTI over TCP, by turns.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "bench/clock.h"
#include "bench/standard/meeting.h"
#include "bench/standard/own_work.h"
#include "bench/standard/standard_work.h"
#include "rti/federation_directory.h"
#include "rti/standard/handles.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::bench::standard_bench {
namespace {

using namespace rink_driver;

/// Hosts executions of the driver's model on a thread of its own.
class Rti {
 public:
  Rti() : fom_(rti::Fom::load(model_file())), host_(directory_) {
    directory_.offer(fom_);
    port_ = tcp_.listen("127.0.0.1", 0);
    host_.add(tcp_);
    host_.advance_clock(wall_seconds());
    thread_ = std::thread([this] { serve(); });
  }
  ~Rti() {
    is_over_ = true;
    thread_.join();
  }
  Rti(const Rti&) = delete;
  Rti& operator=(const Rti&) = delete;
  OwnPlace own() const { return {fom_, port_}; }
  StandardPlace standard() const {
    StandardPlace place;
    place.settings = L"127.0.0.1:" + std::to_wstring(port_);
    const std::string file = model_file();
    place.model.assign(file.begin(), file.end());
    return place;
  }

 private:
  static std::string model_file() { return RINK_DRIVER_MODEL; }
  void serve() {
    while (!is_over_) {
      host_.poll(std::chrono::milliseconds(1));
      host_.advance_clock(wall_seconds());
      host_.match();
      host_.flush();
    }
  }

  rti::Fom fom_;
  rti::FederationDirectory directory_;
  rti::TcpTransport tcp_;
  rti::FederationHost host_;
  unsigned short port_ = 0;
  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

/// The least of a few measurements, by turns, of both; the time is that of the standard's API.
template <class Own, class Standard>
void compare(benchmark::State& state, const Own& own, const Standard& standard) {
  constexpr int turns = 3;
  const Rti rti;
  double own_s = 1e9, standard_s = 1e9, own_cpu_s = 1e9, standard_cpu_s = 1e9;
  for (auto _ : state) {
    for (int turn = 0; turn < turns; ++turn) {
      const auto note = [&](const Outcome& outcome, double& seconds, double& processor) {
        const auto count = static_cast<double>(outcome.count);
        if (!outcome.fault.empty() || outcome.count == 0)
          return state.SkipWithError(("not all came as it was sent: " + outcome.fault).c_str());
        seconds = std::min(seconds, outcome.seconds / count);
        processor = std::min(processor, outcome.processor_seconds / count);
      };
      note(own(rti.own()), own_s, own_cpu_s);
      note(standard(rti.standard()), standard_s, standard_cpu_s);
    }
    state.SetIterationTime(standard_s);
  }
  state.counters["own_us"] = 1e6 * own_s;
  state.counters["api_us"] = 1e6 * standard_s;
  state.counters["ratio"] = standard_s / own_s;
  state.counters["own_cpu_us"] = 1e6 * own_cpu_s;
  state.counters["api_cpu_us"] = 1e6 * standard_cpu_s;
}

void updates(benchmark::State& state) {
  const int subscribers = static_cast<int>(state.range(0));
  const std::uint64_t rounds = 4000 / static_cast<std::uint64_t>(subscribers);
  compare(
      state, [&](const OwnPlace& place) { return own_updates(place, subscribers, rounds); },
      [&](const StandardPlace& place) { return standard_updates(place, subscribers, rounds); });
}

void round_trips(benchmark::State& state) {
  compare(
      state, [](const OwnPlace& place) { return own_round_trips(place, 2000); },
      [](const StandardPlace& place) { return standard_round_trips(place, 2000); });
}

void advances(benchmark::State& state) {
  const int federates = static_cast<int>(state.range(0));
  compare(
      state, [&](const OwnPlace& place) { return own_advances(place, federates, 500); },
      [&](const StandardPlace& place) { return standard_advances(place, federates, 500); });
}

void joins(benchmark::State& state) {
  compare(
      state, [](const OwnPlace& place) { return own_joins(place, 100); },
      [](const StandardPlace& place) { return standard_joins(place, 100); });
}

void late_joiners(benchmark::State& state) {
  compare(
      state, [](const OwnPlace& place) { return own_late_joiners(place, 40); },
      [](const StandardPlace& place) { return standard_late_joiners(place, 40); });
}

/// What a federate of the standard's API does for an update without any RTI: the owner makes a map
/// of one value, and whoever receives it reads another.
void values_alone(benchmark::State& state) {
  const rti1516e::AttributeHandle attribute = standard::to_standard(rti::AttributeHandle{1});
  const State content = State::of(1, 2);
  const double begin = seconds_of();
  for (auto _ : state) {
    for (int end = 0; end < 2; ++end) {
      rti1516e::AttributeHandleValueMap values;
      values[attribute] = rti1516e::VariableLengthData(&content, sizeof content);
      State read;
      if (!State::read(values[attribute].data(), values[attribute].size(), read))
        return state.SkipWithError("another value");
      benchmark::DoNotOptimize(read);
    }
  }
  state.counters["api_cpu_us"] =
      1e6 * (seconds_of() - begin) / static_cast<double>(state.iterations());
}

void once(benchmark::internal::Benchmark* timed) {
  timed->UseManualTime()->Iterations(1)->Unit(benchmark::kMicrosecond);
}

BENCHMARK(updates)->Name("standard/updates")->ArgName("subscribers")->Arg(1)->Arg(8)->Apply(once);
BENCHMARK(values_alone)->Name("standard/values_alone");
BENCHMARK(round_trips)->Name("standard/round_trip")->Apply(once);
BENCHMARK(advances)->Name("standard/advance")->ArgName("federates")->Arg(8)->Apply(once);
BENCHMARK(joins)->Name("standard/join")->Apply(once);
BENCHMARK(late_joiners)->Name("standard/late_joiner")->Apply(once);

}  // namespace
}  // namespace rink::bench::standard_bench
