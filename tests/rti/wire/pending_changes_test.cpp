// What federates that are not updated at every match are still to be sent: held against a list of
// every attribute's newest update, of federates that are updated at different flushes.
#include "rti/buffering/pending_changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

constexpr std::uint32_t pending_vessels = 200;

/// Vessels in an object table, and for each phase and attribute the stamp of the newest update
/// since the phase's last turn.
class PendingFleet {
 public:
  explicit PendingFleet(std::size_t phase_count = 1) : phases(phase_count) {
    const auto object_class = static_cast<std::uint16_t>(vessel.value);
    for (std::uint32_t k = 0; k < pending_vessels; ++k) {
      slots_.push_back(objects_.insert({k}, 0, object_class, ""));
      objects_.store(slots_.back(), motion, values_of(0.0f, 0.0f, 0.0f));
    }
  }
  void update(std::uint32_t object, AttributeSet attributes, float value, const Stamp& stamp) {
    std::vector<std::byte> values;
    if (attributes.contains(position)) values = values_of(value, -value);
    if (attributes.contains(speed)) {
      const std::vector<std::byte> more = values_of(value);
      values.insert(values.end(), more.begin(), more.end());
    }
    objects_.store(slots_[object], attributes, values);
    runs_.append({.owner = 0,
                  .slot = slots_[object],
                  .object = objects_[slots_[object]],
                  .attributes = attributes,
                  .stamp = stamp,
                  .values = values});
    attributes.for_each([&](AttributeHandle each) {
      for (Phase& phase : phases) phase.newest[{object, each.value}] = stamp.time;
    });
  }
  void flush() {
    runs_.seal();
    pending.add(runs_.runs());
    runs_.clear();
  }
  /// The turn of one phase.
  void expect_newest_once(std::size_t number = 0) {
    Phase& phase = phases[number];
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> sent;
    double before = 0.0;
    for (const UpdateRun& run : pending.seal(objects_, phase.position)) {
      EXPECT_GE(run.stamp.time, before) << "stamps ascend";
      before = run.stamp.time;
      for (std::size_t k = 0; k < run.slots.size(); ++k) {
        run.attributes.for_each([&](AttributeHandle each) {
          EXPECT_TRUE(
              sent.emplace(std::pair(run.records[k].handle, each.value), run.stamp.time).second)
              << "twice";
        });
        std::vector<std::byte> now;
        objects_.append(run.slots[k], run.attributes, now);
        EXPECT_TRUE(std::ranges::equal(now, run.values(k)));
      }
    }
    EXPECT_EQ(sent, phase.newest);
    skip_turn(number);
  }
  /// The phase has received all.
  void skip_turn(std::size_t number = 0) {
    phases[number].newest.clear();
    phases[number].position = pending.flush_number();
    pending.forget(std::ranges::min(phases, {}, &Phase::position).position);
  }

  struct Phase {
    std::uint64_t position = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> newest;
  };
  PendingChanges pending;
  std::vector<Phase> phases;

 private:
  ObjectTable objects_{harbour()};
  std::vector<ObjectSlot> slots_;
  UpdateRuns runs_;
};

TEST(PendingChanges, HoldsTheNewestUpdateOfEachAttributeOnce) {
  std::mt19937 engine(7);
  const auto below = [&engine](std::uint32_t bound) {
    return static_cast<std::uint32_t>(engine() % bound);
  };
  PendingFleet fleet(7);
  const AttributeSet sets[] = {{position}, {speed}, motion};
  double time = 0.0;
  for (int turn = 0; turn < 400; ++turn) {
    const int flushes = 1 + static_cast<int>(below(5));
    for (int flush = 0; flush < flushes; ++flush) {
      time += 1.0;
      for (std::uint32_t k = below(60); k > 0; --k)
        fleet.update(below(pending_vessels), sets[below(3)], static_cast<float>(below(99)),
                     {time, below(2)});
      fleet.flush();
    }
    fleet.expect_newest_once(below(below(7) + 1));  // some phases come rarely
  }
  for (std::size_t phase = 0; phase < fleet.phases.size(); ++phase) fleet.expect_newest_once(phase);
}

TEST(PendingChanges, ForgetsWhatIsGone) {
  PendingFleet fleet;
  fleet.expect_newest_once();
  fleet.update(3, motion, 1.0f, {1.0, 0});
  fleet.flush();
  fleet.skip_turn();
  fleet.expect_newest_once();
}

}  // namespace
}  // namespace rink::rti::testing
