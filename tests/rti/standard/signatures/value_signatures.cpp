// Handles, values, times and factories, as IEEE 1516.1-2010 declares them.
#include <type_traits>

#include "tests/rti/standard/signatures/has.h"

namespace rti1516e {
namespace {

using rink::standard::testing::has;

template <class Handle>
constexpr bool is_handle() {
  return has<Handle, bool() const>(&Handle::isValid) &&
         has<Handle, bool(Handle const&) const>(&Handle::operator==) &&
         has<Handle, bool(Handle const&) const>(&Handle::operator!=) &&
         has<Handle, bool(Handle const&) const>(&Handle::operator<) &&
         has<Handle, long() const>(&Handle::hash) &&
         has<Handle, VariableLengthData() const>(&Handle::encode) &&
         has<Handle, void(VariableLengthData&) const>(&Handle::encode) &&
         has<Handle, size_t(void*, size_t) const>(&Handle::encode) &&
         has<Handle, size_t() const>(&Handle::encodedLength) &&
         has<Handle, std::wstring() const>(&Handle::toString) &&
         std::is_default_constructible<Handle>::value && std::is_copy_assignable<Handle>::value;
}
static_assert(is_handle<FederateHandle>(), "FederateHandle");
static_assert(is_handle<ObjectClassHandle>(), "ObjectClassHandle");
static_assert(is_handle<InteractionClassHandle>(), "InteractionClassHandle");
static_assert(is_handle<ObjectInstanceHandle>(), "ObjectInstanceHandle");
static_assert(is_handle<AttributeHandle>(), "AttributeHandle");
static_assert(is_handle<ParameterHandle>(), "ParameterHandle");
static_assert(is_handle<DimensionHandle>(), "DimensionHandle");
static_assert(is_handle<MessageRetractionHandle>(), "MessageRetractionHandle");
static_assert(is_handle<RegionHandle>(), "RegionHandle");

static_assert(has<VariableLengthData, void const*() const>(&VariableLengthData::data), "data");
static_assert(has<VariableLengthData, size_t() const>(&VariableLengthData::size), "size");
static_assert(has<VariableLengthData, void(void const*, size_t)>(&VariableLengthData::setData),
              "setData");
static_assert(has<VariableLengthData, void(void*, size_t)>(&VariableLengthData::setDataPointer),
              "setDataPointer");
static_assert(has<VariableLengthData, void(void*, size_t, VariableLengthDataDeleteFunction)>(
                  &VariableLengthData::takeDataPointer),
              "takeDataPointer");

static_assert(has<RangeBounds, unsigned long() const>(&RangeBounds::getLowerBound),
              "getLowerBound");
static_assert(has<RangeBounds, unsigned long() const>(&RangeBounds::getUpperBound),
              "getUpperBound");
static_assert(has<RangeBounds, void(unsigned long)>(&RangeBounds::setLowerBound), "setLowerBound");
static_assert(has<RangeBounds, void(unsigned long)>(&RangeBounds::setUpperBound), "setUpperBound");

static_assert(has<RTIambassadorFactory, std::auto_ptr<RTIambassador>()>(
                  &RTIambassadorFactory::createRTIambassador),
              "createRTIambassador");

template <class Time, class Interval, class Value>
constexpr bool is_time() {
  return std::is_base_of<LogicalTime, Time>::value && has<Time, Value() const>(&Time::getTime) &&
         has<Time, void(Value)>(&Time::setTime) && std::is_convertible<Time, Value>::value &&
         std::is_constructible<Time, Value>::value &&
         std::is_constructible<Time, LogicalTime const&>::value &&
         std::is_base_of<LogicalTimeInterval, Interval>::value &&
         has<Interval, Value() const>(&Interval::getInterval) &&
         has<Interval, void(Value)>(&Interval::setInterval) &&
         std::is_convertible<Interval, Value>::value &&
         std::is_constructible<Interval, Value>::value &&
         std::is_constructible<Interval, LogicalTimeInterval const&>::value;
}
static_assert(is_time<HLAfloat64Time, HLAfloat64Interval, double>(), "HLAfloat64Time");
static_assert(is_time<HLAinteger64Time, HLAinteger64Interval, Integer64>(), "HLAinteger64Time");

static_assert(has<LogicalTime, void()>(&LogicalTime::setInitial), "setInitial");
static_assert(has<LogicalTime, bool() const>(&LogicalTime::isInitial), "isInitial");
static_assert(has<LogicalTime, void()>(&LogicalTime::setFinal), "setFinal");
static_assert(has<LogicalTime, bool() const>(&LogicalTime::isFinal), "isFinal");
static_assert(has<LogicalTime, bool(LogicalTime const&) const>(&LogicalTime::operator>),
              "operator>");
static_assert(has<LogicalTime, bool(LogicalTime const&) const>(&LogicalTime::operator<),
              "operator<");
static_assert(has<LogicalTime, bool(LogicalTime const&) const>(&LogicalTime::operator==),
              "operator==");
static_assert(has<LogicalTime, bool(LogicalTime const&) const>(&LogicalTime::operator>=),
              "operator>=");
static_assert(has<LogicalTime, bool(LogicalTime const&) const>(&LogicalTime::operator<=),
              "operator<=");
static_assert(has<LogicalTime, VariableLengthData() const>(&LogicalTime::encode), "encode");
static_assert(has<LogicalTime, size_t(void*, size_t) const>(&LogicalTime::encode), "encode");
static_assert(has<LogicalTime, size_t() const>(&LogicalTime::encodedLength), "encodedLength");
static_assert(has<LogicalTime, void(VariableLengthData const&)>(&LogicalTime::decode), "decode");
static_assert(has<LogicalTime, void(void*, size_t)>(&LogicalTime::decode), "decode");
static_assert(has<LogicalTime, std::wstring() const>(&LogicalTime::toString), "toString");
static_assert(has<LogicalTime, std::wstring() const>(&LogicalTime::implementationName),
              "implementationName");
static_assert(has<LogicalTime, LogicalTime&(LogicalTime const&)>(&LogicalTime::operator=),
              "operator=");
static_assert(has<LogicalTime, LogicalTime&(LogicalTimeInterval const&)>(&LogicalTime::operator+=),
              "operator+=");
static_assert(has<LogicalTime, LogicalTime&(LogicalTimeInterval const&)>(&LogicalTime::operator-=),
              "operator-=");

static_assert(has<LogicalTimeInterval, void()>(&LogicalTimeInterval::setZero), "setZero");
static_assert(has<LogicalTimeInterval, bool() const>(&LogicalTimeInterval::isZero), "isZero");
static_assert(has<LogicalTimeInterval, void()>(&LogicalTimeInterval::setEpsilon), "setEpsilon");
static_assert(has<LogicalTimeInterval, bool() const>(&LogicalTimeInterval::isEpsilon), "isEpsilon");
static_assert(has<LogicalTimeInterval, void(LogicalTime const&, LogicalTime const&)>(
                  &LogicalTimeInterval::setToDifference),
              "setToDifference");
static_assert(has<LogicalTimeInterval, bool(LogicalTimeInterval const&) const>(
                  &LogicalTimeInterval::operator>),
              "operator>");
static_assert(has<LogicalTimeInterval, bool(LogicalTimeInterval const&) const>(
                  &LogicalTimeInterval::operator<),
              "operator<");
static_assert(has<LogicalTimeInterval, bool(LogicalTimeInterval const&) const>(
                  &LogicalTimeInterval::operator==),
              "operator==");
static_assert(has<LogicalTimeInterval, bool(LogicalTimeInterval const&) const>(
                  &LogicalTimeInterval::operator>=),
              "operator>=");
static_assert(has<LogicalTimeInterval, bool(LogicalTimeInterval const&) const>(
                  &LogicalTimeInterval::operator<=),
              "operator<=");
static_assert(has<LogicalTimeInterval, VariableLengthData() const>(&LogicalTimeInterval::encode),
              "encode");
static_assert(has<LogicalTimeInterval, size_t(void*, size_t) const>(&LogicalTimeInterval::encode),
              "encode");
static_assert(has<LogicalTimeInterval, size_t() const>(&LogicalTimeInterval::encodedLength),
              "encodedLength");
static_assert(
    has<LogicalTimeInterval, void(VariableLengthData const&)>(&LogicalTimeInterval::decode),
    "decode");
static_assert(has<LogicalTimeInterval, void(void*, size_t)>(&LogicalTimeInterval::decode),
              "decode");
static_assert(has<LogicalTimeInterval, std::wstring() const>(&LogicalTimeInterval::toString),
              "toString");
static_assert(
    has<LogicalTimeInterval, std::wstring() const>(&LogicalTimeInterval::implementationName),
    "implementationName");
static_assert(has<LogicalTimeInterval, LogicalTimeInterval&(LogicalTimeInterval const&)>(
                  &LogicalTimeInterval::operator=),
              "operator=");
static_assert(has<LogicalTimeInterval, LogicalTimeInterval&(LogicalTimeInterval const&)>(
                  &LogicalTimeInterval::operator+=),
              "operator+=");
static_assert(has<LogicalTimeInterval, LogicalTimeInterval&(LogicalTimeInterval const&)>(
                  &LogicalTimeInterval::operator-=),
              "operator-=");

static_assert(
    has<LogicalTimeFactory, std::auto_ptr<LogicalTime>()>(&LogicalTimeFactory::makeInitial),
    "makeInitial");
static_assert(has<LogicalTimeFactory, std::auto_ptr<LogicalTime>()>(&LogicalTimeFactory::makeFinal),
              "makeFinal");
static_assert(
    has<LogicalTimeFactory, std::auto_ptr<LogicalTimeInterval>()>(&LogicalTimeFactory::makeZero),
    "makeZero");
static_assert(
    has<LogicalTimeFactory, std::auto_ptr<LogicalTimeInterval>()>(&LogicalTimeFactory::makeEpsilon),
    "makeEpsilon");
static_assert(has<LogicalTimeFactory, std::auto_ptr<LogicalTime>(VariableLengthData const&)>(
                  &LogicalTimeFactory::decodeLogicalTime),
              "decodeLogicalTime");
static_assert(has<LogicalTimeFactory, std::auto_ptr<LogicalTime>(void*, size_t)>(
                  &LogicalTimeFactory::decodeLogicalTime),
              "decodeLogicalTime");
static_assert(
    has<LogicalTimeFactory, std::auto_ptr<LogicalTimeInterval>(VariableLengthData const&)>(
        &LogicalTimeFactory::decodeLogicalTimeInterval),
    "decodeLogicalTimeInterval");
static_assert(has<LogicalTimeFactory, std::auto_ptr<LogicalTimeInterval>(void*, size_t)>(
                  &LogicalTimeFactory::decodeLogicalTimeInterval),
              "decodeLogicalTimeInterval");
static_assert(has<LogicalTimeFactory, std::wstring() const>(&LogicalTimeFactory::getName),
              "getName");

static_assert(has<HLAfloat64TimeFactory, std::auto_ptr<HLAfloat64Time>(double)>(
                  &HLAfloat64TimeFactory::makeLogicalTime),
              "makeLogicalTime");
static_assert(has<HLAfloat64TimeFactory, std::auto_ptr<HLAfloat64Interval>(double)>(
                  &HLAfloat64TimeFactory::makeLogicalTimeInterval),
              "makeLogicalTimeInterval");

static_assert(has<HLAinteger64TimeFactory, std::auto_ptr<HLAinteger64Time>(Integer64)>(
                  &HLAinteger64TimeFactory::makeLogicalTime),
              "makeLogicalTime");
static_assert(has<HLAinteger64TimeFactory, std::auto_ptr<HLAinteger64Interval>(Integer64)>(
                  &HLAinteger64TimeFactory::makeLogicalTimeInterval),
              "makeLogicalTimeInterval");

}  // namespace
}  // namespace rti1516e
