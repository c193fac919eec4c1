// An instant of logical time that is a double.
#pragma once

#include <RTI/LogicalTime.h>
#include <RTI/time/HLAfloat64Interval.h>

#include <string>

namespace rti1516e {

class HLAfloat64TimeImpl;

class RTI_EXPORT HLAfloat64Time : public LogicalTime {
 public:
  HLAfloat64Time();
  HLAfloat64Time(double const& value);
  HLAfloat64Time(LogicalTime const& value);
  HLAfloat64Time(HLAfloat64Time const& value);
  ~HLAfloat64Time() override;

  void setInitial() override;
  bool isInitial() const override;
  void setFinal() override;
  bool isFinal() const override;

  LogicalTime& operator=(LogicalTime const& value) override;
  LogicalTime& operator+=(LogicalTimeInterval const& addend) override;
  LogicalTime& operator-=(LogicalTimeInterval const& subtrahend) override;
  bool operator>(LogicalTime const& value) const override;
  bool operator<(LogicalTime const& value) const override;
  bool operator==(LogicalTime const& value) const override;
  bool operator>=(LogicalTime const& value) const override;
  bool operator<=(LogicalTime const& value) const override;

  VariableLengthData encode() const override;
  size_t encode(void* buffer, size_t bufferSize) const override;
  size_t encodedLength() const override;
  void decode(VariableLengthData const& encodedValue) override;
  void decode(void* buffer, size_t bufferSize) override;
  std::wstring toString() const override;
  std::wstring implementationName() const override;

  virtual double getTime() const;
  virtual void setTime(double value);
  virtual HLAfloat64Time& operator=(HLAfloat64Time const& value);
  operator double() const;

 private:
  friend class HLAfloat64Interval;
  HLAfloat64TimeImpl* _impl;
};

}  // namespace rti1516e
