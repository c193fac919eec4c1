// One tick of best-effort updates to many clients by UDP, beside a raw batched sender; every figure
// counts what arrived.
#include <arpa/inet.h>
#include <benchmark/benchmark.h>
#include <netinet/udp.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <deque>
#include <string>
#include <thread>
#include <vector>

#include "bench/clock.h"
#include "bench/rti/entity_federation.h"
#include "rti/transport/udp/datagram_socket.h"
#include "rti/transport/udp/udp.h"

namespace rink::bench::rti_datagram_bench {
namespace {

using namespace rink::rti;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

double wall_seconds() { return seconds_of(CLOCK_MONOTONIC); }

/// Runs `work(is_over)` in a thread of its own until the end of its scope.
class Companion {
 public:
  template <class Work>
  explicit Companion(Work work) : thread_([this, work] { work(is_over_); }) {}
  ~Companion() {
    is_over_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

void report(benchmark::State& state, double busy_s, int clients, double arrived, double sent) {
  const double ticks = static_cast<double>(state.iterations());
  state.counters["cpu_us_per_client"] = 1e6 * busy_s / ticks / clients;
  state.counters["bytes_per_client"] = arrived / ticks / clients;
  state.counters["lost"] = 1.0 - arrived / sent;
}

/// Waits until as much has arrived, but not for ever: what UDP has lost has not.
template <class Arrived>
void await(std::uint64_t wanted, Arrived arrived) {
  for (const auto start = Clock::now(); arrived() < wanted && Clock::now() - start < 200ms;)
    std::this_thread::sleep_for(100us);
}

/// The bytes of a tick in datagrams of 1,200 by sendmmsg and segmentation offload, to as many
/// sockets; nothing else.
void raw_udp_tick_send(benchmark::State& state) {
  const int clients = static_cast<int>(state.range(0));
  ensure_file_limit(static_cast<std::size_t>(2 * clients) + 64);
  std::vector<File> sinks;
  std::vector<sockaddr_in> addresses(static_cast<std::size_t>(clients));
  for (sockaddr_in& address : addresses) {
    sinks.emplace_back(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK, 0));
    address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(sinks.back().number(), reinterpret_cast<sockaddr*>(&address), size);
    ::getsockname(sinks.back().number(), reinterpret_cast<sockaddr*>(&address), &size);
    prepare_datagram_socket(sinks.back().number(), true);
  }
  std::atomic<std::uint64_t> received{0};
  Companion reader([&](const std::atomic<bool>& is_over) {
    Readiness readiness;
    DatagramReader datagrams;
    for (std::size_t i = 0; i < sinks.size(); ++i) readiness.watch(sinks[i].number(), i, false);
    std::uint64_t sum = 0;
    while (!is_over) {
      readiness.ask(1ms, {});
      while (const auto event = readiness.next())
        datagrams.read(sinks[event->number].number(),
                       [&](const SocketAddress&, Bytes bytes) { sum += bytes.size(); });
      received = sum;
    }
  });
  const File sender(::socket(AF_INET, SOCK_DGRAM, 0));
  prepare_datagram_socket(sender.number(), false);
  std::vector<std::byte> message(2 * 1200 +
                                 185);  // what the RTI sends, with the heads of its datagrams
  iovec vector{message.data(), message.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(std::uint16_t))> control{};
  auto* segments = reinterpret_cast<cmsghdr*>(control.data());
  segments->cmsg_level = IPPROTO_UDP;
  segments->cmsg_type = UDP_SEGMENT;
  segments->cmsg_len = CMSG_LEN(sizeof(std::uint16_t));
  const std::uint16_t segment = 1200;
  std::memcpy(CMSG_DATA(segments), &segment, sizeof segment);
  std::vector<mmsghdr> headers(addresses.size());
  for (std::size_t i = 0; i < headers.size(); ++i)
    headers[i].msg_hdr = {.msg_name = &addresses[i],
                          .msg_namelen = sizeof addresses[i],
                          .msg_iov = &vector,
                          .msg_iovlen = 1,
                          .msg_control = control.data(),
                          .msg_controllen = control.size(),
                          .msg_flags = 0};
  double busy_s = 0.0;
  std::uint64_t sent = 0;
  for (auto _ : state) {
    const double start = seconds_of();
    for (std::size_t from = 0; from < headers.size();) {
      const int count =
          ::sendmmsg(sender.number(), headers.data() + from,
                     static_cast<unsigned>(std::min<std::size_t>(64, headers.size() - from)), 0);
      if (count <= 0) return state.SkipWithError("the kernel does not cut datagrams");
      from += static_cast<std::size_t>(count);
    }
    busy_s += seconds_of() - start;
    sent += message.size() * headers.size();
    await(sent, [&] { return received.load(); });
  }
  report(state, busy_s, clients, static_cast<double>(received), static_cast<double>(sent));
}

/// The same positions through the RTI, by datagrams that are numbered, acknowledged and repaired.
void rink_udp_tick_send(benchmark::State& state) {
  const int clients = static_cast<int>(state.range(0));
  ensure_file_limit(static_cast<std::size_t>(3 * clients) + 64);
  UdpTransport udp;
  EntityFederation federation(best_effort_entities(), {}, udp);
  const FederationExecution& execution = federation.execution;
  const std::uint16_t port = udp.listen("127.0.0.1", 0);
  std::atomic<std::uint64_t> received{0}, updates{0};
  Companion sinks([&](const std::atomic<bool>& is_over) {
    UdpTransport transport;
    FederateLinks ends_of_all;
    std::deque<CountingFederate> federates;
    std::deque<FederateLink> ends;
    for (int i = 0; i < clients; ++i) {
      CountingFederate& client = federates.emplace_back(best_effort_entities());
      ends_of_all.add(
          ends.emplace_back(client.ambassador, transport, transport.connect("127.0.0.1", port)));
      client.join("client " + std::to_string(i), "client");
      client.subscribe(best_effort_entities());
    }
    const double origin = wall_seconds();
    while (!is_over) {
      ends_of_all.flush(wall_seconds() - origin);
      transport.poll(1ms, ends_of_all);
      std::uint64_t datagrams = 0, sum = 0;
      for (const CountingFederate& client : federates)
        datagrams += client.ambassador.counters().datagrams_received, sum += client.updates;
      received = datagrams;
      updates = sum;
    }
  });
  const double origin = wall_seconds();
  double now = 0.0;
  while (!federation.has(clients) ||
         udp.udp_counters().ways_opened < static_cast<std::uint64_t>(clients)) {
    now = wall_seconds() - origin;
    federation.tick(now);
    if (now > 20.0) return state.SkipWithError("not all ways opened");
  }
  federation.register_entities();
  double busy_s = 0.0;
  const FederationCounters before = execution.counters();
  const std::uint64_t datagrams_before = received, updates_before = updates;
  for (auto _ : state) {
    now = wall_seconds() - origin;
    federation.update_all({busy_s, 1});
    const double start = seconds_of();
    federation.host.advance_clock(now);
    federation.tick(now);
    busy_s += seconds_of() - start;
    await(datagrams_before + execution.counters().datagrams_sent - before.datagrams_sent,
          [&] { return received.load(); });
  }
  const double sent =
                   static_cast<double>(execution.counters().datagrams_sent - before.datagrams_sent),
               arrived = static_cast<double>(received - datagrams_before);
  const double bytes =
      static_cast<double>(execution.counters().update_bytes_sent - before.update_bytes_sent) +
      9.0 * sent;
  report(state, busy_s, clients, bytes * arrived / sent, bytes);
  state.counters["updates_per_client"] = static_cast<double>(updates - updates_before) /
                                         static_cast<double>(state.iterations()) / clients;
  state.counters["repaired"] =
      static_cast<double>(execution.counters().updates_repaired - before.updates_repaired);
}

BENCHMARK(raw_udp_tick_send)->Name("rti/tick_send/raw_udp")->Apply(send_to_crowds);
BENCHMARK(rink_udp_tick_send)->Name("rti/tick_send/rink_udp")->Apply(send_to_crowds);

}  // namespace
}  // namespace rink::bench::rti_datagram_bench
