// Federations over modelled networks: a perfect one is as good as none, a bad one changes when
// things are heard and never what, and the same seed gives the same bytes.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>

#include "tests/rti/rig.h"
#include "tests/rti/transport/instants.h"

namespace rink::rti::testing {
namespace {

/// Everything that `station` was told, in words.
std::string story_of(const Station& station) {
  std::string story;
  for (const std::string& line : station.heard.log) story += line + "\n";
  for (const auto& [handle, known] : station.heard.objects) {
    story += std::to_string(handle) + " " + known.name +
             (known.is_in_scope ? " in scope " : " out of scope ") + std::to_string(known.updates);
    for (const auto& [attribute, value] : known.values)
      story += " " + std::to_string(attribute) + "=" + text_of(value);
    story += "\n";
  }
  for (const auto& [interaction, words] : station.heard.interactions)
    story += std::to_string(interaction) + " " + words + "\n";
  return story;
}

/// A harbour in which `count` pilots move vessels and hail each other at random, over `carrier`;
/// the stories of all.
std::string harbour_day(Carrier carrier, std::uint64_t seed, int count) {
  const AttributeSet all{position, speed};
  Rig rig(carrier);
  std::vector<Station*> pilots;
  std::vector<ObjectHandle> vessels;
  for (int i = 0; i < count; ++i) {
    Ambassador& pilot = (pilots.emplace_back(&rig.join("pilot " + std::to_string(i))))->ambassador;
    pilot.publish_object_class_attributes(vessel, all);
    pilot.subscribe_object_class_attributes(vessel, all);
    pilot.publish_interaction_class(hail);
    pilot.subscribe_interaction_class(hail);
  }
  rig.settle();
  for (std::size_t i = 0; i < pilots.size(); ++i)
    vessels.push_back(
        pilots[i]->ambassador.register_object_instance(vessel, "vessel " + std::to_string(i)));
  std::mt19937_64 random(seed);
  for (int step = 0; step < 200; ++step) {
    const std::size_t who = random() % pilots.size();
    const auto x = static_cast<float>(random() % 100), y = static_cast<float>(random() % 100);
    pilots[who]->ambassador.update_attribute_values(vessels[who], all, values_of(x, y, x + y),
                                                    {0.25 * step, 0});
    if (random() % 4 == 0)
      pilots[who]->ambassador.send_interaction(hail, bytes_of("hail " + std::to_string(step)),
                                               {0.25 * step, 0});
    rig.now += 0.01;
    rig.round();
  }
  rig.settle();
  std::string stories;
  for (const Station* pilot : pilots)
    stories += story_of(*pilot) + "bytes " +
               std::to_string(pilot->ambassador.counters().bytes_received) + "\n";
  return stories;
}

TEST(ModelledFederation, OverAPerfectNetworkItIsTheOneInProcess) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const std::string there = harbour_day(Carrier::virtual_network, seed, 5);
    EXPECT_EQ(there, harbour_day(Carrier::in_process, seed, 5)) << "seed " << seed;
    EXPECT_GT(there.size(), 1000u);
  }
}

const PacketLoss loss = PacketLoss::in_bursts(0.02, 2.0);

NetworkConditions bad_network(std::uint64_t seed) {
  const LinkConditions link{.latency_ns = 20 * ms,
                            .jitter_ns = 5 * ms,
                            .loss = loss,
                            .reorder = 0.05,
                            .held_ns = 10 * ms,
                            .duplicate = 0.05,
                            .rate_bits_per_s = 2'000'000,
                            .queue_bytes = 20'000};
  return {
      .seed = seed, .to_listener = link, .from_listener = link, .exceptions = {}, .partitions = {}};
}

/// A server and `count` clients that answer each other by both channels 20 times a second over a
/// bad network.
class Crowd : public TransportListener {
 public:
  Crowd(std::uint32_t count, std::uint64_t seed) : model_(bad_network(seed)), network_(model_) {
    network_.carry_datagrams();
    server_.listen("server");
    for (std::uint32_t i = 0; i < count; ++i) clients_.connect("server");
  }
  void play(double seconds) {
    run_to(100 * second);  // all have heard that they are connected
    const std::int64_t until_ns = network_.now_ns() + static_cast<std::int64_t>(seconds * 1e9);
    for (std::int64_t tick_ns = network_.now_ns(); tick_ns <= until_ns; tick_ns += 50 * ms) {
      run_to(tick_ns);
      for (const ConnectionId line : open_) say(server_, line, 300);
    }
    run_to(until_ns + 2000 * second);  // whatever is still to be sent again
  }
  void on_open(ConnectionId connection) override {
    if (is_server_) open_.push_back(connection);
    note(connection, 1);
  }
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    note(connection, bytes.size());
    if (!is_server_) answer(connection);
  }
  void on_datagram(ConnectionId connection, Bytes bytes) override {
    ++datagrams_;
    note(connection, 100'000 + bytes.size());
  }
  void on_close(ConnectionId, CloseReason, const std::string&) override { ++closed_; }

  std::uint64_t hash() const { return hash_; }
  std::uint64_t datagrams() const { return datagrams_; }
  std::uint64_t closed() const { return closed_; }
  std::size_t opened() const { return open_.size(); }
  std::uint64_t arrivals() const { return network_.arrival_count(); }
  const NetworkCounters& counters() const { return model_.counters(); }
  bool has_heard_all_that_was_said() const {
    return server_.totals().bytes_received == clients_.totals().bytes_sent &&
           clients_.totals().bytes_received == server_.totals().bytes_sent;
  }

 private:
  void run_to(std::int64_t until_ns) {
    for (auto next_ns = network_.next_arrival_ns(); next_ns && *next_ns <= until_ns;
         next_ns = network_.next_arrival_ns()) {
      network_.advance_to(*next_ns);
      is_server_ = true;
      server_.poll(std::chrono::nanoseconds(0), *this);
      is_server_ = false;
      clients_.poll(std::chrono::nanoseconds(0), *this);
    }
    network_.advance_to(until_ns);
  }
  void say(VirtualEndpoint& from, ConnectionId line, std::size_t size) {
    static const std::vector<std::byte> words(2000, std::byte{7});
    from.send(line, std::array{Bytes(words).first(size)});
    from.send_datagrams(line,
                        std::array{Datagram{Bytes(words).first(8), Bytes(words).first(size / 2)}});
  }
  void answer(ConnectionId line) { say(clients_, line, 40); }
  void note(ConnectionId connection, std::size_t what) {
    for (const std::uint64_t part : {static_cast<std::uint64_t>(network_.now_ns()),
                                     std::uint64_t{connection}, std::uint64_t{what}})
      hash_ = (hash_ ^ part) * 0x100000001b3u;
  }

  NetworkModel model_;
  VirtualNetwork network_;
  VirtualEndpoint server_{network_}, clients_{network_};
  std::vector<ConnectionId> open_;  ///< at the server
  bool is_server_ = false;
  std::uint64_t hash_ = 0xcbf29ce484222325u, datagrams_ = 0, closed_ = 0;
};

void expect_sound(const Crowd& crowd, std::uint32_t count) {
  EXPECT_EQ(crowd.opened(), count);
  EXPECT_EQ(crowd.closed(), 0u);
  EXPECT_TRUE(crowd.has_heard_all_that_was_said());
  const NetworkCounters& counted = crowd.counters();
  const double sent = static_cast<double>(counted.datagrams),
               lost = static_cast<double>(counted.datagrams + counted.duplicated - counted.dropped -
                                          crowd.datagrams());
  const double memory = 1.0 - loss.to_bad - loss.to_good,
               deviation = std::sqrt(0.02 * 0.98 / sent * (1.0 + memory) / (1.0 - memory));
  EXPECT_NEAR(lost / sent, 0.02, 5.0 * deviation) << "and nothing else became of datagrams";
}

/// Resident memory of this process [bytes].
double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  statm >> all >> resident;
  return 4096.0 * resident;
}

void play_and_tell(std::uint32_t count, double seconds) {
  const double before = resident_bytes();
  const auto began = std::chrono::steady_clock::now();
  Crowd crowd(count, 1);
  crowd.play(seconds);
  const double elapsed_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  expect_sound(crowd, count);
  const double memory = (resident_bytes() - before) / count;
  std::printf("%u clients: %.0f arrivals in %.2f s, %.0f bytes a client\n", count,
              static_cast<double>(crowd.arrivals()), elapsed_s, memory);
  EXPECT_LT(memory, 16'384.0);
}

TEST(ModelledFederation, ARunIsTheSameToTheByteAndAnotherSeedIsAnotherRun) {
  const auto hash = [](std::uint64_t seed) {
    Crowd crowd(50, seed);
    crowd.play(2.0);
    return crowd.hash();
  };
  EXPECT_EQ(hash(1), hash(1));
  EXPECT_NE(hash(1), hash(2));
}

TEST(ModelledFederation, AThousandClientsTalkOverABadNetwork) { play_and_tell(1000, 2.0); }

TEST(LongModelledFederation, TenThousandClientsTalkOverABadNetwork) { play_and_tell(10'000, 10.0); }

}  // namespace
}  // namespace rink::rti::testing
