// A value of any size, as the standard's C++ API passes it.
#pragma once

#include <RTI/SpecificConfig.h>

#include <cstddef>

namespace rti1516e {

class VariableLengthDataImplementation;

using VariableLengthDataDeleteFunction = void (*)(void* data);

class RTI_EXPORT VariableLengthData {
 public:
  VariableLengthData();
  VariableLengthData(void const* inData, size_t inSize);
  VariableLengthData(VariableLengthData const& rhs);
  ~VariableLengthData();
  VariableLengthData& operator=(VariableLengthData const& rhs);

  void const* data() const;
  size_t size() const;

  /// Copies the bytes.
  void setData(void const* inData, size_t inSize);
  /// Uses the caller's bytes, which must stay.
  void setDataPointer(void* inData, size_t inSize);
  /// Takes the bytes over, and deletes them by `func`, or by delete[] without one.
  void takeDataPointer(void* inData, size_t inSize,
                       VariableLengthDataDeleteFunction func = nullptr);

 private:
  friend class VariableLengthDataFriend;
  VariableLengthDataImplementation* _impl;
};

}  // namespace rti1516e
