// Logical times of any kind: what they print, and the factories by name.
#include <ostream>

#include "rti/standard/standard_headers.h"

namespace rti1516e {

LogicalTime::~LogicalTime() = default;
LogicalTimeInterval::~LogicalTimeInterval() = default;
LogicalTimeFactory::~LogicalTimeFactory() = default;

std::wostream& operator<<(std::wostream& stream, LogicalTime const& time) {
  return stream << time.toString();
}
std::wostream& operator<<(std::wostream& stream, LogicalTimeInterval const& interval) {
  return stream << interval.toString();
}

std::auto_ptr<LogicalTimeFactory> HLAlogicalTimeFactoryFactory::makeLogicalTimeFactory(
    std::wstring const& implementationName) {
  if (implementationName.empty() || implementationName == HLAfloat64TimeName)
    return std::auto_ptr<LogicalTimeFactory>(new HLAfloat64TimeFactory);
  if (implementationName == HLAinteger64TimeName)
    return std::auto_ptr<LogicalTimeFactory>(new HLAinteger64TimeFactory);
  return std::auto_ptr<LogicalTimeFactory>();
}
std::auto_ptr<LogicalTimeFactory> LogicalTimeFactoryFactory::makeLogicalTimeFactory(
    std::wstring const& implementationName) {
  return HLAlogicalTimeFactoryFactory::makeLogicalTimeFactory(implementationName);
}

}  // namespace rti1516e
