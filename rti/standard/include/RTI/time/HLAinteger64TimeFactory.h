// Makes times that are integers.
#pragma once

#include <RTI/LogicalTimeFactory.h>
#include <RTI/OwningPointers.h>
#include <RTI/encoding/EncodingConfig.h>

#include <memory>
#include <string>

namespace rti1516e {

class HLAinteger64Time;
class HLAinteger64Interval;

const std::wstring HLAinteger64TimeName(L"HLAinteger64Time");

RINK_BEGIN_OWNING_POINTERS
class RTI_EXPORT HLAinteger64TimeFactory : public LogicalTimeFactory {
 public:
  HLAinteger64TimeFactory();
  ~HLAinteger64TimeFactory() override;

  virtual std::auto_ptr<HLAinteger64Time> makeLogicalTime(Integer64 value);
  std::auto_ptr<LogicalTime> makeInitial() override;
  std::auto_ptr<LogicalTime> makeFinal() override;
  virtual std::auto_ptr<HLAinteger64Interval> makeLogicalTimeInterval(Integer64 value);
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
