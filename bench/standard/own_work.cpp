// Federates of Rink's own API that send, receive, advance and join, as standard_work.cpp's do.
#include "bench/standard/own_work.h"

#include <chrono>
#include <optional>
#include <stdexcept>

#include "bench/standard/meeting.h"
#include "rti/ambassador.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/tcp/tcp.h"

namespace rink_driver {

namespace {

using namespace rink::rti;

Bytes bytes_of(const State& state) { return std::as_bytes(std::span(&state, 1)); }

/// A member of the execution "driver", which it creates if nobody has.
class OwnMember : public FederateAmbassador {
 public:
  explicit OwnMember(const OwnPlace& place)
      : model(place.model),
        rti(model, *this),
        entity(*model.object_class("Entity")),
        states(model.attributes(entity)) {
    link.emplace(rti, tcp, tcp.connect("127.0.0.1", place.port));
    links.add(*link);
    rti.create_federation_execution("driver", model);
    await([&] { return is_created; });
    // Each member has its own name.
    static std::atomic<int> number(0);
    rti.join("driver", "own " + std::to_string(number++), "driver");
    await([&] { return rti.is_joined(); });
  }
  ~OwnMember() override {
    if (rti.is_joined()) rti.resign(ResignAction::delete_objects_then_divest);
    if (!link->is_finished()) link->close();
    for (int tries = 0; !link->is_finished() && tries < 1000; ++tries) turn(1);
  }
  OwnMember(const OwnMember&) = delete;
  OwnMember& operator=(const OwnMember&) = delete;

  void federation_execution_created(std::string_view, HlaError) override { is_created = true; }
  void turn(int wait_ms) {
    flush();
    tcp.poll(std::chrono::milliseconds(wait_ms), links);
  }
  void flush() { links.flush(wall_seconds()); }
  void register_objects() {
    for (std::uint64_t i = 0; i < object_count; ++i)
      objects.push_back(rti.register_object_instance(entity));
  }
  void update(std::uint64_t object, std::uint64_t round) {
    const State content = State::of(object, round);
    rti.update_attribute_values(objects[object], states, bytes_of(content), {});
  }

  const Fom& model;
  Ambassador rti;
  TcpTransport tcp;
  std::optional<FederateLink> link;
  FederateLinks links;
  ObjectClassHandle entity;
  AttributeSet states;
  std::vector<ObjectHandle> objects;

 private:
  template <class Condition>
  void await(const Condition& is_so) {
    while (!is_so()) {
      if (link->is_finished()) throw std::runtime_error("the RTI has closed the connection");
      turn(10);
    }
  }
  bool is_created = false;
};

class OwnSubscriber : public OwnMember {
 public:
  using OwnMember::OwnMember;
  void discover_object_instance(ObjectHandle, ObjectClassHandle, std::string_view) override {
    ++received.discovered;
  }
  void reflect_attribute_values(ObjectHandle, AttributeSet, Bytes values, const Stamp&) override {
    received.update(values.data(), values.size());
  }

  Received received;
};

template <class Act>
std::thread own_thread_of(Meeting& meeting, Act act) {
  return std::thread([&meeting, act] {
    try {
      act();
    } catch (const std::exception& exception) {
      meeting.fail(exception.what());
    }
  });
}

template <class Act>
void run_own_with(Meeting& meeting, std::vector<std::thread>& others, const Act& act) {
  try {
    act();
  } catch (const std::exception& exception) {
    meeting.fail(exception.what());
  }
  meeting.is_over = true;
  for (std::thread& each : others) each.join();
}

}  // namespace

Outcome own_updates(const OwnPlace& place, int subscribers, std::uint64_t rounds) {
  Meeting meeting;
  Outcome outcome;
  std::vector<std::atomic<std::uint64_t>> arrived(static_cast<std::size_t>(subscribers));
  std::vector<std::thread> threads;
  for (auto& own : arrived)
    threads.push_back(own_thread_of(meeting, [&meeting, &place, &own] {
      OwnSubscriber subscriber(place);
      subscriber.rti.subscribe_object_class_attributes(subscriber.entity, subscriber.states);
      bool is_ready = false;
      while (!meeting.is_over) {
        subscriber.turn(1);
        if (!is_ready && subscriber.received.discovered == object_count) {
          is_ready = true;
          ++meeting.ready;
        }
        own = subscriber.received.updates;
        if (subscriber.received.is_spoilt) meeting.fail("a wrong update arrived");
      }
    }));
  const auto all_have = [&](std::uint64_t updates) {
    for (const auto& each : arrived)
      if (each < updates) return false;
    return true;
  };
  run_own_with(meeting, threads, [&] {
    OwnMember owner(place);
    owner.rti.publish_object_class_attributes(owner.entity, owner.states);
    owner.register_objects();
    if (!meeting.wait([&] { return meeting.ready == subscribers; }, [&] { owner.turn(1); })) return;
    Stopwatch watch;
    watch.begin();
    for (std::uint64_t round = 0; round < rounds; ++round) {
      for (std::uint64_t i = 0; i < object_count; ++i) owner.update(i, round);
      owner.turn(0);
      const std::uint64_t due = round < round_window ? 0 : round - round_window;
      if (!meeting.wait([&] { return all_have(due * object_count); }, rest)) return;
    }
    if (!meeting.wait([&] { return all_have(rounds * object_count); }, rest)) return;
    watch.end(outcome);
    for (const auto& each : arrived) outcome.count += each;
  });
  outcome.fault = meeting.fault();
  return outcome;
}

namespace {

class OwnPlayer : public OwnMember {
 public:
  OwnPlayer(const OwnPlace& place, const char* sends, const char* receives)
      : OwnMember(place), sent(*model.interaction_class(sends)) {
    rti.publish_interaction_class(sent);
    rti.subscribe_interaction_class(*model.interaction_class(receives));
  }
  void receive_interaction(InteractionClassHandle, Bytes parameters, FederateHandle,
                           const Stamp&) override {
    State content;
    if (!State::read(parameters.data(), parameters.size(), content) || content.round != received)
      is_spoilt = true;
    ++received;
  }
  void turn_interactions_on(InteractionClassHandle) override { is_heard = true; }
  void send(std::uint64_t round) {
    const State content = State::of(0, round);
    rti.send_interaction(sent, bytes_of(content), {});
    flush();
  }

  InteractionClassHandle sent;
  std::uint64_t received = 0;
  bool is_spoilt = false, is_heard = false;
};

}  // namespace

Outcome own_round_trips(const OwnPlace& place, std::uint64_t count) {
  Meeting meeting;
  Outcome outcome;
  std::vector<std::thread> threads;
  threads.push_back(own_thread_of(meeting, [&] {
    OwnPlayer other(place, "Pong", "Ping");
    if (!meeting.wait([&] { return other.is_heard; }, [&] { other.turn(10); })) return;
    ++meeting.ready;
    for (std::uint64_t round = 0; !meeting.is_over; ++round) {
      while (other.received <= round && !meeting.is_over) other.turn(10);
      if (!meeting.is_over) other.send(round);
    }
  }));
  run_own_with(meeting, threads, [&] {
    OwnPlayer one(place, "Ping", "Pong");
    if (!meeting.wait([&] { return one.is_heard && meeting.ready == 1; }, [&] { one.turn(10); }))
      return;
    Stopwatch watch;
    watch.begin();
    for (std::uint64_t round = 0; round < count; ++round) {
      one.send(round);
      if (!meeting.wait([&] { return one.received > round; }, [&] { one.turn(10); })) return;
    }
    watch.end(outcome);
    outcome.count = one.received;
    if (one.is_spoilt) meeting.fail("a wrong interaction arrived");
  });
  outcome.fault = meeting.fault();
  return outcome;
}

namespace {

class OwnClock : public OwnMember {
 public:
  explicit OwnClock(const OwnPlace& place) : OwnMember(place) {
    rti.enable_time_regulation(1.0);
    rti.enable_time_constrained();
  }
  void time_regulation_enabled(LogicalTime) override { ++enabled; }
  void time_constrained_enabled(LogicalTime) override { ++enabled; }
  void time_advance_grant(LogicalTime time) override {
    now = time.value;
    ++granted;
  }

  int enabled = 0;
  double now = 0.0;
  std::uint64_t granted = 0;
};

}  // namespace

Outcome own_advances(const OwnPlace& place, int federates, std::uint64_t steps) {
  Meeting meeting;
  Outcome outcome;
  std::atomic<int> done(0);
  std::atomic<std::uint64_t> granted(0);
  std::vector<std::thread> threads;
  for (int k = 0; k < federates; ++k)
    threads.push_back(own_thread_of(meeting, [&] {
      OwnClock clock(place);
      const auto turn = [&] { clock.turn(10); };
      if (!meeting.wait([&] { return clock.enabled == 2; }, turn)) return;
      ++meeting.ready;
      if (!meeting.wait([&] { return meeting.ready > federates; }, turn)) return;
      for (std::uint64_t step = 1; step <= steps; ++step) {
        clock.rti.time_advance_request(LogicalTime(static_cast<double>(step)));
        if (!meeting.wait([&] { return clock.granted == step; }, turn)) return;
        if (clock.now != static_cast<double>(step)) meeting.fail("a grant of another time");
      }
      granted += clock.granted;
      ++done;
      meeting.wait([&] { return done == federates; }, turn);
    }));
  run_own_with(meeting, threads, [&] {
    if (!meeting.wait([&] { return meeting.ready == federates; }, rest)) return;
    Stopwatch watch;
    watch.begin();
    ++meeting.ready;
    if (!meeting.wait([&] { return done == federates; }, rest)) return;
    watch.end(outcome);
    outcome.count = granted;
  });
  outcome.fault = meeting.fault();
  return outcome;
}

Outcome own_joins(const OwnPlace& place, std::uint64_t count) {
  Meeting meeting;
  Outcome outcome;
  std::vector<std::thread> nobody;
  run_own_with(meeting, nobody, [&] {
    OwnMember keeper(place);
    Stopwatch watch;
    watch.begin();
    for (; outcome.count < count; ++outcome.count) OwnMember guest(place);
    watch.end(outcome);
  });
  outcome.fault = meeting.fault();
  return outcome;
}

namespace {

class OwnProvider : public OwnMember {
 public:
  using OwnMember::OwnMember;
  void provide_attribute_value_update(ObjectHandle object, AttributeSet, Bytes) override {
    for (std::uint64_t i = 0; i < object_count; ++i)
      if (objects[i] == object) return update(i, 0);
  }
};

class OwnLateJoiner : public OwnMember {
 public:
  using OwnMember::OwnMember;
  void reflect_attribute_values(ObjectHandle, AttributeSet, Bytes values, const Stamp&) override {
    State content;
    if (!State::read(values.data(), values.size(), content) || content.object >= object_count ||
        content.round != 0) {
      is_spoilt = true;
      return;
    }
    valued += !has_value[content.object];
    has_value[content.object] = true;
  }

  std::uint64_t valued = 0;
  bool has_value[object_count] = {}, is_spoilt = false;
};

}  // namespace

Outcome own_late_joiners(const OwnPlace& place, std::uint64_t joiners) {
  Meeting meeting;
  Outcome outcome;
  std::vector<std::thread> threads;
  threads.push_back(own_thread_of(meeting, [&] {
    OwnProvider owner(place);
    owner.rti.publish_object_class_attributes(owner.entity, owner.states);
    owner.register_objects();
    for (std::uint64_t i = 0; i < object_count; ++i) owner.update(i, 0);
    ++meeting.ready;
    while (!meeting.is_over) owner.turn(1);
  }));
  run_own_with(meeting, threads, [&] {
    if (!meeting.wait([&] { return meeting.ready == 1; }, rest)) return;
    Stopwatch watch;
    watch.begin();
    for (std::uint64_t k = 0; k < joiners; ++k) {
      OwnLateJoiner late(place);
      late.rti.subscribe_object_class_attributes(late.entity, late.states);
      late.rti.request_attribute_value_update(late.entity, late.states, {});
      if (!meeting.wait([&] { return late.valued == object_count; }, [&] { late.turn(1); })) return;
      if (late.is_spoilt) meeting.fail("a wrong value arrived");
      outcome.count += late.valued;
    }
    watch.end(outcome);
  });
  outcome.fault = meeting.fault();
  return outcome;
}

}  // namespace rink_driver
