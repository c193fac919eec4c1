// Makes times that are doubles.
#pragma once

#include <RTI/LogicalTimeFactory.h>
#include <RTI/OwningPointers.h>

#include <memory>
#include <string>

namespace rti1516e {

class HLAfloat64Time;
class HLAfloat64Interval;

const std::wstring HLAfloat64TimeName(L"HLAfloat64Time");

RINK_BEGIN_OWNING_POINTERS
class RTI_EXPORT HLAfloat64TimeFactory : public LogicalTimeFactory {
 public:
  HLAfloat64TimeFactory();
  ~HLAfloat64TimeFactory() override;

  virtual std::auto_ptr<HLAfloat64Time> makeLogicalTime(double value);
  std::auto_ptr<LogicalTime> makeInitial() override;
  std::auto_ptr<LogicalTime> makeFinal() override;
  virtual std::auto_ptr<HLAfloat64Interval> makeLogicalTimeInterval(double value);
  std::auto_ptr<LogicalTimeInterval> makeZero() override;
  std::auto_ptr<LogicalTimeInterval> makeEpsilon() override;
  std::auto_ptr<LogicalTime> decodeLogicalTime(
      VariableLengthData const& encodedLogicalTime) override;
  std::auto_ptr<LogicalTime> decodeLogicalTime(void* buffer, size_t bufferSize) override;
  std::auto_ptr<LogicalTimeInterval> decodeLogicalTimeInterval(
      VariableLengthData const& encodedValue) override;
  std::auto_ptr<LogicalTimeInterval> decodeLogicalTimeInterval(void* buffer,
                                                               size_t bufferSize) override;
  std::wstring getName() const override;
};
RINK_END_OWNING_POINTERS

}  // namespace rti1516e
