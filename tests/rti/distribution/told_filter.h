// A filter that notes what it is told and lets through what a test says; with a budget, if one is
// given.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "im/filter.h"
#include "im/stages/priority_order.h"
#include "rti/fom/fom.h"

namespace rink::rti {

class ToldFilter final : public im::Filter {
 public:
  explicit ToldFilter(const im::Traits& traits = {}, std::size_t budget = 0)
      : order_(budget), traits_(traits) {}

  void set_update_region(im::Entity entity, const im::Region& region) override {
    entities[entity] = region;
    order_.place_entity(entity, region);
  }
  void remove_entity(im::Entity entity) override {
    entities.erase(entity);
    roles.erase(entity);
    order_.remove_entity(entity);
  }
  void set_subscription_region(im::Subscriber subscriber, const im::Region& region) override {
    subscribers[subscriber] = region;
    order_.place_subscriber(subscriber, region);
  }
  void remove_subscriber(im::Subscriber subscriber) override {
    subscribers.erase(subscriber);
    order_.remove_subscriber(subscriber);
  }
  void set_heading(im::Subscriber subscriber, const im::Heading& heading) override {
    headings[subscriber] = heading;
  }
  void set_entity_role(im::Entity entity, const im::Role& role) override { roles[entity] = role; }
  void set_subscriber_role(im::Subscriber subscriber, const im::Role& role) override {
    subscriber_roles[subscriber] = role;
  }
  void set_flight(im::Entity entity, const im::Flight& flight) override {
    flights[entity] = flight;
  }
  std::span<const im::Change> match() override {
    if (order_.budget() > 0) order_.take(changes);
    return changes;
  }
  im::PriorityOrder* priority() override { return order_.budget() > 0 ? &order_ : nullptr; }
  im::Traits traits() const override { return traits_; }
  const im::FilterCounters& counters() const override { return counters_; }

  std::map<im::Entity, im::Region> entities;
  std::map<im::Subscriber, im::Region> subscribers;
  std::map<im::Entity, im::Role> roles;
  std::map<im::Subscriber, im::Role> subscriber_roles;
  std::map<im::Subscriber, im::Heading> headings;
  std::map<im::Entity, im::Flight> flights;
  std::vector<im::Change> changes;

 private:
  im::PriorityOrder order_;
  im::Traits traits_;
  im::FilterCounters counters_;
};

/// Class 1 has two attributes; class 2 is one of it and inherits them. Interaction 1 is one of 0.
inline const Fom& plain_fom() {
  static const Fom fom = Fom::parse(R"(<objectModel><objects><objectClass><name>Root</name>
<objectClass><name>Body</name>
<attribute><name>position</name><dataType>HLAfloat64LE</dataType></attribute>
<attribute><name>colour</name><dataType>HLAfloat64LE</dataType></attribute>
<objectClass><name>Puck</name></objectClass></objectClass></objectClass></objects>
<interactions><interactionClass><name>Said</name><interactionClass><name>Cried</name>
</interactionClass></interactionClass></interactions>
<dimensions><dimension><name>X</name></dimension><dimension><name>Y</name></dimension>
<dimension><name>Height</name></dimension></dimensions></objectModel>)",
                                    "plain");
  return fom;
}
inline constexpr std::uint16_t body_class = 1, puck_class = 2;

}  // namespace rink::rti
