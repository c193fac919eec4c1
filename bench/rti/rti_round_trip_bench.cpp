// One interaction there and back: the RTI over TCP and shared memory, beside raw Asio.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <asio.hpp>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "rti/ambassador.h"
#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"
#include "rti/transport/shared_memory/shared_memory.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::bench::rti_round_trip_bench {
namespace {

using namespace rink::rti;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr const char* model_xml =
    R"(<objectModel><objects><objectClass><name>Root</name></objectClass></objects>
<interactions><interactionClass><name>Ping</name></interactionClass><interactionClass><name>Pong</name></interactionClass></interactions></objectModel>)";

const Fom& model() {
  static const Fom fom = Fom::parse(model_xml, "bench");
  return fom;
}

/// Percentile of samples, which are reordered.
double percentile(std::vector<double>& samples, double fraction) {
  const auto at = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(samples.size() - 1));
  std::nth_element(samples.begin(), samples.begin() + at, samples.end());
  return samples[static_cast<std::size_t>(at)];
}

/// Times single round trips as `round` makes them; the median is the figure.
template <class Round>
void measure_rounds(benchmark::State& state, Round round) {
  std::vector<double> microseconds;
  for (auto _ : state) {
    const auto start = Clock::now();
    if (!round()) return state.SkipWithError("the other end is gone");
    microseconds.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
  }
  state.counters["p50_us"] = percentile(microseconds, 0.5);
  state.counters["p99_us"] = percentile(microseconds, 0.99);
}

/// 24 bytes there and back by blocking Asio sockets.
void raw_round_trip(benchmark::State& state) {
  asio::io_context context;
  asio::ip::tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
  std::thread echo([&] {
    asio::io_context own;
    asio::ip::tcp::socket socket(own);
    asio::error_code error;
    socket.connect(acceptor.local_endpoint(), error);
    socket.set_option(asio::ip::tcp::no_delay(true));
    std::array<std::byte, 24> buffer;
    while (!error) {
      asio::read(socket, asio::buffer(buffer), error);
      if (!error) asio::write(socket, asio::buffer(buffer), error);
    }
  });
  auto socket = acceptor.accept();
  socket.set_option(asio::ip::tcp::no_delay(true));
  std::array<std::byte, 24> buffer{};
  measure_rounds(state, [&] {
    asio::error_code error;
    asio::write(socket, asio::buffer(buffer), error);
    asio::read(socket, asio::buffer(buffer), error);
    return !error;
  });
  socket.close();
  echo.join();
}

struct Federate : FederateAmbassador {
  Ambassador ambassador{model(), *this};
  std::uint64_t interactions = 0;
  void receive_interaction(InteractionClassHandle, Bytes, FederateHandle, const Stamp&) override {
    ++interactions;
  }
};

/// 24 bytes by interaction from a client to the federate beside the RTI, and back: two passes
/// through the RTI. `server_end` and `client_end` are the two ends of a transport;
/// `listen(server_end)` makes the first known, and `connect(client_end)` gives the second its
/// connection.
template <class Carrier, class Listen, class Connect>
void round_trip_over(benchmark::State& state, Carrier& server_end, Carrier& client_end,
                     Listen listen, Connect connect) {
  const InteractionClassHandle ping = *model().interaction_class("Ping"),
                               pong = *model().interaction_class("Pong");
  std::atomic<bool> is_over{false};
  std::atomic<bool> is_listening{false};
  std::thread server([&] {
    FederationExecution execution(model(), {});
    FederationHost host(execution);
    InProcessNetwork network;
    InProcessEndpoint near(network), own(network);
    near.listen("rti");
    listen(server_end);
    host.add(near);
    host.add(server_end);
    Federate federate;
    FederateLink link(federate.ambassador, own, own.connect("rti"));
    FederateLinks links;
    links.add(link);
    federate.ambassador.join("rink", "server", "server");
    federate.ambassador.publish_interaction_class(pong);
    federate.ambassador.subscribe_interaction_class(ping);
    const std::array<std::byte, 24> answer{};
    for (std::uint64_t answered = 0; !is_over;) {
      is_listening = federate.ambassador.is_joined();
      links.flush(0.0);
      host.poll(is_listening ? 100ms : 0ms);  // a timer of a millisecond costs a virtual machine
                                              // some microseconds each time
      host.flush();
      own.poll(0ms, links);
      for (; answered < federate.interactions; ++answered)
        federate.ambassador.send_interaction(pong, answer, {});
      if (federate.ambassador.outgoing().empty()) continue;
      links.flush(0.0);
      host.poll(near);
      host.flush();
    }
  });
  while (!is_listening) std::this_thread::yield();
  Federate client;
  FederateLink link(client.ambassador, client_end, connect(client_end));
  FederateLinks links;
  links.add(link);
  client.ambassador.join("rink", "client", "client");
  client.ambassador.publish_interaction_class(ping);
  client.ambassador.subscribe_interaction_class(pong);
  while (!client.ambassador.is_joined() && !link.is_finished()) {
    links.flush(0.0);
    client_end.poll(1ms, links);
  }
  const std::array<std::byte, 24> question{};
  measure_rounds(state, [&] {
    const std::uint64_t before = client.interactions;
    client.ambassador.send_interaction(ping, question, {});
    links.flush(0.0);
    while (client.interactions == before && !link.is_finished()) client_end.poll(100ms, links);
    return !link.is_finished();
  });
  is_over = true;
  server.join();
}

/// `spin`: of both ends' polls.
void tcp_round_trip(benchmark::State& state, std::chrono::nanoseconds spin) {
  TcpTransport server(TcpSettings{.spin = spin}), client(TcpSettings{.spin = spin});
  std::uint16_t port = 0;
  round_trip_over(
      state, server, client, [&](TcpTransport& end) { port = end.listen("127.0.0.1", 0); },
      [&](TcpTransport& end) { return end.connect("127.0.0.1", port); });
}

void shared_memory_round_trip(benchmark::State& state) {
  SharedMemoryTransport server, client;
  round_trip_over(
      state, server, client, [](SharedMemoryTransport& end) { end.listen("bench"); },
      [](SharedMemoryTransport& end) { return end.connect("bench"); });
}

BENCHMARK(raw_round_trip)->Name("rti/round_trip/raw_asio")->UseRealTime()->MinTime(0.5);
BENCHMARK_CAPTURE(tcp_round_trip, blocking, 0us)
    ->Name("rti/round_trip/rink")
    ->UseRealTime()
    ->MinTime(0.5);
BENCHMARK_CAPTURE(tcp_round_trip, spinning, 50us)
    ->Name("rti/round_trip/rink_spinning")
    ->UseRealTime()
    ->MinTime(0.5);
BENCHMARK(shared_memory_round_trip)->Name("rti/round_trip/rink_shm")->UseRealTime()->MinTime(0.5);

}  // namespace
}  // namespace rink::bench::rti_round_trip_bench
