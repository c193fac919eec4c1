// Encoding helpers of records and variant records.
#include <map>

#include "rti/standard/encoding/element_slots.h"

namespace rti1516e {

class HLAfixedRecordImplementation {
 public:
  rink::standard::ElementSlots fields{};
};

HLAfixedRecord::HLAfixedRecord() : _impl(new HLAfixedRecordImplementation) {}
HLAfixedRecord::HLAfixedRecord(HLAfixedRecord const& rhs)
    : DataElement(), _impl(new HLAfixedRecordImplementation(*rhs._impl)) {}
HLAfixedRecord::~HLAfixedRecord() { delete _impl; }
RINK_DEFINE_WHOLE_VALUES(HLAfixedRecord)
void HLAfixedRecord::encodeInto(std::vector<Octet>& buffer) const {
  _impl->fields.encode(buffer, buffer.size());
}
size_t HLAfixedRecord::decodeFrom(std::vector<Octet> const& buffer, size_t index) {
  return _impl->fields.decode(buffer, index, index);
}
unsigned int HLAfixedRecord::getOctetBoundary() const { return _impl->fields.boundary(); }
bool HLAfixedRecord::isSameTypeAs(DataElement const& inData) const {
  const auto* const other = dynamic_cast<HLAfixedRecord const*>(&inData);
  return other != nullptr && _impl->fields.is_same_type(other->_impl->fields);
}
bool HLAfixedRecord::hasElementSameTypeAs(size_t index, DataElement const& inData) const {
  return index < size() && get(index).isSameTypeAs(inData);
}
size_t HLAfixedRecord::size() const { return _impl->fields.size(); }
void HLAfixedRecord::appendElement(DataElement const& dataElement) {
  _impl->fields.add(dataElement);
}
void HLAfixedRecord::appendElementPointer(DataElement* dataElement) {
  _impl->fields.add(dataElement);
}
void HLAfixedRecord::set(size_t index, DataElement const& dataElement) {
  _impl->fields.at(index).set(dataElement);
}
void HLAfixedRecord::setElementPointer(size_t index, DataElement* dataElement) {
  _impl->fields.at(index).set_pointer(dataElement);
}
DataElement const& HLAfixedRecord::get(size_t index) const {
  return std::as_const(_impl->fields).at(index).get();
}
DataElement const& HLAfixedRecord::operator[](size_t index) const { return get(index); }

/// Alternatives by the octets of their discriminants.
class HLAvariantRecordImplementation {
 public:
  rink::standard::ElementSlot discriminant;
  std::map<rink::standard::Octets, rink::standard::ElementSlot> variants{};

  using Variant = decltype(variants)::value_type;
  rink::standard::Octets key(DataElement const& value) const {
    if (!discriminant.get().isSameTypeAs(value))
      throw EncoderException(L"the discriminant is of another type");
    rink::standard::Octets octets;
    value.encodeInto(octets);
    return octets;
  }
  Variant& at(DataElement const& value) {
    const auto found = variants.find(key(value));
    if (found == variants.end()) throw EncoderException(L"the discriminant has no alternative");
    return *found;
  }
  /// What the present discriminant chooses; null if that has no alternative.
  DataElement* chosen() {
    const auto found = variants.find(key(discriminant.get()));
    return found == variants.end() ? nullptr : &found->second.get();
  }
  /// That of the alternatives, which all begin at the same octet.
  unsigned boundary() const {
    unsigned most = 1;
    for (const auto& [octets, variant] : variants)
      most = std::max(most, variant.get().getOctetBoundary());
    return most;
  }
};

HLAvariantRecord::HLAvariantRecord(DataElement const& discriminantPrototype)
    : _impl(
          new HLAvariantRecordImplementation{rink::standard::ElementSlot(discriminantPrototype)}) {}
HLAvariantRecord::HLAvariantRecord(HLAvariantRecord const& rhs)
    : DataElement(), _impl(new HLAvariantRecordImplementation(*rhs._impl)) {}
HLAvariantRecord::~HLAvariantRecord() { delete _impl; }
RINK_DEFINE_WHOLE_VALUES(HLAvariantRecord)
void HLAvariantRecord::encodeInto(std::vector<Octet>& buffer) const {
  const size_t begin = buffer.size();
  _impl->discriminant.get().encodeInto(buffer);
  const DataElement* const variant = _impl->chosen();
  if (variant == nullptr) return;
  buffer.resize(buffer.size() + rink::standard::padding(buffer.size() - begin, _impl->boundary()));
  variant->encodeInto(buffer);
}
size_t HLAvariantRecord::decodeFrom(std::vector<Octet> const& buffer, size_t index) {
  const size_t end = _impl->discriminant.get().decodeFrom(buffer, index);
  DataElement* const variant = _impl->chosen();
  if (variant == nullptr) return end;
  return variant->decodeFrom(buffer, end + rink::standard::padding(end - index, _impl->boundary()));
}
unsigned int HLAvariantRecord::getOctetBoundary() const {
  return std::max(_impl->discriminant.get().getOctetBoundary(), _impl->boundary());
}
bool HLAvariantRecord::isSameTypeAs(DataElement const& inData) const {
  const auto* const other = dynamic_cast<HLAvariantRecord const*>(&inData);
  if (other == nullptr || !hasMatchingDiscriminantTypeAs(other->getDiscriminant())) return false;
  const auto &own = _impl->variants, &theirs = other->_impl->variants;
  return std::equal(
      own.begin(), own.end(), theirs.begin(), theirs.end(), [](const auto& one, const auto& two) {
        return one.first == two.first && one.second.get().isSameTypeAs(two.second.get());
      });
}
bool HLAvariantRecord::isSameTypeAs(DataElement const& discriminant,
                                    DataElement const& inData) const {
  return _impl->at(discriminant).second.get().isSameTypeAs(inData);
}
bool HLAvariantRecord::hasMatchingDiscriminantTypeAs(DataElement const& dataElement) const {
  return _impl->discriminant.get().isSameTypeAs(dataElement);
}
void HLAvariantRecord::addVariant(DataElement const& discriminant,
                                  DataElement const& valuePrototype) {
  if (!_impl->variants.emplace(_impl->key(discriminant), valuePrototype).second)
    throw EncoderException(L"the discriminant has an alternative already");
}
void HLAvariantRecord::addVariantPointer(DataElement const& discriminant, DataElement* valuePtr) {
  if (!_impl->variants.emplace(_impl->key(discriminant), valuePtr).second)
    throw EncoderException(L"the discriminant has an alternative already");
}
void HLAvariantRecord::setDiscriminant(DataElement const& discriminant) {
  _impl->at(discriminant);
  _impl->discriminant.set(discriminant);
}
void HLAvariantRecord::setVariant(DataElement const& discriminant, DataElement const& value) {
  _impl->at(discriminant).second.set(value);
  _impl->discriminant.set(discriminant);
}
void HLAvariantRecord::setVariantPointer(DataElement const& discriminant, DataElement* valuePtr) {
  _impl->at(discriminant).second.set_pointer(valuePtr);
  _impl->discriminant.set(discriminant);
}
DataElement const& HLAvariantRecord::getDiscriminant() const { return _impl->discriminant.get(); }
DataElement const& HLAvariantRecord::getVariant() const {
  const DataElement* const variant = _impl->chosen();
  if (variant == nullptr) throw EncoderException(L"the discriminant has no alternative");
  return *variant;
}

}  // namespace rti1516e
