// The encoding helpers, as IEEE 1516.1-2010 declares them.
#include <type_traits>

#include "tests/rti/standard/signatures/has.h"

namespace rti1516e {
namespace {

using rink::standard::testing::has;

template <class Element>
constexpr bool is_element() {
  return std::is_base_of<DataElement, Element>::value &&
         std::is_copy_constructible<Element>::value &&
         has<Element, std::auto_ptr<DataElement>() const>(&Element::clone) &&
         has<Element, VariableLengthData() const>(&Element::encode) &&
         has<Element, void(VariableLengthData&) const>(&Element::encode) &&
         has<Element, void(std::vector<Octet>&) const>(&Element::encodeInto) &&
         has<Element, void(VariableLengthData const&)>(&Element::decode) &&
         has<Element, size_t(std::vector<Octet> const&, size_t)>(&Element::decodeFrom) &&
         has<Element, size_t() const>(&Element::getEncodedLength) &&
         has<Element, unsigned int() const>(&Element::getOctetBoundary);
}
template <class Element, class Value>
constexpr bool is_basic() {
  return is_element<Element>() && has<Element, void(Value*)>(&Element::setDataPointer) &&
         has<Element, void(Value)>(&Element::set) && has<Element, Value() const>(&Element::get) &&
         has<Element, Integer64() const>(&Element::hash) &&
         std::is_convertible<Element, Value>::value && std::is_assignable<Element&, Value>::value &&
         std::is_default_constructible<Element>::value &&
         std::is_constructible<Element, Value const&>::value &&
         std::is_constructible<Element, Value*>::value;
}
static_assert(is_basic<HLAASCIIchar, char>(), "HLAASCIIchar");
static_assert(is_basic<HLAASCIIstring, std::string>(), "HLAASCIIstring");
static_assert(is_basic<HLAboolean, bool>(), "HLAboolean");
static_assert(is_basic<HLAbyte, Octet>(), "HLAbyte");
static_assert(is_basic<HLAfloat32BE, float>(), "HLAfloat32BE");
static_assert(is_basic<HLAfloat32LE, float>(), "HLAfloat32LE");
static_assert(is_basic<HLAfloat64BE, double>(), "HLAfloat64BE");
static_assert(is_basic<HLAfloat64LE, double>(), "HLAfloat64LE");
static_assert(is_basic<HLAinteger16LE, Integer16>(), "HLAinteger16LE");
static_assert(is_basic<HLAinteger16BE, Integer16>(), "HLAinteger16BE");
static_assert(is_basic<HLAinteger32BE, Integer32>(), "HLAinteger32BE");
static_assert(is_basic<HLAinteger32LE, Integer32>(), "HLAinteger32LE");
static_assert(is_basic<HLAinteger64BE, Integer64>(), "HLAinteger64BE");
static_assert(is_basic<HLAinteger64LE, Integer64>(), "HLAinteger64LE");
static_assert(is_basic<HLAoctet, Octet>(), "HLAoctet");
static_assert(is_basic<HLAoctetPairBE, OctetPair>(), "HLAoctetPairBE");
static_assert(is_basic<HLAoctetPairLE, OctetPair>(), "HLAoctetPairLE");
static_assert(is_basic<HLAunicodeChar, wchar_t>(), "HLAunicodeChar");
static_assert(is_basic<HLAunicodeString, std::wstring>(), "HLAunicodeString");

static_assert(is_element<HLAfixedArray>(), "HLAfixedArray");
static_assert(std::is_constructible<HLAfixedArray, DataElement const&, size_t>::value,
              "HLAfixedArray");
static_assert(has<HLAfixedArray, bool(DataElement const&) const>(&HLAfixedArray::isSameTypeAs),
              "isSameTypeAs");
static_assert(
    has<HLAfixedArray, bool(DataElement const&) const>(&HLAfixedArray::hasPrototypeSameTypeAs),
    "hasPrototypeSameTypeAs");
static_assert(has<HLAfixedArray, size_t() const>(&HLAfixedArray::size), "size");
static_assert(has<HLAfixedArray, void(size_t, DataElement const&)>(&HLAfixedArray::set), "set");
static_assert(has<HLAfixedArray, void(size_t, DataElement*)>(&HLAfixedArray::setElementPointer),
              "setElementPointer");
static_assert(has<HLAfixedArray, DataElement const&(size_t) const>(&HLAfixedArray::get), "get");
static_assert(has<HLAfixedArray, DataElement const&(size_t) const>(&HLAfixedArray::operator[]),
              "operator[]");

static_assert(is_element<HLAvariableArray>(), "HLAvariableArray");
static_assert(std::is_constructible<HLAvariableArray, DataElement const&>::value,
              "HLAvariableArray");
static_assert(
    has<HLAvariableArray, bool(DataElement const&) const>(&HLAvariableArray::isSameTypeAs),
    "isSameTypeAs");
static_assert(has<HLAvariableArray, bool(DataElement const&) const>(
                  &HLAvariableArray::hasPrototypeSameTypeAs),
              "hasPrototypeSameTypeAs");
static_assert(has<HLAvariableArray, size_t() const>(&HLAvariableArray::size), "size");
static_assert(has<HLAvariableArray, void(size_t, DataElement const&)>(&HLAvariableArray::set),
              "set");
static_assert(
    has<HLAvariableArray, void(size_t, DataElement*)>(&HLAvariableArray::setElementPointer),
    "setElementPointer");
static_assert(has<HLAvariableArray, DataElement const&(size_t) const>(&HLAvariableArray::get),
              "get");
static_assert(
    has<HLAvariableArray, DataElement const&(size_t) const>(&HLAvariableArray::operator[]),
    "operator[]");
static_assert(has<HLAvariableArray, void(DataElement const&)>(&HLAvariableArray::addElement),
              "addElement");
static_assert(has<HLAvariableArray, void(DataElement*)>(&HLAvariableArray::addElementPointer),
              "addElementPointer");

static_assert(is_element<HLAfixedRecord>(), "HLAfixedRecord");
static_assert(std::is_constructible<HLAfixedRecord>::value, "HLAfixedRecord");
static_assert(has<HLAfixedRecord, bool(DataElement const&) const>(&HLAfixedRecord::isSameTypeAs),
              "isSameTypeAs");
static_assert(has<HLAfixedRecord, bool(size_t, DataElement const&) const>(
                  &HLAfixedRecord::hasElementSameTypeAs),
              "hasElementSameTypeAs");
static_assert(has<HLAfixedRecord, void(DataElement const&)>(&HLAfixedRecord::appendElement),
              "appendElement");
static_assert(has<HLAfixedRecord, void(DataElement*)>(&HLAfixedRecord::appendElementPointer),
              "appendElementPointer");
static_assert(has<HLAfixedRecord, size_t() const>(&HLAfixedRecord::size), "size");
static_assert(has<HLAfixedRecord, void(size_t, DataElement const&)>(&HLAfixedRecord::set), "set");
static_assert(has<HLAfixedRecord, void(size_t, DataElement*)>(&HLAfixedRecord::setElementPointer),
              "setElementPointer");
static_assert(has<HLAfixedRecord, DataElement const&(size_t) const>(&HLAfixedRecord::get), "get");
static_assert(has<HLAfixedRecord, DataElement const&(size_t) const>(&HLAfixedRecord::operator[]),
              "operator[]");

static_assert(is_element<HLAopaqueData>(), "HLAopaqueData");
static_assert(std::is_constructible<HLAopaqueData, Octet const*, size_t>::value, "HLAopaqueData");
static_assert(has<HLAopaqueData, size_t() const>(&HLAopaqueData::bufferLength), "bufferLength");
static_assert(has<HLAopaqueData, size_t() const>(&HLAopaqueData::dataLength), "dataLength");
static_assert(has<HLAopaqueData, void(Octet**, size_t, size_t)>(&HLAopaqueData::setDataPointer),
              "setDataPointer");
static_assert(has<HLAopaqueData, void(Octet const*, size_t)>(&HLAopaqueData::set), "set");
static_assert(has<HLAopaqueData, Octet const*() const>(&HLAopaqueData::get), "get");

static_assert(is_element<HLAvariantRecord>(), "HLAvariantRecord");
static_assert(std::is_constructible<HLAvariantRecord, DataElement const&>::value,
              "HLAvariantRecord");
static_assert(
    has<HLAvariantRecord, bool(DataElement const&) const>(&HLAvariantRecord::isSameTypeAs),
    "isSameTypeAs");
static_assert(has<HLAvariantRecord, bool(DataElement const&, DataElement const&) const>(
                  &HLAvariantRecord::isSameTypeAs),
              "isSameTypeAs");
static_assert(has<HLAvariantRecord, bool(DataElement const&) const>(
                  &HLAvariantRecord::hasMatchingDiscriminantTypeAs),
              "hasMatchingDiscriminantTypeAs");
static_assert(has<HLAvariantRecord, void(DataElement const&, DataElement const&)>(
                  &HLAvariantRecord::addVariant),
              "addVariant");
static_assert(has<HLAvariantRecord, void(DataElement const&, DataElement*)>(
                  &HLAvariantRecord::addVariantPointer),
              "addVariantPointer");
static_assert(has<HLAvariantRecord, void(DataElement const&)>(&HLAvariantRecord::setDiscriminant),
              "setDiscriminant");
static_assert(has<HLAvariantRecord, void(DataElement const&, DataElement const&)>(
                  &HLAvariantRecord::setVariant),
              "setVariant");
static_assert(has<HLAvariantRecord, void(DataElement const&, DataElement*)>(
                  &HLAvariantRecord::setVariantPointer),
              "setVariantPointer");
static_assert(has<HLAvariantRecord, DataElement const&() const>(&HLAvariantRecord::getDiscriminant),
              "getDiscriminant");
static_assert(has<HLAvariantRecord, DataElement const&() const>(&HLAvariantRecord::getVariant),
              "getVariant");
static_assert(std::is_constructible<HLAopaqueData, Octet**, size_t, size_t>::value,
              "HLAopaqueData");

}  // namespace
}  // namespace rti1516e
