// The same game over real sockets as in process: server and clients in threads of their own, on
// loopback.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "game/replication/trajectory_codec.h"
#include "loadgen/run/bots/bot_crowd.h"
#include "rti/transport/tcp/tcp.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"
#include "tests/net/wall_clock.h"
#include "tests/places.h"

namespace rink::game {
namespace {

using namespace std::chrono_literals;

constexpr double rate_hz = 50.0, duration_s = 0.6;

/// The server's thread: waits for two players, then ticks in real time until the duration is over.
/// Returns the final state's hash.
std::uint64_t serve(const Scene& scene, const std::vector<InputEvent>& log,
                    const std::string& scheme, std::atomic<std::uint16_t>& port) {
  const rti::Fom fom = load_rink_fom(test::source_folder() + "/game/net/rink.fom.xml");
  rti::InProcessNetwork network;
  rti::InProcessEndpoint hub(network), endpoint(network);
  rti::TcpTransport tcp;
  rti::FederationSettings settings;
  settings.filter = scheme;
  rti::FederationExecution execution(fom, settings);
  rti::FederationHost host(execution);
  hub.listen("rti");
  host.add(hub);
  host.add(tcp);
  Server server(fom, scene, {.replay = log}, [] { return 0.0; });
  rti::FederateLink link(server.ambassador(), endpoint, endpoint.connect("rti"));
  rti::FederateLinks links;
  links.add(link);
  port = tcp.listen("127.0.0.1", 0);

  const auto exchange = [&](std::chrono::nanoseconds wait) {
    host.poll(wait);
    host.flush();
    endpoint.poll({}, links);
    link.flush(0.0);
  };
  const auto send_tick = [&](double time, double due_s) {
    server.publish({.time = time, .tag = static_cast<std::uint64_t>(due_s * 1e9)});
    link.flush(0.0);
    host.poll({});
    host.match();
    host.flush();
  };
  const double give_up_s = now_s() + 20.0;
  bool is_called = false;
  while (!server.is_started() && now_s() < give_up_s) {
    exchange(5ms);
    if (server.is_joined()) send_tick(0.0, 0.0);
    if (server.seats().player_count() == 2 && !is_called) {
      server.call_to_start();
      is_called = true;
    }
  }
  const double start_s = now_s();
  for (int tick = 1; tick <= static_cast<int>(duration_s * rate_hz + 0.5); ++tick) {
    const double time = tick / rate_hz;
    while (now_s() < start_s + time) exchange(1ms);
    server.simulate(time);
    send_tick(time, start_s + time);
  }
  const std::uint64_t hash = server.game().hash();
  while (server.seats().player_count() > 0 && now_s() < give_up_s) exchange(5ms);
  return hash;
}

class ThreadedSockets : public testing::TestWithParam<const char*> {};

TEST_P(ThreadedSockets, CarryTheVeryGameThatIsPlayedAlone) {
  const Scene scene = small_crowd();
  const std::vector<InputEvent> log = keys_for(scene, 21, duration_s);
  Game alone(scene);
  for (const InputEvent& event : log) alone.submit(event);
  alone.advance(duration_s);

  std::atomic<std::uint16_t> port = 0;
  std::uint64_t hash = 0;
  std::thread server([&] { hash = serve(scene, log, GetParam(), port); });
  while (port == 0) std::this_thread::sleep_for(1ms);

  const rti::Fom fom = load_rink_fom(test::source_folder() + "/game/net/rink.fom.xml");
  rti::TcpTransport transport;
  loadgen::BotCrowd crowd(fom, transport, {.count = 2, .duration_s = duration_s - 0.1}, log, now_s);
  crowd.connect([&](std::uint32_t) { return transport.connect("127.0.0.1", port); });
  const double give_up_s = now_s() + 20.0;
  while (!crowd.is_over() && now_s() < give_up_s) crowd.run_once();
  const loadgen::CrowdTraffic total = crowd.bots().traffic();
  const std::string error = crowd.bots().first_error();
  crowd.resign();
  for (const double until_s = now_s() + 0.2; now_s() < until_s;) crowd.run_once();
  server.join();

  EXPECT_EQ(hash, alone.hash());
  EXPECT_EQ(error, "");
  EXPECT_GT(total.updates_received, 0u);
  EXPECT_LE(total.bytes_received,
            total.kernel_bytes_received);  // the rest lay in the sockets' buffers
}

INSTANTIATE_TEST_SUITE_P(Schemes, ThreadedSockets, testing::Values("none", "grid", "region"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace rink::game
