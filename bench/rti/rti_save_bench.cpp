// How long a federation stands still while it is saved and restored: 100 federates, 10,000 objects
// that all of them know, files on the disk of the temporary folder.
#include <benchmark/benchmark.h>
#include <stdlib.h>

#include <deque>
#include <filesystem>
#include <memory>
#include <string>

#include "bench/rti/entity_federation.h"
#include "rti/save/save_directory.h"

namespace rink::bench::rti_save_bench {
namespace {

using namespace rink::rti;

/// Answers at once.
struct Saver final : CountingFederate {
  using CountingFederate::CountingFederate;
  bool is_saved = false, is_restored = false;
  void initiate_federate_save(std::string_view) override {
    ambassador.federate_save_begun();
    ambassador.federate_save_complete();
  }
  void federation_saved() override { is_saved = true; }
  void initiate_federate_restore(std::string_view, std::string_view, FederateHandle) override {
    ambassador.federate_restore_complete();
  }
  void federation_restored() override { is_restored = true; }
};

class SavedCrowd final : private Outlet {
 public:
  explicit SavedCrowd(const std::filesystem::path& folder) {
    FederationServices services;
    services.save_store = std::make_shared<SaveDirectory>(folder);
    execution_ =
        std::make_unique<FederationExecution>(reliable_entities(), FederationSettings{}, services);
  }
  void join(int federates) {
    for (int i = 0; i < federates; ++i) {
      execution_->connect(static_cast<ConnectionId>(i));
      savers.emplace_back(reliable_entities()).join("saver " + std::to_string(i), "saver");
    }
    tick();
  }
  void populate(int objects) {
    const Fom& fom = reliable_entities();
    const ObjectClassHandle entity = *fom.object_class("Entity");
    constexpr std::array<std::byte, 8> value{};
    for (Saver& each : savers) {
      each.subscribe(fom);
      each.ambassador.publish_object_class_attributes(entity, fom.attributes(entity));
    }
    tick();
    for (int i = 0; i < objects; ++i) {
      Ambassador& owner = savers[static_cast<std::size_t>(i) % savers.size()].ambassador;
      owner.update_attribute_values(owner.register_object_instance(entity), fom.attributes(entity),
                                    value, {});
    }
    for (int i = 0; i < 20; ++i) tick();
  }
  void tick() {
    for (ConnectionId id = 0; id < savers.size(); ++id) {
      execution_->receive(id, savers[id].ambassador.outgoing());
      savers[id].ambassador.clear_outgoing();
    }
    execution_->match();
    execution_->flush(*this);
  }
  std::uint64_t updates() const {
    std::uint64_t sum = 0;
    for (const Saver& each : savers) sum += each.updates;
    return sum;
  }
  std::deque<Saver> savers;

 private:
  void send(ConnectionId id, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) savers[id].ambassador.receive(part);
  }
  void drop(ConnectionId, std::string_view) override {}

  std::unique_ptr<FederationExecution> execution_;
};

/// The timed one is the save, or the restore by another RTI and new federates until all are told.
void save(benchmark::State& state, bool is_restore) {
  constexpr int federates = 100;
  const auto objects = static_cast<int>(state.range(0));
  std::string folder = std::filesystem::temp_directory_path() / "rink-bench-XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) return state.SkipWithError("no temporary folder");
  double megabytes = 0.0;
  std::uint64_t states = 0;
  for (auto _ : state) {
    state.PauseTiming();
    {
      SavedCrowd crowd(folder);
      crowd.join(federates);
      crowd.populate(objects);
      if (!is_restore) state.ResumeTiming();
      crowd.savers[0].ambassador.request_federation_save("bench");
      while (!crowd.savers.back().is_saved) crowd.tick();
      if (!is_restore) state.PauseTiming();
    }
    for (const auto& file : std::filesystem::directory_iterator(folder))
      megabytes = static_cast<double>(file.file_size()) / 1e6;
    if (is_restore) {
      SavedCrowd crowd(folder);
      crowd.join(federates);
      state.ResumeTiming();
      crowd.savers[0].ambassador.request_federation_restore("bench");
      while (!crowd.savers.back().is_restored) crowd.tick();
      state.PauseTiming();
      for (int i = 0; i < 20; ++i) crowd.tick();
      states = crowd.updates();
      if (states != static_cast<std::uint64_t>(objects) * (federates - 1))
        state.SkipWithError("not all were sent all states");
    }
    state.ResumeTiming();
  }
  state.counters["MB"] = megabytes;
  if (is_restore) state.counters["states"] = static_cast<double>(states);
  std::filesystem::remove_all(folder);
}

void saves(benchmark::internal::Benchmark* timed) {
  timed->ArgName("objects")->Arg(1000)->Arg(10'000)->UseRealTime()->Iterations(3)->Unit(
      benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(save, save, false)->Name("rti/save")->Apply(saves);
BENCHMARK_CAPTURE(save, restore, true)->Name("rti/restore")->Apply(saves);

}  // namespace
}  // namespace rink::bench::rti_save_bench
