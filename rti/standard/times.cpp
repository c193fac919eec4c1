// Conversions of logical times.
#include "rti/standard/times.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rink::standard {

namespace {

/// The core's last instant; the standard's final time is just above it.
const double last_instant = std::nextafter(std::numeric_limits<double>::max(), 0.0);
constexpr rti1516e::Integer64 exact_max = rti1516e::Integer64{1} << 53;

rti1516e::Integer64 integer(double value) {
  return value > static_cast<double>(exact_max)
             ? std::numeric_limits<rti1516e::Integer64>::max()
             : static_cast<rti1516e::Integer64>(std::ceil(value));
}
double real(double value) {
  return value >= last_instant ? std::numeric_limits<double>::max() : value;
}

}  // namespace

Times::Times(const std::wstring& implementation)
    : is_integer_(implementation == rti1516e::HLAinteger64TimeName) {
  if (!is_integer_ && !implementation.empty() && implementation != rti1516e::HLAfloat64TimeName)
    throw rti1516e::CouldNotCreateLogicalTimeFactory(
        implementation + L" is neither HLAfloat64Time nor HLAinteger64Time");
}

std::wstring Times::name() const {
  return is_integer_ ? rti1516e::HLAinteger64TimeName : rti1516e::HLAfloat64TimeName;
}

std::unique_ptr<rti1516e::LogicalTimeFactory> Times::factory() const {
  return std::unique_ptr<rti1516e::LogicalTimeFactory>(
      rti1516e::HLAlogicalTimeFactoryFactory::makeLogicalTimeFactory(name()).release());
}

std::unique_ptr<rti1516e::LogicalTime> Times::time(double value) const {
  if (is_integer_) return std::make_unique<rti1516e::HLAinteger64Time>(integer(value));
  return std::make_unique<rti1516e::HLAfloat64Time>(real(value));
}

double Times::number(const rti1516e::LogicalTime& time) const {
  if (time.implementationName() != name())
    throw rti1516e::InvalidLogicalTime(time.implementationName() + L" where " + name() +
                                       L" is due");
  if (time.isFinal()) return last_instant;
  if (!is_integer_) return dynamic_cast<const rti1516e::HLAfloat64Time&>(time).getTime();
  const rti1516e::Integer64 value = dynamic_cast<const rti1516e::HLAinteger64Time&>(time).getTime();
  if (value > exact_max)
    throw rti1516e::InvalidLogicalTime(L"an integer time is at most 2^53, not " + time.toString());
  return static_cast<double>(value);
}

void Times::assign(rti1516e::LogicalTime& result, double value) const { result = *time(value); }

double Times::number(const rti1516e::LogicalTimeInterval& interval) const {
  if (const auto* const found = dynamic_cast<const rti1516e::HLAfloat64Interval*>(&interval);
      found != nullptr && !is_integer_)
    return found->getInterval();
  const auto* const found = dynamic_cast<const rti1516e::HLAinteger64Interval*>(&interval);
  if (found == nullptr || !is_integer_ || found->getInterval() > exact_max)
    throw rti1516e::InvalidLookahead(interval.implementationName() + L" " + interval.toString() +
                                     L" is no interval of " + name());
  return static_cast<double>(found->getInterval());
}

void Times::assign(rti1516e::LogicalTimeInterval& interval, double value) const {
  if (is_integer_) interval = rti1516e::HLAinteger64Interval(integer(value));
  else interval = rti1516e::HLAfloat64Interval(value);
}

}  // namespace rink::standard
