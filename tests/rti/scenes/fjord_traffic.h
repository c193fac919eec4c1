// Boats whose tracks are told every tick, over a channel that loses frames and holds
// acknowledgements back as the test says.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <random>

#include "rti/fom/quantised_codec.h"
#include "tests/rti/rig.h"
#include "tests/rti/scenes/fjord.h"
#include "tests/rti/seeded.h"

namespace rink::rti::testing {

inline std::vector<std::byte> reversed(std::vector<std::byte> bytes) {
  std::ranges::reverse(bytes);
  return bytes;
}
inline std::vector<std::byte> track_of(double x, double y, float speed_x, float speed_y) {
  std::vector<std::byte> bytes = values_of(x, y);
  for (const float each : {speed_x, speed_y})
    std::ranges::copy(reversed(values_of(each)), std::back_inserter(bytes));
  return bytes;
}
inline const QuantisedCodec& track_codec() {
  return *fjord().at(boat).attributes[track.value].baselines;
}
/// What a track is after it was rounded to its grid.
inline std::vector<std::byte> rounded(const std::vector<std::byte>& value) {
  std::vector<std::byte> coded, decoded;
  track_codec().encode(value, 0.0, coded);
  EXPECT_TRUE(static_cast<const AttributeCodec&>(track_codec()).decode(coded, 0.0, decoded));
  return decoded;
}

/// Keeps what it was told of tracks, and when.
struct Watcher : FederateAmbassador {
  struct Seen {
    std::vector<std::byte> track;
    double time = -1.0;
    bool is_in_scope = false;
  };
  std::map<std::uint32_t, Seen> seen;
  int reflections = 0;
  std::string lost;

  void reflect_attribute_values(ObjectHandle object, AttributeSet set, Bytes values,
                                const Stamp& stamp) override {
    if (!set.contains(track)) return;
    const Bytes value = fjord().value(boat, set, track, values);
    Seen& boat_seen = seen[object.value];
    boat_seen.track.assign(value.begin(), value.end());
    boat_seen.time = stamp.time;
    ++reflections;
  }
  void attributes_in_scope(ObjectHandle object) override { seen[object.value].is_in_scope = true; }
  void attributes_out_of_scope(ObjectHandle object) override {
    seen[object.value].is_in_scope = false;
  }
  void remove_object_instance(ObjectHandle object) override { seen.erase(object.value); }
  void connection_lost(std::string_view why) override { lost = why; }
};

/// A federate and its wire in both directions.
struct Shore {
  Watcher heard;
  Ambassador ambassador{fjord(), heard};
  ConnectionId connection = 0;
  std::deque<std::vector<std::byte>> said;    ///< on its way to the RTI
  std::deque<std::vector<std::byte>> frames;  ///< on their way from it
};

class FjordTraffic : public Outlet {
 public:
  explicit FjordTraffic(const FederationSettings& settings = {})
      : execution(fjord(), settings), owner(join("owner")) {
    owner.ambassador.publish_object_class_attributes(boat, {track, cargo});
  }

  FederationExecution execution;
  std::deque<Shore> shores;
  Shore& owner;
  double now = 0.0;

  Shore& join(const std::string& name) {
    Shore& shore = shores.emplace_back();
    shore.connection = static_cast<ConnectionId>(shores.size());
    execution.connect(shore.connection);
    shore.ambassador.join("rink", name, "tester");
    tick();
    return shore;
  }
  /// Hears of all boats, or of those that overlap its region.
  Shore& watch(const std::string& name, const std::optional<im::Region>& bounds = {}) {
    Shore& shore = join(name);
    const RegionHandle region = bounds ? shore.ambassador.create_region() : RegionHandle{};
    if (bounds)
      shore.ambassador.set_region(region, *bounds),
          shore.ambassador.commit_region_modifications(region);
    shore.ambassador.subscribe_object_class_attributes(boat, {track, cargo}, region);
    return shore;
  }
  /// What was said is heard, unless `hold` keeps it on its way; then the RTI answers, and what
  /// `lose` says is lost.
  void tick(const std::function<bool(Shore&)>& hold = {},
            const std::function<bool(Shore&)>& lose = {}) {
    for (Shore& shore : shores) {
      const Bytes bytes = shore.ambassador.outgoing();
      if (!bytes.empty()) shore.said.emplace_back(bytes.begin(), bytes.end());
      shore.ambassador.clear_outgoing();
      if (hold && hold(shore)) continue;
      for (; !shore.said.empty(); shore.said.pop_front())
        execution.receive(shore.connection, shore.said.front());
    }
    execution.match();
    execution.flush(*this);
    for (Shore& shore : shores)
      for (; !shore.frames.empty(); shore.frames.pop_front())
        if (!lose || !lose(shore)) shore.ambassador.receive(shore.frames.front());
  }

 private:
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    std::vector<std::byte>& frame = shores[connection - 1].frames.emplace_back();
    for (const Bytes part : parts) frame.insert(frame.end(), part.begin(), part.end());
  }
  void drop(ConnectionId connection, std::string_view why) override {
    ADD_FAILURE() << "connection " << connection << " was dropped: " << why;
  }
};

/// A boat that goes straight on, with a drag, and now and then is hit.
struct Boat {
  ObjectHandle object;
  RegionHandle region;
  double x = 0.0, y = 0.0, speed_x = 0.0, speed_y = 0.0;
  std::vector<std::byte> truth;  ///< as it should be known

  static Boat random(std::mt19937_64& dice) {
    Boat made;
    made.x = between(dice, 0.0, 2000.0);
    made.y = between(dice, 0.0, 2000.0);
    made.hit(dice);
    return made;
  }
  im::Region box() const { return {x - 1.0, y - 1.0, x + 1.0, y + 1.0}; }
  void hit(std::mt19937_64& dice) {
    speed_x = between(dice, -25.0, 25.0);
    speed_y = between(dice, -25.0, 25.0);
  }
  void sail(double elapsed, std::mt19937_64& dice) {
    if (dice() % 50 == 0) hit(dice);
    x += speed_x * elapsed, y += speed_y * elapsed;
    speed_x *= 1.0 - 0.25 * elapsed, speed_y *= 1.0 - 0.25 * elapsed;
    if (x < 0.0 || x > 2000.0) speed_x = -speed_x;
    if (y < 0.0 || y > 2000.0) speed_y = -speed_y;
  }
  std::vector<std::byte> value() const {
    return track_of(x, y, static_cast<float>(speed_x), static_cast<float>(speed_y));
  }
  void tell(Ambassador& ambassador, double now) {
    truth = rounded(value());
    ambassador.update_attribute_values(object, {track}, value(), {now, 0});
  }
};

}  // namespace rink::rti::testing
