// Encoding helpers of arrays and opaque octets.
#include "rti/standard/encoding/element_slots.h"

namespace rti1516e {

using rink::standard::ElementSlot;
using rink::standard::ElementSlots;

class HLAfixedArrayImplementation {
 public:
  ElementSlot prototype;
  ElementSlots slots{};
};
class HLAvariableArrayImplementation {
 public:
  ElementSlot prototype;
  ElementSlots slots{};
};

// What both kinds of array do alike.
// NOLINTBEGIN(bugprone-macro-parentheses): types, which the argument is, have none.
#define RINK_DEFINE_ARRAY(Kind)                                                               \
  Kind::Kind(Kind const& rhs) : DataElement(), _impl(new Kind##Implementation(*rhs._impl)) {} \
  Kind::~Kind() { delete _impl; }                                                             \
  RINK_DEFINE_WHOLE_VALUES(Kind)                                                              \
  bool Kind::hasPrototypeSameTypeAs(DataElement const& dataElement) const {                   \
    return _impl->prototype.get().isSameTypeAs(dataElement);                                  \
  }                                                                                           \
  size_t Kind::size() const { return _impl->slots.size(); }                                   \
  void Kind::set(size_t index, DataElement const& dataElement) {                              \
    _impl->slots.at(index).set(dataElement);                                                  \
  }                                                                                           \
  void Kind::setElementPointer(size_t index, DataElement* dataElement) {                      \
    _impl->slots.at(index).set_pointer(dataElement);                                          \
  }                                                                                           \
  DataElement const& Kind::get(size_t index) const {                                          \
    return std::as_const(_impl->slots).at(index).get();                                       \
  }                                                                                           \
  DataElement const& Kind::operator[](size_t index) const { return get(index); }
// NOLINTEND(bugprone-macro-parentheses)

RINK_DEFINE_ARRAY(HLAfixedArray)
RINK_DEFINE_ARRAY(HLAvariableArray)
#undef RINK_DEFINE_ARRAY

HLAfixedArray::HLAfixedArray(DataElement const& protoType, size_t length)
    : _impl(new HLAfixedArrayImplementation{ElementSlot(protoType)}) {
  _impl->slots.resize(length, protoType);
}
void HLAfixedArray::encodeInto(std::vector<Octet>& buffer) const {
  _impl->slots.encode(buffer, buffer.size());
}
size_t HLAfixedArray::decodeFrom(std::vector<Octet> const& buffer, size_t index) {
  return _impl->slots.decode(buffer, index, index);
}
unsigned int HLAfixedArray::getOctetBoundary() const {
  return _impl->prototype.get().getOctetBoundary();
}
bool HLAfixedArray::isSameTypeAs(DataElement const& inData) const {
  const auto* const other = dynamic_cast<HLAfixedArray const*>(&inData);
  return other != nullptr && size() == other->size() &&
         hasPrototypeSameTypeAs(other->_impl->prototype.get());
}

HLAvariableArray::HLAvariableArray(DataElement const& prototype)
    : _impl(new HLAvariableArrayImplementation{ElementSlot(prototype)}) {}
void HLAvariableArray::encodeInto(std::vector<Octet>& buffer) const {
  const size_t begin = buffer.size();
  rink::standard::put_count(buffer, size());
  _impl->slots.encode(buffer, begin);
}
size_t HLAvariableArray::decodeFrom(std::vector<Octet> const& buffer, size_t index) {
  const size_t count = rink::standard::get_count(buffer, index);
  // Elements have an octet at least, but for records without fields; a count that is not true must
  // not be what is allocated.
  if (count > buffer.size() - index)
    throw EncoderException(L"an array of " + std::to_wstring(count) + L" elements in " +
                           std::to_wstring(buffer.size() - index) + L" octets");
  _impl->slots.resize(count, _impl->prototype.get());
  return _impl->slots.decode(buffer, index, index + 4);
}
unsigned int HLAvariableArray::getOctetBoundary() const {
  return std::max(4u, _impl->prototype.get().getOctetBoundary());
}
bool HLAvariableArray::isSameTypeAs(DataElement const& inData) const {
  const auto* const other = dynamic_cast<HLAvariableArray const*>(&inData);
  return other != nullptr && hasPrototypeSameTypeAs(other->_impl->prototype.get());
}
void HLAvariableArray::addElement(DataElement const& dataElement) {
  if (!hasPrototypeSameTypeAs(dataElement))
    throw EncoderException(L"the element is of another type");
  _impl->slots.add(dataElement);
}
void HLAvariableArray::addElementPointer(DataElement* dataElement) {
  if (dataElement == nullptr || !hasPrototypeSameTypeAs(*dataElement))
    throw EncoderException(L"the element is null or of another type");
  _impl->slots.add(dataElement);
}

/// Octets of its own, or a place that the user has given, with room for `room` of them.
class HLAopaqueDataImplementation {
 public:
  std::vector<Octet> own{};
  Octet** external = nullptr;
  size_t room = 0, size = 0;  ///< of the external place

  const Octet* data() const { return external == nullptr ? own.data() : *external; }
  size_t count() const { return external == nullptr ? own.size() : size; }
  void set(const Octet* octets, size_t octet_count) {
    if (external == nullptr) {
      own = std::vector<Octet>(octets, octets + octet_count);  // they may be its own
      return;
    }
    if (octet_count > room)
      throw EncoderException(L"the buffer has " + std::to_wstring(room) + L" octets, not " +
                             std::to_wstring(octet_count));
    if (octet_count > 0) std::memmove(*external, octets, octet_count);
    size = octet_count;
  }
};

HLAopaqueData::HLAopaqueData() : _impl(new HLAopaqueDataImplementation) {}
HLAopaqueData::HLAopaqueData(Octet const* inData, size_t dataSize) : HLAopaqueData() {
  _impl->set(inData, dataSize);
}
HLAopaqueData::HLAopaqueData(Octet** inData, size_t bufferSize, size_t dataSize) : HLAopaqueData() {
  setDataPointer(inData, bufferSize, dataSize);
}
HLAopaqueData::HLAopaqueData(HLAopaqueData const& rhs) : DataElement(), _impl(nullptr) {
  _impl = new HLAopaqueDataImplementation;
  _impl->set(rhs.get(), rhs.dataLength());
}
HLAopaqueData::~HLAopaqueData() { delete _impl; }
RINK_DEFINE_WHOLE_VALUES(HLAopaqueData)
void HLAopaqueData::encodeInto(std::vector<Octet>& buffer) const {
  rink::standard::put_count(buffer, dataLength());
  buffer.insert(buffer.end(), get(), get() + dataLength());
}
size_t HLAopaqueData::decodeFrom(std::vector<Octet> const& buffer, size_t index) {
  const size_t count = rink::standard::get_count(buffer, index);
  rink::standard::check_room(buffer, index + 4, count);
  _impl->set(buffer.data() + index + 4, count);
  return index + 4 + count;
}
unsigned int HLAopaqueData::getOctetBoundary() const { return 4; }
size_t HLAopaqueData::bufferLength() const {
  return _impl->external == nullptr ? _impl->own.size() : _impl->room;
}
size_t HLAopaqueData::dataLength() const { return _impl->count(); }
void HLAopaqueData::setDataPointer(Octet** inData, size_t bufferSize, size_t dataSize) {
  if (inData == nullptr || *inData == nullptr || dataSize > bufferSize)
    throw EncoderException(L"the buffer is null or smaller than its data");
  _impl->external = inData;
  _impl->room = bufferSize;
  _impl->size = dataSize;
}
void HLAopaqueData::set(Octet const* inData, size_t dataSize) { _impl->set(inData, dataSize); }
Octet const* HLAopaqueData::get() const { return _impl->data(); }
HLAopaqueData::operator Octet const*() const { return get(); }

}  // namespace rti1516e
