// In a steady tick nothing is allocated: updates, interactions and regions through the RTI, in
// process and over TCP, counted by this executable's operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/rti/rig.h"

namespace {

std::atomic<std::uint64_t> allocation_count{0};

void* counted(std::size_t size) {
  ++allocation_count;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
// Also the form that buffers of std::stable_sort come from: what it gives is freed by the same
// operator delete.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return counted(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace rink::rti::testing {
namespace {

/// Hears and keeps nothing but counts.
struct Counter final : FederateAmbassador {
  std::uint64_t updates = 0, interactions = 0;
  void reflect_attribute_values(ObjectHandle, AttributeSet, Bytes, const Stamp&) override {
    ++updates;
  }
  void receive_interaction(InteractionClassHandle, Bytes, FederateHandle, const Stamp&) override {
    ++interactions;
  }
};

class Allocations : public ::testing::TestWithParam<Carrier> {};
INSTANTIATE_TEST_SUITE_P(Carriers, Allocations,
                         ::testing::Values(Carrier::in_process, Carrier::tcp),
                         [](const auto& each) { return name_of(each.param); });

TEST_P(Allocations, ASteadyTickOfUpdatesInteractionsAndRegionsAllocatesNothing) {
  const bool is_tcp = GetParam() == Carrier::tcp;
  FederationSettings settings;
  settings.filter = "region";
  settings.filter_settings.world = {0.0, 0.0, 100.0, 100.0};
  FederationExecution execution(harbour(), settings);
  FederationHost host(execution);
  InProcessNetwork network;
  InProcessEndpoint server_local(network), client_local(network);
  TcpTransport server_tcp, client_tcp;
  server_local.listen("rti");
  const std::uint16_t port = server_tcp.listen("127.0.0.1", 0);
  Transport& clients = is_tcp ? static_cast<Transport&>(client_tcp) : client_local;
  host.add(is_tcp ? static_cast<Transport&>(server_tcp) : server_local);
  constexpr int watcher_count = 8, vessel_count = 60;
  std::deque<Counter> counters(1 + watcher_count);
  std::deque<Ambassador> ambassadors;
  std::deque<FederateLink> ends;
  FederateLinks links;
  for (Counter& each : counters) {
    Ambassador& ambassador = ambassadors.emplace_back(harbour(), each);
    links.add(ends.emplace_back(
        ambassador, clients,
        is_tcp ? client_tcp.connect("127.0.0.1", port) : client_local.connect("rti")));
    ambassador.join("rink", "federate " + std::to_string(ends.size()), "tester");
    ambassador.publish_interaction_class(hail);
    ambassador.subscribe_interaction_class(hail);
  }
  const auto wait = is_tcp ? std::chrono::microseconds(200) : std::chrono::microseconds(0);
  const auto round = [&] {
    links.flush(0.0);
    host.poll(wait);
    host.match();
    host.flush();
    clients.poll(wait, links);
  };
  while (execution.federate_count() < counters.size() || !ambassadors.back().is_joined()) round();
  Ambassador& master = ambassadors.front();
  const AttributeSet all = harbour().attributes(vessel);
  master.publish_object_class_attributes(vessel, all);
  std::vector<ObjectHandle> vessels;
  std::vector<RegionBounds> places, views;
  for (int i = 0; i < vessel_count; ++i) {
    vessels.push_back(master.register_object_instance(vessel));
    places.push_back({master.create_region(), {}});
    master.associate_regions_for_updates(vessels.back(), places.back().region);
  }
  for (std::size_t i = 1; i < ambassadors.size(); ++i) {
    views.push_back({ambassadors[i].create_region(), {}});
    ambassadors[i].subscribe_object_class_attributes(vessel, all, views.back().region);
  }
  const std::vector<std::byte> values = values_of(1.0f, 2.0f, 3.0f), words = bytes_of("ahoy");
  // Everything comes round every 50 ticks, so what a warm circle needed the next ones have.
  const auto tick = [&](int number) {
    const int phase = number % 50;
    for (int i = 0; i < vessel_count; ++i) {
      const double x = (7 * i + 2 * phase) % 100, y = (13 * i) % 100;
      places[static_cast<std::size_t>(i)].bounds = {x, y, x, y};
      master.update_attribute_values(vessels[static_cast<std::size_t>(i)], all, values,
                                     {static_cast<double>(number), 1});
    }
    master.commit_region_modifications(places);
    for (std::size_t i = 0; i < views.size(); ++i) {
      const double x = static_cast<double>((11 * static_cast<int>(i) + 100 - 2 * phase) % 100);
      views[i].bounds = {x, 0.0, x + 30.0, 100.0};
      ambassadors[i + 1].commit_region_modifications(std::span(&views[i], 1));
      ambassadors[i + 1].send_interaction(hail, words, {});
    }
    round();
    round();
  };
  int number = 0;
  // The buffers of the transport wander from connection to connection, and each grows once for the
  // largest frame.
  for (; number < 1200; ++number) tick(number);
  const std::uint64_t updates = counters[1].updates, interactions = counters[1].interactions,
                      before = allocation_count;
  for (; number < 1400; ++number) tick(number);
  EXPECT_EQ(allocation_count - before, 0u);
  EXPECT_GT(counters[1].updates, updates + 200u);
  EXPECT_GT(counters[1].interactions, interactions + 1000u);
}

TEST(AllocationsOfNone, WhatNobodyHearsAllocatesNothingAndSendsNothing) {
  Rig rig(Carrier::in_process);
  Ambassador& pilot = rig.join("pilot").ambassador;
  const AttributeSet all = harbour().attributes(vessel);
  pilot.publish_object_class_attributes(vessel, all);
  pilot.publish_interaction_class(hail);
  rig.settle();
  std::vector<ObjectHandle> vessels;
  for (int i = 0; i < 100; ++i) vessels.push_back(pilot.register_object_instance(vessel));
  const std::vector<std::byte> values = values_of(1.0f, 2.0f, 3.0f), words = bytes_of("ahoy");
  const auto tick = [&](double now) {
    for (const ObjectHandle each : vessels)
      pilot.update_attribute_values(each, all, values, {now, 1});
    pilot.send_interaction(hail, words, {now, 1});
    rig.round();
  };
  for (int i = 0; i < 10; ++i) tick(i);
  const std::uint64_t bytes = pilot.counters().bytes_sent, before = allocation_count;
  for (int i = 0; i < 100; ++i) tick(10 + i);
  EXPECT_EQ(allocation_count - before, 0u);
  EXPECT_EQ(pilot.counters().bytes_sent, bytes);
  EXPECT_EQ(pilot.counters().updates_spared, 11'000u);
  EXPECT_EQ(pilot.counters().interactions_spared, 110u);
}

}  // namespace
}  // namespace rink::rti::testing
