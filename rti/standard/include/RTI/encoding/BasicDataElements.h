// Encoding helpers of the basic representations and strings.
#pragma once

#include <RTI/OwningPointers.h>
#include <RTI/SpecificConfig.h>
#include <RTI/encoding/DataElement.h>
#include <RTI/encoding/EncodingConfig.h>

#include <memory>
#include <string>
#include <vector>

// NOLINTBEGIN(bugprone-macro-parentheses): types, which the argument is, have none.
#define DEFINE_ENCODING_HELPER_CLASS(EncodableDataType, SimpleDataType)         \
  class EncodableDataType##Implementation;                                      \
                                                                                \
  class RTI_EXPORT EncodableDataType : public DataElement {                     \
   public:                                                                      \
    EncodableDataType();                                                        \
    explicit EncodableDataType(SimpleDataType const& inData);                   \
    explicit EncodableDataType(SimpleDataType* inData);                         \
    EncodableDataType(EncodableDataType const& rhs);                            \
    ~EncodableDataType() override;                                              \
    EncodableDataType& operator=(EncodableDataType const& rhs);                 \
                                                                                \
    std::auto_ptr<DataElement> clone() const override;                          \
    VariableLengthData encode() const override;                                 \
    void encode(VariableLengthData& inData) const override;                     \
    void encodeInto(std::vector<Octet>& buffer) const override;                 \
    void decode(VariableLengthData const& inData) override;                     \
    size_t decodeFrom(std::vector<Octet> const& buffer, size_t index) override; \
    size_t getEncodedLength() const override;                                   \
    unsigned int getOctetBoundary() const override;                             \
    Integer64 hash() const override;                                            \
                                                                                \
    virtual void setDataPointer(SimpleDataType* inData);                        \
    virtual void set(SimpleDataType inData);                                    \
    virtual SimpleDataType get() const;                                         \
    EncodableDataType& operator=(SimpleDataType rhs);                           \
    operator SimpleDataType() const;                                            \
                                                                                \
   protected:                                                                   \
    EncodableDataType##Implementation* _impl;                                   \
  };
// NOLINTEND(bugprone-macro-parentheses)

namespace rti1516e {

RINK_BEGIN_OWNING_POINTERS
DEFINE_ENCODING_HELPER_CLASS(HLAASCIIchar, char)
DEFINE_ENCODING_HELPER_CLASS(HLAASCIIstring, std::string)
DEFINE_ENCODING_HELPER_CLASS(HLAboolean, bool)
DEFINE_ENCODING_HELPER_CLASS(HLAbyte, Octet)
DEFINE_ENCODING_HELPER_CLASS(HLAfloat32BE, float)
DEFINE_ENCODING_HELPER_CLASS(HLAfloat32LE, float)
DEFINE_ENCODING_HELPER_CLASS(HLAfloat64BE, double)
DEFINE_ENCODING_HELPER_CLASS(HLAfloat64LE, double)
DEFINE_ENCODING_HELPER_CLASS(HLAinteger16LE, Integer16)
DEFINE_ENCODING_HELPER_CLASS(HLAinteger16BE, Integer16)
DEFINE_ENCODING_HELPER_CLASS(HLAinteger32BE, Integer32)
DEFINE_ENCODING_HELPER_CLASS(HLAinteger32LE, Integer32)
DEFINE_ENCODING_HELPER_CLASS(HLAinteger64BE, Integer64)
DEFINE_ENCODING_HELPER_CLASS(HLAinteger64LE, Integer64)
DEFINE_ENCODING_HELPER_CLASS(HLAoctet, Octet)
DEFINE_ENCODING_HELPER_CLASS(HLAoctetPairBE, OctetPair)
DEFINE_ENCODING_HELPER_CLASS(HLAoctetPairLE, OctetPair)
DEFINE_ENCODING_HELPER_CLASS(HLAunicodeChar, wchar_t)
DEFINE_ENCODING_HELPER_CLASS(HLAunicodeString, std::wstring)
RINK_END_OWNING_POINTERS

}  // namespace rti1516e
