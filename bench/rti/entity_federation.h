// A federation of entities that have a position, with one federate that updates them: what most
// benchmarks of the RTI time.
#pragma once

#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "rti/ambassador.h"
#include "rti/federation_execution.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"

namespace rink::bench {

inline rti::Fom entity_model(const std::string& transportation) {
  return rti::Fom::parse(
      R"(<objectModel><objects><objectClass><name>Root</name><objectClass><name>Entity</name>
<attribute><name>position</name><dataType>HLAfloat64LE</dataType>)" +
          transportation + "</attribute></objectClass></objectClass></objects></objectModel>",
      "bench");
}
inline const rti::Fom& reliable_entities() {
  static const rti::Fom fom = entity_model("");
  return fom;
}
inline const rti::Fom& best_effort_entities() {
  static const rti::Fom fom = entity_model("<transportation>HLAbestEffort</transportation>");
  return fom;
}

/// Counts the updates that reach it.
struct CountingFederate : rti::FederateAmbassador {
  explicit CountingFederate(const rti::Fom& fom) : ambassador(fom, *this) {}
  rti::Ambassador ambassador;
  std::uint64_t updates = 0;
  void reflect_attribute_values(rti::ObjectHandle, rti::AttributeSet, rti::Bytes,
                                const rti::Stamp&) override {
    ++updates;
  }
  void join(const std::string& name, const std::string& type) {
    ambassador.join("rink", name, type);
  }
  void subscribe(const rti::Fom& fom) {
    const rti::ObjectClassHandle entity = *fom.object_class("Entity");
    ambassador.subscribe_object_class_attributes(entity, fom.attributes(entity));
  }
};

/// The RTI and, in the same process, a federate that updates entities. Other federates receive the
/// updates over the transport that is handed in.
struct EntityFederation {
  static constexpr int seen_count = 275;  ///< entities that each client sees: 5 % of 5,500

  EntityFederation(const rti::Fom& fom, const rti::FederationSettings& settings,
                   rti::Transport& transport)
      : execution(fom, settings),
        host(execution),
        federate(fom),
        entity(*fom.object_class("Entity")),
        position(fom.attributes(entity)) {
    near.listen("rti");
    host.add(near);
    host.add(transport);
    link.emplace(federate.ambassador, own, own.connect("rti"));
    links.add(*link);
    federate.join("server", "server");
    federate.ambassador.publish_object_class_attributes(entity, position);
    while (!federate.ambassador.is_joined()) tick(0.0);
  }
  EntityFederation(const EntityFederation&) = delete;
  EntityFederation& operator=(const EntityFederation&) = delete;

  bool has(int clients) const {
    return execution.federate_count() >= static_cast<std::size_t>(clients) + 1;
  }
  void tick(double now) {
    using namespace std::chrono_literals;
    links.flush(now);
    host.poll(0ms);
    host.match();
    host.flush();
    own.poll(0ms, links);
  }
  void register_entities() {
    for (int i = 0; i < seen_count; ++i)
      objects.push_back(federate.ambassador.register_object_instance(entity));
    for (int i = 0; i < 10; ++i) tick(0.0);
  }
  void update_all(const rti::Stamp& stamp) {
    constexpr std::array<std::byte, 8> value{};
    for (const rti::ObjectHandle object : objects)
      federate.ambassador.update_attribute_values(object, position, value, stamp);
  }

  rti::FederationExecution execution;
  rti::FederationHost host;
  rti::InProcessNetwork network;
  rti::InProcessEndpoint near{network}, own{network};
  CountingFederate federate;
  std::optional<rti::FederateLink> link;
  rti::FederateLinks links;
  rti::ObjectClassHandle entity;
  rti::AttributeSet position;
  std::vector<rti::ObjectHandle> objects;
};

/// Sixty ticks to each of two crowds.
inline void send_to_crowds(benchmark::internal::Benchmark* timed) {
  timed->ArgName("clients")->Arg(100)->Arg(1000)->UseRealTime()->Iterations(60)->Unit(
      benchmark::kMillisecond);
}

}  // namespace rink::bench
