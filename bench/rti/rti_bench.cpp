// The RTI beside raw Asio: one tick sent to many clients; every figure counts what arrived.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <asio.hpp>
#include <atomic>
#include <chrono>
#include <deque>
#include <string>
#include <thread>
#include <vector>

#include "rti/ambassador.h"
#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::bench::rti_bench {
namespace {

using namespace rink::rti;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr const char* model_xml =
    R"(<objectModel><objects><objectClass><name>Root</name><objectClass><name>Entity</name>
<attribute><name>position</name><dataType>HLAfloat64LE</dataType></attribute>
</objectClass></objectClass></objects></objectModel>)";

const Fom& model() {
  static const Fom fom = Fom::parse(model_xml, "bench");
  return fom;
}

/// One federate with its own connection, or one beside others on a shared transport.
struct Federate : FederateAmbassador {
  Ambassador ambassador{model(), *this};
  std::uint64_t updates = 0;
  void reflect_attribute_values(ObjectHandle, AttributeSet, Bytes, const Stamp&) override {
    ++updates;
  }
};

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr int seen_count = 275;  ///< entities that each client sees: 5 % of 5,500

/// Reads and forgets on as many connections as asked for, in a thread of its own.
class Sinks {
 public:
  Sinks(std::uint16_t port, int count, bool are_federates) {
    thread_ = std::thread([this, port, count, are_federates] {
      TcpTransport tcp;
      FederateLinks links;
      std::deque<Federate> federates;
      std::deque<FederateLink> ends;
      for (int i = 0; i < count; ++i) {
        Federate& federate = federates.emplace_back();
        links.add(ends.emplace_back(federate.ambassador, tcp, tcp.connect("127.0.0.1", port)));
        if (!are_federates) continue;
        const ObjectClassHandle entity = *model().object_class("Entity");
        federate.ambassador.join("rink", "client " + std::to_string(i), "client");
        federate.ambassador.subscribe_object_class_attributes(entity, model().attributes(entity));
      }
      Raw raw;
      while (!is_over_) {
        if (are_federates) links.flush(0.0);
        tcp.poll(1ms, are_federates ? static_cast<TransportListener&>(links) : raw);
        std::uint64_t sum = raw.bytes;
        for (const Federate& federate : federates)
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
void rink_tick_send(benchmark::State& state) {
  const int clients = static_cast<int>(state.range(0));
  ensure_file_limit(static_cast<std::size_t>(2 * clients) + 64);
  FederationSettings settings;
  settings.patience.lost_after_s = 1e9;
  FederationExecution execution(model(), settings);
  FederationHost host(execution);
  InProcessNetwork network;
  InProcessEndpoint near(network), own(network);
  TcpTransport tcp;
  near.listen("rti");
  host.add(near);
  host.add(tcp);
  Federate federate;
  FederateLink link(federate.ambassador, own, own.connect("rti"));
  FederateLinks links;
  links.add(link);
  const ObjectClassHandle entity = *model().object_class("Entity");
  const AttributeSet position = model().attributes(entity);
  federate.ambassador.join("rink", "server", "server");
  federate.ambassador.publish_object_class_attributes(entity, position);
  const auto tick = [&] {
    links.flush(0.0);
    host.poll(0ms);
    host.match();
    host.flush();
    own.poll(0ms, links);
  };
  while (!federate.ambassador.is_joined()) tick();
  Sinks sinks(tcp.listen("127.0.0.1", 0), clients, true);
  while (execution.federate_count() < static_cast<std::size_t>(clients) + 1) tick();
  std::vector<ObjectHandle> objects;
  for (int i = 0; i < seen_count; ++i)
    objects.push_back(federate.ambassador.register_object_instance(entity));
  const std::array<std::byte, 8> value{};
  double busy_s = 0.0;
  const auto arrived = [&] {
    return sinks.received() >=
           execution.counters().bytes_sent - federate.ambassador.counters().bytes_received;
  };
  for (int i = 0; i < 10; ++i) tick();
  const std::uint64_t bytes_before = sinks.received();
  for (auto _ : state) {
    for (const ObjectHandle object : objects)
      federate.ambassador.update_attribute_values(object, position, value, {busy_s, 1});
    const double start = thread_seconds();
    tick();
    busy_s += thread_seconds() - start;
    while (!arrived()) std::this_thread::sleep_for(100us);
  }
  const double ticks = static_cast<double>(state.iterations());
  state.counters["cpu_us_per_client"] = 1e6 * busy_s / ticks / clients;
  state.counters["bytes_per_client"] =
      static_cast<double>(sinks.received() - bytes_before) / ticks / clients;
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
      seen_count *
          9);  // as long as Rink's: frame, stamp and block, then a step and 8 bytes for each
  double busy_s = 0.0;
  std::uint64_t sent = 0;
  for (auto _ : state) {
    const double start = thread_seconds();
    for (asio::ip::tcp::socket& socket : sockets)
      sent += asio::write(socket, asio::buffer(message));
    busy_s += thread_seconds() - start;
    while (sinks.received() < sent) std::this_thread::sleep_for(100us);
  }
  const double ticks = static_cast<double>(state.iterations());
  state.counters["cpu_us_per_client"] = 1e6 * busy_s / ticks / clients;
  state.counters["bytes_per_client"] = static_cast<double>(sinks.received()) / ticks / clients;
}

BENCHMARK(raw_tick_send)
    ->Name("rti/tick_send/raw_tcp")
    ->ArgName("clients")
    ->Arg(100)
    ->Arg(1000)
    ->UseRealTime()
    ->Iterations(60)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(rink_tick_send)
    ->Name("rti/tick_send/rink")
    ->ArgName("clients")
    ->Arg(100)
    ->Arg(1000)
    ->UseRealTime()
    ->Iterations(60)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rink::bench::rti_bench
