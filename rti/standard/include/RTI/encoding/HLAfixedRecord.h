// Encoding helper of a record.
#pragma once

#include <RTI/OwningPointers.h>
#include <RTI/SpecificConfig.h>
#include <RTI/encoding/DataElement.h>
#include <RTI/encoding/EncodingConfig.h>

#include <memory>
#include <vector>

namespace rti1516e {

class HLAfixedRecordImplementation;

RINK_BEGIN_OWNING_POINTERS
class RTI_EXPORT HLAfixedRecord : public DataElement {
 public:
  HLAfixedRecord& operator=(HLAfixedRecord const& rhs) = delete;
  HLAfixedRecord();
  HLAfixedRecord(HLAfixedRecord const& rhs);
  ~HLAfixedRecord() override;

  std::auto_ptr<DataElement> clone() const override;
  VariableLengthData encode() const override;
  void encode(VariableLengthData& inData) const override;
  void encodeInto(std::vector<Octet>& buffer) const override;
  void decode(VariableLengthData const& inData) override;
  size_t decodeFrom(std::vector<Octet> const& buffer, size_t index) override;
  size_t getEncodedLength() const override;
  unsigned int getOctetBoundary() const override;

  bool isSameTypeAs(DataElement const& inData) const override;
  virtual bool hasElementSameTypeAs(size_t index, DataElement const& inData) const;
  virtual size_t size() const;
  virtual void appendElement(DataElement const& dataElement);
  virtual void appendElementPointer(DataElement* dataElement);
  virtual void set(size_t index, DataElement const& dataElement);
  virtual void setElementPointer(size_t index, DataElement* dataElement);
  virtual DataElement const& get(size_t index) const;
  DataElement const& operator[](size_t index) const;

 protected:
  HLAfixedRecordImplementation* _impl;
};
RINK_END_OWNING_POINTERS

}  // namespace rti1516e
