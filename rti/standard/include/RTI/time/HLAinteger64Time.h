// An instant of logical time that is an integer.
#pragma once

#include <RTI/LogicalTime.h>
#include <RTI/encoding/EncodingConfig.h>
#include <RTI/time/HLAinteger64Interval.h>

#include <string>

namespace rti1516e {

class HLAinteger64TimeImpl;

class RTI_EXPORT HLAinteger64Time : public LogicalTime {
 public:
  HLAinteger64Time();
  HLAinteger64Time(Integer64 value);
  HLAinteger64Time(LogicalTime const& value);
  HLAinteger64Time(HLAinteger64Time const& value);
  ~HLAinteger64Time() override;

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

  virtual Integer64 getTime() const;
  virtual void setTime(Integer64 value);
  virtual HLAinteger64Time& operator=(HLAinteger64Time const& value);
  operator Integer64() const;

 private:
  friend class HLAinteger64Interval;
  HLAinteger64TimeImpl* _impl;
};

}  // namespace rti1516e
