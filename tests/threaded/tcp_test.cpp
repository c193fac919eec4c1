// A federation over TCP whose server and clients run in threads of their own.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using namespace std::chrono_literals;

TEST(TcpThreaded, AServerAndItsClientsTalkFromThreadsOfTheirOwn) {
  FederationExecution execution(harbour(), {});
  FederationHost host(execution);
  TcpTransport transport;
  const std::uint16_t port = transport.listen("127.0.0.1", 0);
  host.add(transport);
  std::atomic<bool> is_over{false};
  std::thread server([&] {
    while (!is_over) {
      host.poll(1ms);
      host.match();
      host.flush();
    }
  });
  constexpr int client_count = 4, update_count = 200;
  std::array<std::uint64_t, client_count> reflected{};
  std::atomic<int> ready{0}, done{0};
  std::vector<std::thread> clients;
  for (int k = 0; k < client_count; ++k)
    clients.emplace_back([&, k] {
      TcpTransport own;
      Recorder heard;
      Ambassador ambassador(harbour(), heard);
      FederateLink link(ambassador, own, own.connect("127.0.0.1", port));
      FederateLinks links;
      links.add(link);
      const auto pump = [&] {
        links.flush(0.0);
        own.poll(1ms, links);
      };
      ambassador.join("rink", "client " + std::to_string(k), "tester");
      ambassador.publish_object_class_attributes(vessel, AttributeSet{speed});
      ambassador.subscribe_object_class_attributes(vessel, AttributeSet{speed});
      while (!ambassador.is_joined() && heard.lost.empty()) pump();
      const ObjectHandle object = ambassador.register_object_instance(vessel);
      while (heard.objects.size() < client_count - 1 && heard.lost.empty()) pump();
      ++ready;
      while (ready < client_count) pump();
      for (int i = 0; i < update_count; ++i) {
        ambassador.update_attribute_values(object, AttributeSet{speed},
                                           values_of(static_cast<float>(i)), {});
        pump();
      }
      const std::uint64_t due = (client_count - 1) * update_count;
      while (ambassador.counters().updates_reflected < due && heard.lost.empty()) pump();
      reflected[static_cast<std::size_t>(k)] = ambassador.counters().updates_reflected;
      ++done;
      while (done < client_count) pump();
    });
  for (std::thread& client : clients) client.join();
  is_over = true;
  server.join();
  for (const std::uint64_t count : reflected) EXPECT_EQ(count, (client_count - 1) * update_count);
}

}  // namespace
}  // namespace rink::rti::testing
