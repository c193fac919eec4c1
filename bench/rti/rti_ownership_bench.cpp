// Bodies that change hands: what a hand-over costs in each of the ways of clause 7, with every
// notification that arrived counted.
#include <benchmark/benchmark.h>

#include <chrono>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rti/ambassador.h"
#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::bench::rti_ownership_bench {
namespace {

using namespace rink::rti;
using namespace std::chrono_literals;

constexpr const char* model_xml =
    R"(<objectModel><objects><objectClass><name>Root</name><objectClass><name>Body</name>
<attribute><name>place</name><dataType>HLAfloat64LE</dataType></attribute><attribute><name>pace</name><dataType>HLAfloat64LE</dataType></attribute>
</objectClass></objectClass></objects></objectModel>)";

const Fom& model() {
  static const Fom fom = Fom::parse(model_xml, "bench");
  return fom;
}

/// A peer that gives what it is asked for, and counts what it was given.
struct Peer : FederateAmbassador {
  Ambassador ambassador{model(), *this};
  std::vector<ObjectHandle> known;
  std::uint64_t acquired = 0;
  void discover_object_instance(ObjectHandle object, ObjectClassHandle, std::string_view) override {
    known.push_back(object);
  }
  void attribute_ownership_acquisition_notification(ObjectHandle, AttributeSet, Bytes) override {
    ++acquired;
  }
  void request_attribute_ownership_release(ObjectHandle object, AttributeSet attributes,
                                           Bytes) override {
    ambassador.attribute_ownership_divestiture_if_wanted(object, attributes);
  }
  void request_divestiture_confirmation(ObjectHandle object, AttributeSet attributes) override {
    ambassador.confirm_divestiture(object, attributes);
  }
};

enum class Way { asked_for, offered, let_go };

/// Two peers and the RTI in one thread, over the two ends of a transport.
struct Neighbours {
  template <class Connect>
  Neighbours(Transport& rti_end, Transport& peers_end, Connect connect) : peers_end(peers_end) {
    host.add(rti_end);
    for (std::size_t i = 0; i < 2; ++i) {
      ends[i].emplace(peers[i].ambassador, peers_end, connect());
      links.add(*ends[i]);
      peers[i].ambassador.join("rink", "peer " + std::to_string(i), "peer");
      peers[i].ambassador.publish_object_class_attributes(body, own);
      peers[i].ambassador.subscribe_object_class_attributes(body, own);
    }
  }
  void round() {
    links.flush(0.0);
    host.poll(0ms);
    host.match();
    host.flush();
    peers_end.poll(0ms, links);
  }
  template <class Condition>
  bool until(Condition is_met) {
    for (int rounds = 0; rounds < 1'000'000; ++rounds) {
      if (is_met()) return true;
      round();
    }
    return false;
  }

  Transport& peers_end;
  const ObjectClassHandle body = *model().object_class("Body");
  const AttributeSet own = model().attributes(body),
                     all = own | AttributeSet{privilege_to_delete_object};
  FederationExecution execution{model(), {}};
  FederationHost host{execution};
  Peer peers[2];
  std::optional<FederateLink> ends[2];
  FederateLinks links;
};

/// All bodies go from one peer to the other, and back in the next iteration.
void hand_over(benchmark::State& state, Neighbours& neighbours, Way way) {
  const auto count = static_cast<std::uint64_t>(state.range(0));
  if (!neighbours.until([&] {
        return neighbours.peers[0].ambassador.is_joined() &&
               neighbours.peers[1].ambassador.is_joined();
      }))
    return state.SkipWithError("nobody joined");
  std::vector<ObjectHandle> bodies;
  for (std::uint64_t i = 0; i < count; ++i)
    bodies.push_back(neighbours.peers[0].ambassador.register_object_instance(neighbours.body));
  if (!neighbours.until([&] { return neighbours.peers[1].known.size() == count; }))
    return state.SkipWithError("not all were discovered");
  std::uint64_t expected[2] = {0, 0};
  int from = 0;
  for (auto _ : state) {
    Ambassador &giver = neighbours.peers[from].ambassador,
               &taker = neighbours.peers[1 - from].ambassador;
    for (const ObjectHandle each : bodies) {
      if (way == Way::let_go)
        giver.unconditional_attribute_ownership_divestiture(each, neighbours.all);
      if (way == Way::offered)
        giver.negotiated_attribute_ownership_divestiture(each, neighbours.all);
    }
    if (way != Way::asked_for) neighbours.links.flush(0.0), neighbours.host.poll(0ms);
    for (const ObjectHandle each : bodies) {
      if (way == Way::asked_for) taker.attribute_ownership_acquisition(each, neighbours.all);
      else taker.attribute_ownership_acquisition_if_available(each, neighbours.all);
    }
    expected[1 - from] += count;
    if (!neighbours.until(
            [&] { return neighbours.peers[1 - from].acquired == expected[1 - from]; }))
      return state.SkipWithError("not all changed hands");
    from = 1 - from;
  }
  const std::uint64_t arrived = neighbours.peers[0].acquired + neighbours.peers[1].acquired;
  state.counters["handed_over_per_s"] =
      benchmark::Counter(static_cast<double>(arrived), benchmark::Counter::kIsRate);
  state.counters["arrived"] = static_cast<double>(arrived);
  state.counters["dropped"] = static_cast<double>(neighbours.execution.federate_count() != 2);
}

void in_process(benchmark::State& state, Way way) {
  InProcessNetwork network;
  InProcessEndpoint near(network), far(network);
  near.listen("rti");
  Neighbours neighbours(near, far, [&] { return far.connect("rti"); });
  hand_over(state, neighbours, way);
}

void over_tcp(benchmark::State& state, Way way) {
  TcpTransport near, far;
  const std::uint16_t port = near.listen("127.0.0.1", 0);
  Neighbours neighbours(near, far, [&] { return far.connect("127.0.0.1", port); });
  hand_over(state, neighbours, way);
}

const bool are_registered = [] {
  for (const auto& [name, way] : {std::pair{"asked_for", Way::asked_for},
                                  {"offered", Way::offered},
                                  {"let_go", Way::let_go}}) {
    benchmark::RegisterBenchmark(("rti/ownership/" + std::string(name) + "/in_process").c_str(),
                                 in_process, way)
        ->ArgName("objects")
        ->Arg(1)
        ->Arg(1000)
        ->UseRealTime()
        ->MinTime(0.3);
    benchmark::RegisterBenchmark(("rti/ownership/" + std::string(name) + "/tcp").c_str(), over_tcp,
                                 way)
        ->ArgName("objects")
        ->Arg(1)
        ->Arg(1000)
        ->UseRealTime()
        ->MinTime(0.3);
  }
  return true;
}();

}  // namespace
}  // namespace rink::bench::rti_ownership_bench
