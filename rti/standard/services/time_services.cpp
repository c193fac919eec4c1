// Time management.
#include "rti/standard/services/time_services.h"

#include <cmath>

#include "rti/standard/handles.h"
#include "rti/standard/services/choices.h"

namespace rink::standard {

namespace {

/// The core may have been granted what the federate has not been told yet.
void check_not_advancing(const FederateState& state) {
  if (state.time.is_advancing) throw rti1516e::InTimeAdvancingState(L"wait for timeAdvanceGrant");
}
void check_not_enabling(const FederateState& state) {
  if (state.time.is_regulation_pending)
    throw rti1516e::RequestForTimeRegulationPending(L"wait for timeRegulationEnabled");
  if (state.time.is_constrained_pending)
    throw rti1516e::RequestForTimeConstrainedPending(L"wait for timeConstrainedEnabled");
}

template <class Request>
void advance(Federate& federate, const rti1516e::LogicalTime& time, const Request& request) {
  federate.call_at_once([&](rti::Ambassador& core, FederateState& state) {
    check_not_advancing(state);
    check_not_enabling(state);
    request(core, rti::LogicalTime(state.times.number(time)));
    state.time.is_advancing = true;
  });
}

/// GALT and LITS, which the RTI knows.
std::pair<double, double> bounds_of(Federate& federate) {
  std::pair<double, double> bounds;
  federate.ask(
      [](rti::Ambassador& core, FederateState& state) {
        state.answers.bounds.reset();
        core.query_time_bounds();
      },
      [&](const Answers& answers) {
        bounds = answers.bounds.value_or(bounds);
        return answers.bounds.has_value();
      });
  return bounds;
}

/// False if nobody sets a bound.
bool assign_bound(Federate& federate, rti1516e::LogicalTime& time, double bound) {
  if (!std::isfinite(bound)) return false;
  federate.call([&](rti::Ambassador&, FederateState& state) { state.times.assign(time, bound); });
  return true;
}

}  // namespace

void TimeServices::enableTimeRegulation(rti1516e::LogicalTimeInterval const& theLookahead) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    check_not_advancing(state);
    if (state.time.is_regulation_pending) check_not_enabling(state);
    core.enable_time_regulation(state.times.number(theLookahead));
    state.time.is_regulation_pending = true;
  });
}

void TimeServices::disableTimeRegulation() {
  federate().call([&](rti::Ambassador& core, FederateState&) { core.disable_time_regulation(); });
}

void TimeServices::enableTimeConstrained() {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    check_not_advancing(state);
    if (state.time.is_constrained_pending)
      throw rti1516e::RequestForTimeConstrainedPending(L"wait for timeConstrainedEnabled");
    core.enable_time_constrained();
    state.time.is_constrained_pending = true;
  });
}

void TimeServices::disableTimeConstrained() {
  federate().call([&](rti::Ambassador& core, FederateState&) { core.disable_time_constrained(); });
}

void TimeServices::timeAdvanceRequest(rti1516e::LogicalTime const& theTime) {
  advance(federate(), theTime,
          [](rti::Ambassador& core, rti::LogicalTime time) { core.time_advance_request(time); });
}

void TimeServices::timeAdvanceRequestAvailable(rti1516e::LogicalTime const& theTime) {
  advance(federate(), theTime, [](rti::Ambassador& core, rti::LogicalTime time) {
    core.time_advance_request_available(time);
  });
}

void TimeServices::nextMessageRequest(rti1516e::LogicalTime const& theTime) {
  advance(federate(), theTime,
          [](rti::Ambassador& core, rti::LogicalTime time) { core.next_message_request(time); });
}

void TimeServices::nextMessageRequestAvailable(rti1516e::LogicalTime const& theTime) {
  advance(federate(), theTime, [](rti::Ambassador& core, rti::LogicalTime time) {
    core.next_message_request_available(time);
  });
}

void TimeServices::flushQueueRequest(rti1516e::LogicalTime const& theTime) {
  advance(federate(), theTime,
          [](rti::Ambassador& core, rti::LogicalTime time) { core.flush_queue_request(time); });
}

void TimeServices::enableAsynchronousDelivery() {
  federate().call(
      [&](rti::Ambassador& core, FederateState&) { core.enable_asynchronous_delivery(); });
}

void TimeServices::disableAsynchronousDelivery() {
  federate().call(
      [&](rti::Ambassador& core, FederateState&) { core.disable_asynchronous_delivery(); });
}

bool TimeServices::queryGALT(rti1516e::LogicalTime& theTime) {
  return assign_bound(federate(), theTime, bounds_of(federate()).first);
}

void TimeServices::queryLogicalTime(rti1516e::LogicalTime& theTime) {
  federate().call(
      [&](rti::Ambassador&, FederateState& state) { state.times.assign(theTime, state.time.now); });
}

bool TimeServices::queryLITS(rti1516e::LogicalTime& theTime) {
  return assign_bound(federate(), theTime, bounds_of(federate()).second);
}

void TimeServices::modifyLookahead(rti1516e::LogicalTimeInterval const& theLookahead) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    check_not_advancing(state);
    core.modify_lookahead(state.times.number(theLookahead));
  });
}

void TimeServices::queryLookahead(rti1516e::LogicalTimeInterval& interval) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    state.times.assign(interval, core.query_lookahead());
  });
}

void TimeServices::retract(rti1516e::MessageRetractionHandle theHandle) {
  federate().call([&](rti::Ambassador& core, FederateState& state) {
    core.retract(to_core(theHandle));
    state.retract(to_core(theHandle));
  });
}

void TimeServices::changeAttributeOrderType(rti1516e::ObjectInstanceHandle theObject,
                                            rti1516e::AttributeHandleSet const& theAttributes,
                                            rti1516e::OrderType theType) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::AttributeSet attributes = to_core(theAttributes);
    const rti::Order order = to_core<rti1516e::RTIinternalError>(theType);
    core.change_attribute_order_type(to_core(theObject), attributes, order);
  });
}

void TimeServices::changeInteractionOrderType(rti1516e::InteractionClassHandle theClass,
                                              rti1516e::OrderType theType) {
  federate().call([&](rti::Ambassador& core, FederateState&) {
    const rti::Order order = to_core<rti1516e::RTIinternalError>(theType);
    core.change_interaction_order_type(to_core(theClass), order);
  });
}

}  // namespace rink::standard
