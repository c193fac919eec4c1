// Logical times that are doubles.
#include <limits>
#include <ostream>
#include <string>

#include "rti/standard/time/time_values.h"

namespace rti1516e {

using rink::standard::same_kind;

class HLAfloat64TimeImpl {
 public:
  double value;
};
class HLAfloat64IntervalImpl {
 public:
  double value;
};

namespace {

const HLAfloat64Time& float64_time(LogicalTime const& value) {
  return same_kind<HLAfloat64Time, InvalidLogicalTime>(value, HLAfloat64TimeName);
}
const HLAfloat64Interval& float64_interval(LogicalTimeInterval const& value) {
  return same_kind<HLAfloat64Interval, InvalidLogicalTimeInterval>(value, L"HLAfloat64Interval");
}
constexpr double float64_max = std::numeric_limits<double>::max();
constexpr double float64_epsilon = std::numeric_limits<double>::denorm_min();

}  // namespace

HLAfloat64Time::HLAfloat64Time() : _impl(new HLAfloat64TimeImpl{0.0}) {}
HLAfloat64Time::HLAfloat64Time(double const& value) : _impl(new HLAfloat64TimeImpl{value}) {}
HLAfloat64Time::HLAfloat64Time(LogicalTime const& value)
    : HLAfloat64Time(float64_time(value).getTime()) {}
HLAfloat64Time::HLAfloat64Time(HLAfloat64Time const& value)
    : LogicalTime(), _impl(new HLAfloat64TimeImpl(*value._impl)) {}
HLAfloat64Time::~HLAfloat64Time() { delete _impl; }

void HLAfloat64Time::setInitial() { setTime(0.0); }
bool HLAfloat64Time::isInitial() const { return getTime() == 0.0; }
void HLAfloat64Time::setFinal() { setTime(float64_max); }
bool HLAfloat64Time::isFinal() const { return getTime() == float64_max; }
LogicalTime& HLAfloat64Time::operator=(LogicalTime const& value) {
  setTime(float64_time(value).getTime());
  return *this;
}
HLAfloat64Time& HLAfloat64Time::operator=(HLAfloat64Time const& value) {
  if (this != &value) setTime(value.getTime());
  return *this;
}
LogicalTime& HLAfloat64Time::operator+=(LogicalTimeInterval const& value) {
  setTime(rink::standard::sum(getTime(), float64_interval(value).getInterval()));
  return *this;
}
LogicalTime& HLAfloat64Time::operator-=(LogicalTimeInterval const& value) {
  setTime(rink::standard::difference(getTime(), float64_interval(value).getInterval()));
  return *this;
}
bool HLAfloat64Time::operator>(LogicalTime const& value) const {
  return getTime() > float64_time(value).getTime();
}
bool HLAfloat64Time::operator<(LogicalTime const& value) const {
  return getTime() < float64_time(value).getTime();
}
bool HLAfloat64Time::operator==(LogicalTime const& value) const {
  return getTime() == float64_time(value).getTime();
}
bool HLAfloat64Time::operator>=(LogicalTime const& value) const {
  return getTime() >= float64_time(value).getTime();
}
bool HLAfloat64Time::operator<=(LogicalTime const& value) const {
  return getTime() <= float64_time(value).getTime();
}
VariableLengthData HLAfloat64Time::encode() const { return rink::standard::encode_time(getTime()); }
size_t HLAfloat64Time::encode(void* buffer, size_t bufferSize) const {
  return rink::standard::encode_time(getTime(), buffer, bufferSize);
}
size_t HLAfloat64Time::encodedLength() const { return rink::standard::encoded_time_size; }
void HLAfloat64Time::decode(VariableLengthData const& encodedValue) {
  setTime(rink::standard::decode_time<double>(encodedValue.data(), encodedValue.size()));
}
void HLAfloat64Time::decode(void* buffer, size_t bufferSize) {
  setTime(rink::standard::decode_time<double>(buffer, bufferSize));
}
std::wstring HLAfloat64Time::toString() const { return rink::standard::shortest_text(getTime()); }
std::wstring HLAfloat64Time::implementationName() const { return HLAfloat64TimeName; }
double HLAfloat64Time::getTime() const { return _impl->value; }
void HLAfloat64Time::setTime(double value) { _impl->value = value; }
HLAfloat64Time::operator double() const { return _impl->value; }

HLAfloat64Interval::HLAfloat64Interval() : _impl(new HLAfloat64IntervalImpl{0.0}) {}
HLAfloat64Interval::HLAfloat64Interval(double value) : _impl(new HLAfloat64IntervalImpl{value}) {}
HLAfloat64Interval::HLAfloat64Interval(LogicalTimeInterval const& value)
    : HLAfloat64Interval(float64_interval(value).getInterval()) {}
HLAfloat64Interval::HLAfloat64Interval(HLAfloat64Interval const& value)
    : LogicalTimeInterval(), _impl(new HLAfloat64IntervalImpl(*value._impl)) {}
HLAfloat64Interval::~HLAfloat64Interval() { delete _impl; }

void HLAfloat64Interval::setZero() { setInterval(0.0); }
bool HLAfloat64Interval::isZero() const { return getInterval() == 0.0; }
void HLAfloat64Interval::setEpsilon() { setInterval(float64_epsilon); }
bool HLAfloat64Interval::isEpsilon() const { return getInterval() == float64_epsilon; }
void HLAfloat64Interval::setToDifference(LogicalTime const& minuend,
                                         LogicalTime const& subtrahend) {
  setInterval(rink::standard::difference(float64_time(minuend).getTime(),
                                         float64_time(subtrahend).getTime()));
}
LogicalTimeInterval& HLAfloat64Interval::operator=(LogicalTimeInterval const& value) {
  setInterval(float64_interval(value).getInterval());
  return *this;
}
HLAfloat64Interval& HLAfloat64Interval::operator=(HLAfloat64Interval const& value) {
  if (this != &value) setInterval(value.getInterval());
  return *this;
}
LogicalTimeInterval& HLAfloat64Interval::operator+=(LogicalTimeInterval const& value) {
  setInterval(rink::standard::sum(getInterval(), float64_interval(value).getInterval()));
  return *this;
}
LogicalTimeInterval& HLAfloat64Interval::operator-=(LogicalTimeInterval const& value) {
  setInterval(rink::standard::difference(getInterval(), float64_interval(value).getInterval()));
  return *this;
}
bool HLAfloat64Interval::operator>(LogicalTimeInterval const& value) const {
  return getInterval() > float64_interval(value).getInterval();
}
bool HLAfloat64Interval::operator<(LogicalTimeInterval const& value) const {
  return getInterval() < float64_interval(value).getInterval();
}
bool HLAfloat64Interval::operator==(LogicalTimeInterval const& value) const {
  return getInterval() == float64_interval(value).getInterval();
}
bool HLAfloat64Interval::operator>=(LogicalTimeInterval const& value) const {
  return getInterval() >= float64_interval(value).getInterval();
}
bool HLAfloat64Interval::operator<=(LogicalTimeInterval const& value) const {
  return getInterval() <= float64_interval(value).getInterval();
}
VariableLengthData HLAfloat64Interval::encode() const {
  return rink::standard::encode_time(getInterval());
}
size_t HLAfloat64Interval::encode(void* buffer, size_t bufferSize) const {
  return rink::standard::encode_time(getInterval(), buffer, bufferSize);
}
size_t HLAfloat64Interval::encodedLength() const { return rink::standard::encoded_time_size; }
void HLAfloat64Interval::decode(VariableLengthData const& encodedValue) {
  setInterval(rink::standard::decode_time<double>(encodedValue.data(), encodedValue.size()));
}
void HLAfloat64Interval::decode(void* buffer, size_t bufferSize) {
  setInterval(rink::standard::decode_time<double>(buffer, bufferSize));
}
std::wstring HLAfloat64Interval::toString() const {
  return rink::standard::shortest_text(getInterval());
}
std::wstring HLAfloat64Interval::implementationName() const { return L"HLAfloat64Interval"; }
double HLAfloat64Interval::getInterval() const { return _impl->value; }
void HLAfloat64Interval::setInterval(double value) { _impl->value = value; }
HLAfloat64Interval::operator double() const { return _impl->value; }

HLAfloat64TimeFactory::HLAfloat64TimeFactory() = default;
HLAfloat64TimeFactory::~HLAfloat64TimeFactory() = default;
std::auto_ptr<HLAfloat64Time> HLAfloat64TimeFactory::makeLogicalTime(double value) {
  return std::auto_ptr<HLAfloat64Time>(new HLAfloat64Time(value));
}
std::auto_ptr<LogicalTime> HLAfloat64TimeFactory::makeInitial() {
  return std::auto_ptr<LogicalTime>(new HLAfloat64Time);
}
std::auto_ptr<LogicalTime> HLAfloat64TimeFactory::makeFinal() {
  return std::auto_ptr<LogicalTime>(new HLAfloat64Time(float64_max));
}
std::auto_ptr<HLAfloat64Interval> HLAfloat64TimeFactory::makeLogicalTimeInterval(double value) {
  return std::auto_ptr<HLAfloat64Interval>(new HLAfloat64Interval(value));
}
std::auto_ptr<LogicalTimeInterval> HLAfloat64TimeFactory::makeZero() {
  return std::auto_ptr<LogicalTimeInterval>(new HLAfloat64Interval);
}
std::auto_ptr<LogicalTimeInterval> HLAfloat64TimeFactory::makeEpsilon() {
  return std::auto_ptr<LogicalTimeInterval>(new HLAfloat64Interval(float64_epsilon));
}
std::auto_ptr<LogicalTime> HLAfloat64TimeFactory::decodeLogicalTime(
    VariableLengthData const& encodedLogicalTime) {
  std::auto_ptr<LogicalTime> time(new HLAfloat64Time);
  time->decode(encodedLogicalTime);
  return time;
}
std::auto_ptr<LogicalTime> HLAfloat64TimeFactory::decodeLogicalTime(void* buffer,
                                                                    size_t bufferSize) {
  std::auto_ptr<LogicalTime> time(new HLAfloat64Time);
  time->decode(buffer, bufferSize);
  return time;
}
std::auto_ptr<LogicalTimeInterval> HLAfloat64TimeFactory::decodeLogicalTimeInterval(
    VariableLengthData const& encodedValue) {
  std::auto_ptr<LogicalTimeInterval> interval(new HLAfloat64Interval);
  interval->decode(encodedValue);
  return interval;
}
std::auto_ptr<LogicalTimeInterval> HLAfloat64TimeFactory::decodeLogicalTimeInterval(
    void* buffer, size_t bufferSize) {
  std::auto_ptr<LogicalTimeInterval> interval(new HLAfloat64Interval);
  interval->decode(buffer, bufferSize);
  return interval;
}
std::wstring HLAfloat64TimeFactory::getName() const { return HLAfloat64TimeName; }

}  // namespace rti1516e
