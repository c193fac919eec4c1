// Logical times that are integers.
#include <limits>
#include <ostream>
#include <string>

#include "rti/standard/time/time_values.h"

namespace rti1516e {

using rink::standard::same_kind;

class HLAinteger64TimeImpl {
 public:
  Integer64 value;
};
class HLAinteger64IntervalImpl {
 public:
  Integer64 value;
};

namespace {

const HLAinteger64Time& integer64_time(LogicalTime const& value) {
  return same_kind<HLAinteger64Time, InvalidLogicalTime>(value, HLAinteger64TimeName);
}
const HLAinteger64Interval& integer64_interval(LogicalTimeInterval const& value) {
  return same_kind<HLAinteger64Interval, InvalidLogicalTimeInterval>(value,
                                                                     L"HLAinteger64Interval");
}
constexpr Integer64 integer64_max = std::numeric_limits<Integer64>::max();
constexpr Integer64 integer64_epsilon = 1;

}  // namespace

HLAinteger64Time::HLAinteger64Time() : _impl(new HLAinteger64TimeImpl{0}) {}
HLAinteger64Time::HLAinteger64Time(Integer64 value) : _impl(new HLAinteger64TimeImpl{value}) {}
HLAinteger64Time::HLAinteger64Time(LogicalTime const& value)
    : HLAinteger64Time(integer64_time(value).getTime()) {}
HLAinteger64Time::HLAinteger64Time(HLAinteger64Time const& value)
    : LogicalTime(), _impl(new HLAinteger64TimeImpl(*value._impl)) {}
HLAinteger64Time::~HLAinteger64Time() { delete _impl; }

void HLAinteger64Time::setInitial() { setTime(0); }
bool HLAinteger64Time::isInitial() const { return getTime() == 0; }
void HLAinteger64Time::setFinal() { setTime(integer64_max); }
bool HLAinteger64Time::isFinal() const { return getTime() == integer64_max; }
LogicalTime& HLAinteger64Time::operator=(LogicalTime const& value) {
  setTime(integer64_time(value).getTime());
  return *this;
}
HLAinteger64Time& HLAinteger64Time::operator=(HLAinteger64Time const& value) {
  if (this != &value) setTime(value.getTime());
  return *this;
}
LogicalTime& HLAinteger64Time::operator+=(LogicalTimeInterval const& value) {
  setTime(rink::standard::sum(getTime(), integer64_interval(value).getInterval()));
  return *this;
}
LogicalTime& HLAinteger64Time::operator-=(LogicalTimeInterval const& value) {
  setTime(rink::standard::difference(getTime(), integer64_interval(value).getInterval()));
  return *this;
}
bool HLAinteger64Time::operator>(LogicalTime const& value) const {
  return getTime() > integer64_time(value).getTime();
}
bool HLAinteger64Time::operator<(LogicalTime const& value) const {
  return getTime() < integer64_time(value).getTime();
}
bool HLAinteger64Time::operator==(LogicalTime const& value) const {
  return getTime() == integer64_time(value).getTime();
}
bool HLAinteger64Time::operator>=(LogicalTime const& value) const {
  return getTime() >= integer64_time(value).getTime();
}
bool HLAinteger64Time::operator<=(LogicalTime const& value) const {
  return getTime() <= integer64_time(value).getTime();
}
VariableLengthData HLAinteger64Time::encode() const {
  return rink::standard::encode_time(getTime());
}
size_t HLAinteger64Time::encode(void* buffer, size_t bufferSize) const {
  return rink::standard::encode_time(getTime(), buffer, bufferSize);
}
size_t HLAinteger64Time::encodedLength() const { return rink::standard::encoded_time_size; }
void HLAinteger64Time::decode(VariableLengthData const& encodedValue) {
  setTime(rink::standard::decode_time<Integer64>(encodedValue.data(), encodedValue.size()));
}
void HLAinteger64Time::decode(void* buffer, size_t bufferSize) {
  setTime(rink::standard::decode_time<Integer64>(buffer, bufferSize));
}
std::wstring HLAinteger64Time::toString() const { return std::to_wstring(getTime()); }
std::wstring HLAinteger64Time::implementationName() const { return HLAinteger64TimeName; }
Integer64 HLAinteger64Time::getTime() const { return _impl->value; }
void HLAinteger64Time::setTime(Integer64 value) { _impl->value = value; }
HLAinteger64Time::operator Integer64() const { return _impl->value; }

HLAinteger64Interval::HLAinteger64Interval() : _impl(new HLAinteger64IntervalImpl{0}) {}
HLAinteger64Interval::HLAinteger64Interval(Integer64 value)
    : _impl(new HLAinteger64IntervalImpl{value}) {}
HLAinteger64Interval::HLAinteger64Interval(LogicalTimeInterval const& value)
    : HLAinteger64Interval(integer64_interval(value).getInterval()) {}
HLAinteger64Interval::HLAinteger64Interval(HLAinteger64Interval const& value)
    : LogicalTimeInterval(), _impl(new HLAinteger64IntervalImpl(*value._impl)) {}
HLAinteger64Interval::~HLAinteger64Interval() { delete _impl; }

void HLAinteger64Interval::setZero() { setInterval(0); }
bool HLAinteger64Interval::isZero() const { return getInterval() == 0; }
void HLAinteger64Interval::setEpsilon() { setInterval(integer64_epsilon); }
bool HLAinteger64Interval::isEpsilon() const { return getInterval() == integer64_epsilon; }
void HLAinteger64Interval::setToDifference(LogicalTime const& minuend,
                                           LogicalTime const& subtrahend) {
  setInterval(rink::standard::difference(integer64_time(minuend).getTime(),
                                         integer64_time(subtrahend).getTime()));
}
LogicalTimeInterval& HLAinteger64Interval::operator=(LogicalTimeInterval const& value) {
  setInterval(integer64_interval(value).getInterval());
  return *this;
}
HLAinteger64Interval& HLAinteger64Interval::operator=(HLAinteger64Interval const& value) {
  if (this != &value) setInterval(value.getInterval());
  return *this;
}
LogicalTimeInterval& HLAinteger64Interval::operator+=(LogicalTimeInterval const& value) {
  setInterval(rink::standard::sum(getInterval(), integer64_interval(value).getInterval()));
  return *this;
}
LogicalTimeInterval& HLAinteger64Interval::operator-=(LogicalTimeInterval const& value) {
  setInterval(rink::standard::difference(getInterval(), integer64_interval(value).getInterval()));
  return *this;
}
bool HLAinteger64Interval::operator>(LogicalTimeInterval const& value) const {
  return getInterval() > integer64_interval(value).getInterval();
}
bool HLAinteger64Interval::operator<(LogicalTimeInterval const& value) const {
  return getInterval() < integer64_interval(value).getInterval();
}
bool HLAinteger64Interval::operator==(LogicalTimeInterval const& value) const {
  return getInterval() == integer64_interval(value).getInterval();
}
bool HLAinteger64Interval::operator>=(LogicalTimeInterval const& value) const {
  return getInterval() >= integer64_interval(value).getInterval();
}
bool HLAinteger64Interval::operator<=(LogicalTimeInterval const& value) const {
  return getInterval() <= integer64_interval(value).getInterval();
}
VariableLengthData HLAinteger64Interval::encode() const {
  return rink::standard::encode_time(getInterval());
}
size_t HLAinteger64Interval::encode(void* buffer, size_t bufferSize) const {
  return rink::standard::encode_time(getInterval(), buffer, bufferSize);
}
size_t HLAinteger64Interval::encodedLength() const { return rink::standard::encoded_time_size; }
void HLAinteger64Interval::decode(VariableLengthData const& encodedValue) {
  setInterval(rink::standard::decode_time<Integer64>(encodedValue.data(), encodedValue.size()));
}
void HLAinteger64Interval::decode(void* buffer, size_t bufferSize) {
  setInterval(rink::standard::decode_time<Integer64>(buffer, bufferSize));
}
std::wstring HLAinteger64Interval::toString() const { return std::to_wstring(getInterval()); }
std::wstring HLAinteger64Interval::implementationName() const { return L"HLAinteger64Interval"; }
Integer64 HLAinteger64Interval::getInterval() const { return _impl->value; }
void HLAinteger64Interval::setInterval(Integer64 value) { _impl->value = value; }
HLAinteger64Interval::operator Integer64() const { return _impl->value; }

HLAinteger64TimeFactory::HLAinteger64TimeFactory() = default;
HLAinteger64TimeFactory::~HLAinteger64TimeFactory() = default;
std::auto_ptr<HLAinteger64Time> HLAinteger64TimeFactory::makeLogicalTime(Integer64 value) {
  return std::auto_ptr<HLAinteger64Time>(new HLAinteger64Time(value));
}
std::auto_ptr<LogicalTime> HLAinteger64TimeFactory::makeInitial() {
  return std::auto_ptr<LogicalTime>(new HLAinteger64Time);
}
std::auto_ptr<LogicalTime> HLAinteger64TimeFactory::makeFinal() {
  return std::auto_ptr<LogicalTime>(new HLAinteger64Time(integer64_max));
}
std::auto_ptr<HLAinteger64Interval> HLAinteger64TimeFactory::makeLogicalTimeInterval(
    Integer64 value) {
  return std::auto_ptr<HLAinteger64Interval>(new HLAinteger64Interval(value));
}
std::auto_ptr<LogicalTimeInterval> HLAinteger64TimeFactory::makeZero() {
  return std::auto_ptr<LogicalTimeInterval>(new HLAinteger64Interval);
}
std::auto_ptr<LogicalTimeInterval> HLAinteger64TimeFactory::makeEpsilon() {
  return std::auto_ptr<LogicalTimeInterval>(new HLAinteger64Interval(integer64_epsilon));
}
std::auto_ptr<LogicalTime> HLAinteger64TimeFactory::decodeLogicalTime(
    VariableLengthData const& encodedLogicalTime) {
  std::auto_ptr<LogicalTime> time(new HLAinteger64Time);
  time->decode(encodedLogicalTime);
  return time;
}
std::auto_ptr<LogicalTime> HLAinteger64TimeFactory::decodeLogicalTime(void* buffer,
                                                                      size_t bufferSize) {
  std::auto_ptr<LogicalTime> time(new HLAinteger64Time);
  time->decode(buffer, bufferSize);
  return time;
}
std::auto_ptr<LogicalTimeInterval> HLAinteger64TimeFactory::decodeLogicalTimeInterval(
    VariableLengthData const& encodedValue) {
  std::auto_ptr<LogicalTimeInterval> interval(new HLAinteger64Interval);
  interval->decode(encodedValue);
  return interval;
}
std::auto_ptr<LogicalTimeInterval> HLAinteger64TimeFactory::decodeLogicalTimeInterval(
    void* buffer, size_t bufferSize) {
  std::auto_ptr<LogicalTimeInterval> interval(new HLAinteger64Interval);
  interval->decode(buffer, bufferSize);
  return interval;
}
std::wstring HLAinteger64TimeFactory::getName() const { return HLAinteger64TimeName; }

}  // namespace rti1516e
