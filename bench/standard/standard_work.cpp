// Federates of the standard's API that send, receive, advance and join.
#include "bench/standard/standard_work.h"

#include <RTI/NullFederateAmbassador.h>
#include <RTI/time/HLAfloat64Interval.h>
#include <RTI/time/HLAfloat64Time.h>

#include <memory>

#include "bench/standard/meeting.h"

// Headers of 2010 say what callbacks throw, and so must who overrides them.
#if __cplusplus < 201703L
#define RINK_DRIVER_THROWS throw(rti1516e::FederateInternalError)
#else
#define RINK_DRIVER_THROWS
#endif

namespace rink_driver {

namespace {

using namespace rti1516e;

VariableLengthData data_of(const State& state) { return VariableLengthData(&state, sizeof state); }

std::string narrow(const std::wstring& wide) {
  std::string text;
  for (const wchar_t each : wide) text.push_back(each < 128 ? static_cast<char>(each) : '?');
  return text;
}

/// A member of the execution "driver", which it creates if nobody has.
class Member : public NullFederateAmbassador {
 public:
  explicit Member(const StandardPlace& place)
      : rti(RTIambassadorFactory().createRTIambassador().release()) {
    rti->connect(*this, HLA_EVOKED, place.settings);
    try {
      rti->createFederationExecution(L"driver", place.model);
    } catch (const FederationExecutionAlreadyExists&) {
    }
    rti->joinFederationExecution(L"driver", L"driver", std::vector<std::wstring>{place.model});
    entity = rti->getObjectClassHandle(L"HLAobjectRoot.Entity");
    state = rti->getAttributeHandle(entity, L"state");
    states.insert(state);
  }
  ~Member() override {
    try {
      rti->resignFederationExecution(DELETE_OBJECTS_THEN_DIVEST);
      rti->disconnect();
    } catch (const Exception&) {
      // The run has its fault already.
    }
  }
  Member(const Member&) = delete;
  Member& operator=(const Member&) = delete;

  void turn() { rti->evokeMultipleCallbacks(0.0, 0.001); }
  void turn_or_rest() {
    if (!rti->evokeCallback(0.001)) return;
    rti->evokeMultipleCallbacks(0.0, 0.01);
  }
  void register_objects() {
    for (std::uint64_t i = 0; i < object_count; ++i)
      objects.push_back(rti->registerObjectInstance(entity));
  }
  void update(std::uint64_t object, std::uint64_t round) {
    AttributeHandleValueMap values;
    values[state] = data_of(State::of(object, round));
    rti->updateAttributeValues(objects[object], values, none);
  }

  const std::unique_ptr<RTIambassador> rti;
  const VariableLengthData none;
  ObjectClassHandle entity;
  AttributeHandle state;
  AttributeHandleSet states;
  std::vector<ObjectInstanceHandle> objects;
};

class Subscriber : public Member {
 public:
  using Member::Member;
  void discoverObjectInstance(ObjectInstanceHandle, ObjectClassHandle,
                              std::wstring const&) RINK_DRIVER_THROWS override {
    ++received.discovered;
  }
  void reflectAttributeValues(ObjectInstanceHandle, AttributeHandleValueMap const& values,
                              VariableLengthData const&, OrderType, TransportationType,
                              SupplementalReflectInfo) RINK_DRIVER_THROWS override {
    const auto found = values.find(state);
    if (found == values.end()) received.is_spoilt = true;
    else received.update(found->second.data(), found->second.size());
  }

  Received received;
};

/// Runs `act` in a thread; what it throws is the run's fault.
template <class Act>
std::thread thread_of(Meeting& meeting, Act act) {
  return std::thread([&meeting, act] {
    try {
      act();
    } catch (const Exception& exception) {
      meeting.fail(narrow(exception.what()));
    }
  });
}

/// The same in this thread, then waits for the others.
template <class Act>
void run_with(Meeting& meeting, std::vector<std::thread>& others, const Act& act) {
  try {
    act();
  } catch (const Exception& exception) {
    meeting.fail(narrow(exception.what()));
  }
  meeting.is_over = true;
  for (std::thread& each : others) each.join();
}

}  // namespace

Outcome standard_updates(const StandardPlace& place, int subscribers, std::uint64_t rounds) {
  Meeting meeting;
  Outcome outcome;
  std::vector<std::atomic<std::uint64_t>> arrived(static_cast<std::size_t>(subscribers));
  std::vector<std::thread> threads;
  for (auto& own : arrived)
    threads.push_back(thread_of(meeting, [&meeting, &place, &own] {
      Subscriber subscriber(place);
      subscriber.rti->subscribeObjectClassAttributes(subscriber.entity, subscriber.states);
      bool is_ready = false;
      while (!meeting.is_over) {
        subscriber.turn_or_rest();
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
  run_with(meeting, threads, [&] {
    Member owner(place);
    owner.rti->publishObjectClassAttributes(owner.entity, owner.states);
    owner.register_objects();
    if (!meeting.wait([&] { return meeting.ready == subscribers; }, [&] { owner.turn(); })) return;
    Stopwatch watch;
    watch.begin();
    for (std::uint64_t round = 0; round < rounds; ++round) {
      for (std::uint64_t i = 0; i < object_count; ++i) owner.update(i, round);
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

/// Sends pings and waits for each's pong, or the other way round.
class Player : public Member {
 public:
  Player(const StandardPlace& place, const wchar_t* sends, const wchar_t* receives)
      : Member(place),
        sent(rti->getInteractionClassHandle(std::wstring(L"HLAinteractionRoot.") + sends)),
        parameter(rti->getParameterHandle(sent, L"state")) {
    rti->publishInteractionClass(sent);
    rti->subscribeInteractionClass(
        rti->getInteractionClassHandle(std::wstring(L"HLAinteractionRoot.") + receives));
  }
  void receiveInteraction(InteractionClassHandle, ParameterHandleValueMap const& values,
                          VariableLengthData const&, OrderType, TransportationType,
                          SupplementalReceiveInfo) RINK_DRIVER_THROWS override {
    State state;
    if (values.size() != 1 ||
        !State::read(values.begin()->second.data(), values.begin()->second.size(), state) ||
        state.round != received)
      is_spoilt = true;
    ++received;
  }
  void turnInteractionsOn(InteractionClassHandle) RINK_DRIVER_THROWS override { is_heard = true; }
  void send(std::uint64_t round) {
    ParameterHandleValueMap values;
    values[parameter] = data_of(State::of(0, round));
    rti->sendInteraction(sent, values, none);
  }

  InteractionClassHandle sent;
  ParameterHandle parameter;
  std::uint64_t received = 0;
  bool is_spoilt = false, is_heard = false;
};

}  // namespace

Outcome standard_round_trips(const StandardPlace& place, std::uint64_t count) {
  Meeting meeting;
  Outcome outcome;
  std::vector<std::thread> threads;
  threads.push_back(thread_of(meeting, [&] {
    Player other(place, L"Pong", L"Ping");
    if (!meeting.wait([&] { return other.is_heard; }, [&] { other.rti->evokeCallback(0.01); }))
      return;
    ++meeting.ready;
    for (std::uint64_t round = 0; !meeting.is_over; ++round) {
      while (other.received <= round && !meeting.is_over) other.rti->evokeCallback(0.01);
      if (!meeting.is_over) other.send(round);
    }
  }));
  run_with(meeting, threads, [&] {
    Player one(place, L"Ping", L"Pong");
    if (!meeting.wait([&] { return one.is_heard && meeting.ready == 1; },
                      [&] { one.rti->evokeCallback(0.01); }))
      return;
    Stopwatch watch;
    watch.begin();
    for (std::uint64_t round = 0; round < count; ++round) {
      one.send(round);
      if (!meeting.wait([&] { return one.received > round; },
                        [&] { one.rti->evokeCallback(0.01); }))
        return;
    }
    watch.end(outcome);
    outcome.count = one.received;
    if (one.is_spoilt) meeting.fail("a wrong interaction arrived");
  });
  outcome.fault = meeting.fault();
  return outcome;
}

namespace {

class Clock : public Member {
 public:
  explicit Clock(const StandardPlace& place) : Member(place) {
    rti->enableTimeRegulation(HLAfloat64Interval(1.0));
    rti->enableTimeConstrained();
  }
  void timeRegulationEnabled(LogicalTime const&) RINK_DRIVER_THROWS override { ++enabled; }
  void timeConstrainedEnabled(LogicalTime const&) RINK_DRIVER_THROWS override { ++enabled; }
  void timeAdvanceGrant(LogicalTime const& time) RINK_DRIVER_THROWS override {
    now = dynamic_cast<HLAfloat64Time const&>(time).getTime();
    ++granted;
  }

  int enabled = 0;
  double now = 0.0;
  std::uint64_t granted = 0;
};

}  // namespace

Outcome standard_advances(const StandardPlace& place, int federates, std::uint64_t steps) {
  Meeting meeting;
  Outcome outcome;
  std::atomic<int> done(0);
  std::atomic<std::uint64_t> granted(0);
  std::vector<std::thread> threads;
  for (int k = 0; k < federates; ++k)
    threads.push_back(thread_of(meeting, [&] {
      Clock clock(place);
      const auto turn = [&] { clock.rti->evokeCallback(0.01); };
      if (!meeting.wait([&] { return clock.enabled == 2; }, turn)) return;
      ++meeting.ready;
      if (!meeting.wait([&] { return meeting.ready > federates; }, turn)) return;
      for (std::uint64_t step = 1; step <= steps; ++step) {
        const HLAfloat64Time next(static_cast<double>(step));
        clock.rti->timeAdvanceRequest(next);
        if (!meeting.wait([&] { return clock.granted == step; }, turn)) return;
        if (clock.now != static_cast<double>(step)) meeting.fail("a grant of another time");
      }
      granted += clock.granted;
      ++done;
      // Who leaves earlier would let the others run.
      meeting.wait([&] { return done == federates; }, turn);
    }));
  run_with(meeting, threads, [&] {
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

Outcome standard_joins(const StandardPlace& place, std::uint64_t count) {
  Meeting meeting;
  Outcome outcome;
  std::vector<std::thread> nobody;
  run_with(meeting, nobody, [&] {
    Member keeper(place);
    Stopwatch watch;
    watch.begin();
    for (; outcome.count < count; ++outcome.count) Member guest(place);
    watch.end(outcome);
  });
  outcome.fault = meeting.fault();
  return outcome;
}

namespace {

/// Gives a value whenever it is asked for one.
class Provider : public Member {
 public:
  using Member::Member;
  void provideAttributeValueUpdate(ObjectInstanceHandle object, AttributeHandleSet const&,
                                   VariableLengthData const&) RINK_DRIVER_THROWS override {
    for (std::uint64_t i = 0; i < object_count; ++i)
      if (objects[i] == object) return update(i, 0);
  }
};

/// Counts objects of which a value has come; a value may come twice.
class LateJoiner : public Member {
 public:
  using Member::Member;
  void reflectAttributeValues(ObjectInstanceHandle, AttributeHandleValueMap const& values,
                              VariableLengthData const&, OrderType, TransportationType,
                              SupplementalReflectInfo) RINK_DRIVER_THROWS override {
    State content;
    if (values.size() != 1 ||
        !State::read(values.begin()->second.data(), values.begin()->second.size(), content) ||
        content.object >= object_count || content.round != 0) {
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

Outcome standard_late_joiners(const StandardPlace& place, std::uint64_t joiners) {
  Meeting meeting;
  Outcome outcome;
  std::vector<std::thread> threads;
  threads.push_back(thread_of(meeting, [&] {
    Provider owner(place);
    owner.rti->publishObjectClassAttributes(owner.entity, owner.states);
    owner.register_objects();
    for (std::uint64_t i = 0; i < object_count; ++i) owner.update(i, 0);
    ++meeting.ready;
    while (!meeting.is_over) owner.turn_or_rest();
  }));
  run_with(meeting, threads, [&] {
    if (!meeting.wait([&] { return meeting.ready == 1; }, rest)) return;
    Stopwatch watch;
    watch.begin();
    for (std::uint64_t k = 0; k < joiners; ++k) {
      LateJoiner late(place);
      late.rti->subscribeObjectClassAttributes(late.entity, late.states);
      late.rti->requestAttributeValueUpdate(late.entity, late.states, late.none);
      if (!meeting.wait([&] { return late.valued == object_count; }, [&] { late.turn_or_rest(); }))
        return;
      if (late.is_spoilt) meeting.fail("a wrong value arrived");
      outcome.count += late.valued;
    }
    watch.end(outcome);
  });
  outcome.fault = meeting.fault();
  return outcome;
}

}  // namespace rink_driver
