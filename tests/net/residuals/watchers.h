// Federates that keep what they are told, and a network that treats them badly.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "rti/ambassador.h"
#include "tests/net/rink_model.h"

namespace rink::game::residuals {

using Values = std::vector<std::byte>;

/// Keeps the newest value of each attribute of each object, and which objects are in scope.
struct Watcher final : rti::FederateAmbassador {
  rti::Ambassador ambassador{rink_fom(), *this};
  std::map<std::uint32_t, std::map<std::uint32_t, Values>> values;
  std::set<std::uint32_t> in_scope, known;
  rti::RegionHandle region;
  rti::AttributeSet subscribed;
  bool is_reading = true;
  bool is_waiting = false;  ///< for a grant: until it asks, updates in receive order are put off
  void time_advance_grant(rti::LogicalTime) override { is_waiting = false; }
  /// A local deletion of what it knows: it discovers the object again.
  void forget(rti::ObjectHandle object) {
    if (!known.contains(object.value)) return;
    ambassador.local_delete_object_instance(object);
    remove_object_instance(object);
  }
  void discover_object_instance(rti::ObjectHandle object, rti::ObjectClassHandle,
                                std::string_view) override {
    known.insert(object.value);
  }
  void attributes_in_scope(rti::ObjectHandle object) override { in_scope.insert(object.value); }
  /// What comes back into scope must be sent anew, or reflected since it is held; but for what is
  /// given one value for good.
  void attributes_out_of_scope(rti::ObjectHandle object) override {
    in_scope.erase(object.value);
    std::erase_if(values[object.value],
                  [](const auto& each) { return each.first != rink_model().shape.value; });
  }
  void remove_object_instance(rti::ObjectHandle object) override {
    in_scope.erase(object.value);
    known.erase(object.value);
    values.erase(object.value);
  }
  void reflect_attribute_values(rti::ObjectHandle object, rti::AttributeSet set, rti::Bytes sent,
                                const rti::Stamp&) override {
    set.for_each([&](rti::AttributeHandle each) {
      const rti::Bytes value = rink_fom().value(rink_model().entity, set, each, sent);
      values[object.value][each.value] = Values(value.begin(), value.end());
    });
  }
};

/// A network that delays frames, and delays, loses, doubles and disorders datagrams.
class Storm {
 public:
  explicit Storm(unsigned seed) : random_(seed) {}
  void send(Watcher& to, std::span<const rti::Bytes> parts) {
    Frames& frames = frames_[&to];
    Values& frame = frames.emplace_back();
    for (const rti::Bytes part : parts) frame.insert(frame.end(), part.begin(), part.end());
  }
  void send(Watcher& to, const rti::Datagram& datagram) {
    if (random_() % 4 == 0) return;
    for (unsigned copies = random_() % 8 == 0 ? 2 : 1; copies > 0; --copies) {
      Values bytes(datagram.head.begin(), datagram.head.end());
      bytes.insert(bytes.end(), datagram.body.begin(), datagram.body.end());
      datagrams_.push_back({&to, std::move(bytes), static_cast<unsigned>(random_() % 6)});
    }
  }
  /// What arrives at this tick; all of the stream that is under way, with `is_over`.
  void deliver(bool is_over) {
    for (auto& [to, frames] : frames_)
      for (; !frames.empty() && (is_over || random_() % 3 != 0); frames.pop_front())
        ASSERT_TRUE(to->ambassador.receive(frames.front()));
    std::vector<Arrival> here;
    std::erase_if(datagrams_, [&](Arrival& each) {
      return each.ticks-- == 0 ? (here.push_back(std::move(each)), true) : false;
    });
    for (const Arrival& each : here) each.to->ambassador.receive_datagram(each.bytes);
  }

 private:
  using Frames = std::deque<Values>;
  struct Arrival {
    Watcher* to;
    Values bytes;
    unsigned ticks;
  };
  std::mt19937_64 random_;
  std::map<Watcher*, Frames> frames_;
  std::vector<Arrival> datagrams_;
};

}  // namespace rink::game::residuals
