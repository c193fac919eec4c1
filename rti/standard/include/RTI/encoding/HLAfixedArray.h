// Encoding helper of an array of fixed size.
#pragma once

#include <RTI/OwningPointers.h>
#include <RTI/SpecificConfig.h>
#include <RTI/encoding/DataElement.h>
#include <RTI/encoding/EncodingConfig.h>

#include <memory>
#include <vector>

namespace rti1516e {

class HLAfixedArrayImplementation;

RINK_BEGIN_OWNING_POINTERS
class RTI_EXPORT HLAfixedArray : public DataElement {
 public:
  HLAfixedArray() = delete;
  HLAfixedArray& operator=(HLAfixedArray const& rhs) = delete;
  explicit HLAfixedArray(DataElement const& protoType, size_t length);
  HLAfixedArray(HLAfixedArray const& rhs);
  ~HLAfixedArray() override;

  std::auto_ptr<DataElement> clone() const override;
  VariableLengthData encode() const override;
  void encode(VariableLengthData& inData) const override;
  void encodeInto(std::vector<Octet>& buffer) const override;
  void decode(VariableLengthData const& inData) override;
  size_t decodeFrom(std::vector<Octet> const& buffer, size_t index) override;
  size_t getEncodedLength() const override;
  unsigned int getOctetBoundary() const override;

  bool isSameTypeAs(DataElement const& inData) const override;
  virtual bool hasPrototypeSameTypeAs(DataElement const& dataElement) const;
  virtual size_t size() const;
  virtual void set(size_t index, DataElement const& dataElement);
  virtual void setElementPointer(size_t index, DataElement* dataElement);
  virtual DataElement const& get(size_t index) const;
  DataElement const& operator[](size_t index) const;

 protected:
  HLAfixedArrayImplementation* _impl;
};
RINK_END_OWNING_POINTERS

}  // namespace rti1516e
