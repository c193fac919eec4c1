// Encoding helper of octets that have no further structure.
#pragma once

#include <RTI/OwningPointers.h>
#include <RTI/SpecificConfig.h>
#include <RTI/encoding/DataElement.h>
#include <RTI/encoding/EncodingConfig.h>

#include <memory>
#include <vector>

namespace rti1516e {

class HLAopaqueDataImplementation;

RINK_BEGIN_OWNING_POINTERS
class RTI_EXPORT HLAopaqueData : public DataElement {
 public:
  HLAopaqueData& operator=(HLAopaqueData const& rhs) = delete;
  HLAopaqueData();
  HLAopaqueData(Octet const* inData, size_t dataSize);
  HLAopaqueData(Octet** inData, size_t bufferSize, size_t dataSize);
  HLAopaqueData(HLAopaqueData const& rhs);
  ~HLAopaqueData() override;

  std::auto_ptr<DataElement> clone() const override;
  VariableLengthData encode() const override;
  void encode(VariableLengthData& inData) const override;
  void encodeInto(std::vector<Octet>& buffer) const override;
  void decode(VariableLengthData const& inData) override;
  size_t decodeFrom(std::vector<Octet> const& buffer, size_t index) override;
  size_t getEncodedLength() const override;
  unsigned int getOctetBoundary() const override;

  virtual size_t bufferLength() const;
  virtual size_t dataLength() const;
  virtual void setDataPointer(Octet** inData, size_t bufferSize, size_t dataSize);
  virtual void set(Octet const* inData, size_t dataSize);
  virtual Octet const* get() const;
  operator Octet const*() const;

 protected:
  HLAopaqueDataImplementation* _impl;
};
RINK_END_OWNING_POINTERS

}  // namespace rti1516e
