// A stretch of logical time that is a double.
#pragma once

#include <RTI/LogicalTimeInterval.h>

#include <string>

namespace rti1516e {

class HLAfloat64IntervalImpl;

class RTI_EXPORT HLAfloat64Interval : public LogicalTimeInterval {
 public:
  HLAfloat64Interval();
  HLAfloat64Interval(double value);
  HLAfloat64Interval(LogicalTimeInterval const& value);
  HLAfloat64Interval(HLAfloat64Interval const& value);
  ~HLAfloat64Interval() override;

  void setZero() override;
  bool isZero() const override;
  void setEpsilon() override;
  bool isEpsilon() const override;

  LogicalTimeInterval& operator=(LogicalTimeInterval const& value) override;
  LogicalTimeInterval& operator+=(LogicalTimeInterval const& addend) override;
  LogicalTimeInterval& operator-=(LogicalTimeInterval const& subtrahend) override;
  bool operator>(LogicalTimeInterval const& value) const override;
  bool operator<(LogicalTimeInterval const& value) const override;
  bool operator==(LogicalTimeInterval const& value) const override;
  bool operator>=(LogicalTimeInterval const& value) const override;
  bool operator<=(LogicalTimeInterval const& value) const override;
  void setToDifference(LogicalTime const& minuend, LogicalTime const& subtrahend) override;

  VariableLengthData encode() const override;
  size_t encode(void* buffer, size_t bufferSize) const override;
  size_t encodedLength() const override;
  void decode(VariableLengthData const& encodedValue) override;
  void decode(void* buffer, size_t bufferSize) override;
  std::wstring toString() const override;
  std::wstring implementationName() const override;

  virtual double getInterval() const;
  virtual void setInterval(double value);
  virtual HLAfloat64Interval& operator=(HLAfloat64Interval const& value);
  operator double() const;

 private:
  HLAfloat64IntervalImpl* _impl;
};

}  // namespace rti1516e
