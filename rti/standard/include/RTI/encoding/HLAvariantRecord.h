// Encoding helper of a record whose discriminant says what else it has.
#pragma once

#include <RTI/OwningPointers.h>
#include <RTI/SpecificConfig.h>
#include <RTI/encoding/DataElement.h>
#include <RTI/encoding/EncodingConfig.h>

#include <memory>
#include <vector>

namespace rti1516e {

class HLAvariantRecordImplementation;

RINK_BEGIN_OWNING_POINTERS
class RTI_EXPORT HLAvariantRecord : public DataElement {
 public:
  HLAvariantRecord() = delete;
  HLAvariantRecord& operator=(HLAvariantRecord const& rhs) = delete;
  explicit HLAvariantRecord(DataElement const& discriminantPrototype);
  HLAvariantRecord(HLAvariantRecord const& rhs);
  ~HLAvariantRecord() override;

  std::auto_ptr<DataElement> clone() const override;
  VariableLengthData encode() const override;
  void encode(VariableLengthData& inData) const override;
  void encodeInto(std::vector<Octet>& buffer) const override;
  void decode(VariableLengthData const& inData) override;
  size_t decodeFrom(std::vector<Octet> const& buffer, size_t index) override;
  size_t getEncodedLength() const override;
  unsigned int getOctetBoundary() const override;

  bool isSameTypeAs(DataElement const& inData) const override;
  virtual bool isSameTypeAs(DataElement const& discriminant, DataElement const& inData) const;
  virtual bool hasMatchingDiscriminantTypeAs(DataElement const& dataElement) const;
  virtual void addVariant(DataElement const& discriminant, DataElement const& valuePrototype);
  virtual void addVariantPointer(DataElement const& discriminant, DataElement* valuePtr);
  virtual void setDiscriminant(DataElement const& discriminant);
  virtual void setVariant(DataElement const& discriminant, DataElement const& value);
  virtual void setVariantPointer(DataElement const& discriminant, DataElement* valuePtr);
  virtual DataElement const& getDiscriminant() const;
  virtual DataElement const& getVariant() const;

 protected:
  HLAvariantRecordImplementation* _impl;
};
RINK_END_OWNING_POINTERS

}  // namespace rti1516e
