// A value that encodes and decodes itself as IEEE 1516.2-2010, 4.13, lays it out.
#pragma once

#include <RTI/OwningPointers.h>
#include <RTI/SpecificConfig.h>
#include <RTI/encoding/EncodingConfig.h>
#include <RTI/encoding/EncodingExceptions.h>

#include <memory>
#include <vector>

namespace rti1516e {

class VariableLengthData;

RINK_BEGIN_OWNING_POINTERS
class RTI_EXPORT DataElement {
 public:
  virtual ~DataElement() = 0;

  virtual std::auto_ptr<DataElement> clone() const = 0;
  virtual VariableLengthData encode() const = 0;
  virtual void encode(VariableLengthData& inData) const = 0;
  virtual void encodeInto(std::vector<Octet>& buffer) const = 0;
  virtual void decode(VariableLengthData const& inData) = 0;
  virtual size_t decodeFrom(std::vector<Octet> const& buffer, size_t index) = 0;
  virtual size_t getEncodedLength() const = 0;
  virtual unsigned int getOctetBoundary() const = 0;
  virtual bool isSameTypeAs(DataElement const& inData) const;
  virtual Integer64 hash() const;
};
RINK_END_OWNING_POINTERS

}  // namespace rti1516e
