// Makes times of one kind; and the factory of a kind by its name.
#pragma once

#include <RTI/Exception.h>
#include <RTI/LogicalTime.h>
#include <RTI/LogicalTimeInterval.h>
#include <RTI/OwningPointers.h>
#include <RTI/SpecificConfig.h>

#include <memory>
#include <string>

namespace rti1516e {

RINK_BEGIN_OWNING_POINTERS
class RTI_EXPORT LogicalTimeFactory {
 public:
  virtual ~LogicalTimeFactory() = 0;

  virtual std::auto_ptr<LogicalTime> makeInitial() = 0;
  virtual std::auto_ptr<LogicalTime> makeFinal() = 0;
  virtual std::auto_ptr<LogicalTimeInterval> makeZero() = 0;
  virtual std::auto_ptr<LogicalTimeInterval> makeEpsilon() = 0;
  virtual std::auto_ptr<LogicalTime> decodeLogicalTime(
      VariableLengthData const& encodedLogicalTime) = 0;
  virtual std::auto_ptr<LogicalTime> decodeLogicalTime(void* buffer, size_t bufferSize) = 0;
  virtual std::auto_ptr<LogicalTimeInterval> decodeLogicalTimeInterval(
      VariableLengthData const& encodedValue) = 0;
  virtual std::auto_ptr<LogicalTimeInterval> decodeLogicalTimeInterval(void* buffer,
                                                                       size_t bufferSize) = 0;
  virtual std::wstring getName() const = 0;
};

/// Of the kinds that the standard has; a null pointer for another name.
class RTI_EXPORT HLAlogicalTimeFactoryFactory {
 public:
  static std::auto_ptr<LogicalTimeFactory> makeLogicalTimeFactory(
      std::wstring const& implementationName);
};

class RTI_EXPORT_FEDTIME LogicalTimeFactoryFactory {
 public:
  static std::auto_ptr<LogicalTimeFactory> makeLogicalTimeFactory(
      std::wstring const& implementationName);
};
RINK_END_OWNING_POINTERS

}  // namespace rti1516e
