// Encoding helpers of the basic representations and strings (IEEE 1516.2-2010, 4.13).
#include <typeinfo>

#include "rti/standard/encoding/basic_forms.h"

namespace rti1516e {

DataElement::~DataElement() = default;
bool DataElement::isSameTypeAs(DataElement const& inData) const {
  return typeid(*this) == typeid(inData);
}
/// The hash of the octets, FNV-1a.
Integer64 DataElement::hash() const {
  rink::standard::Octets buffer;
  encodeInto(buffer);
  std::uint64_t sum = 0xcbf29ce484222325u;
  for (const Octet each : buffer) sum = (sum ^ static_cast<unsigned char>(each)) * 0x100000001b3u;
  return static_cast<Integer64>(sum);
}

// NOLINTBEGIN(bugprone-macro-parentheses): types, which the argument is, have none.
#define RINK_DEFINE_BASIC_ELEMENT(Kind, Value, ...)                                            \
  class Kind##Implementation : public rink::standard::Held<Value> {                            \
   public:                                                                                     \
    using rink::standard::Held<Value>::Held;                                                   \
    using Form = __VA_ARGS__;                                                                  \
  };                                                                                           \
  Kind::Kind() : _impl(new Kind##Implementation) {}                                            \
  Kind::Kind(Value const& inData) : _impl(new Kind##Implementation(inData)) {}                 \
  Kind::Kind(Value* inData) : _impl(new Kind##Implementation) { _impl->external = inData; }    \
  Kind::Kind(Kind const& rhs) : DataElement(), _impl(new Kind##Implementation(*rhs._impl)) {}  \
  Kind::~Kind() { delete _impl; }                                                              \
  Kind& Kind::operator=(Kind const& rhs) {                                                     \
    if (this != &rhs) _impl->value() = rhs._impl->value();                                     \
    return *this;                                                                              \
  }                                                                                            \
  RINK_DEFINE_WHOLE_VALUES(Kind)                                                               \
  void Kind::encodeInto(std::vector<Octet>& buffer) const {                                    \
    Kind##Implementation::Form::write(buffer, std::as_const(*_impl).value());                  \
  }                                                                                            \
  size_t Kind::decodeFrom(std::vector<Octet> const& buffer, size_t index) {                    \
    return Kind##Implementation::Form::read(buffer, index, _impl->value());                    \
  }                                                                                            \
  unsigned int Kind::getOctetBoundary() const { return Kind##Implementation::Form::boundary; } \
  Integer64 Kind::hash() const {                                                               \
    return Kind##Implementation::Form::hash(std::as_const(*_impl).value());                    \
  }                                                                                            \
  void Kind::setDataPointer(Value* inData) {                                                   \
    _impl->external = rink::standard::checked_pointer(inData);                                 \
  }                                                                                            \
  void Kind::set(Value inData) { std::swap(_impl->value(), inData); }                          \
  Value Kind::get() const { return std::as_const(*_impl).value(); }                            \
  Kind& Kind::operator=(Value rhs) {                                                           \
    std::swap(_impl->value(), rhs);                                                            \
    return *this;                                                                              \
  }                                                                                            \
  Kind::operator Value() const { return get(); }
// NOLINTEND(bugprone-macro-parentheses)

RINK_DEFINE_BASIC_ELEMENT(HLAASCIIchar, char, rink::standard::BigEndian<char>)
RINK_DEFINE_BASIC_ELEMENT(HLAASCIIstring, std::string, rink::standard::AsciiStringForm)
RINK_DEFINE_BASIC_ELEMENT(HLAboolean, bool, rink::standard::BooleanForm)
RINK_DEFINE_BASIC_ELEMENT(HLAbyte, Octet, rink::standard::BigEndian<Octet>)
RINK_DEFINE_BASIC_ELEMENT(HLAfloat32BE, float, rink::standard::BigEndian<float>)
RINK_DEFINE_BASIC_ELEMENT(HLAfloat32LE, float, rink::standard::LittleEndian<float>)
RINK_DEFINE_BASIC_ELEMENT(HLAfloat64BE, double, rink::standard::BigEndian<double>)
RINK_DEFINE_BASIC_ELEMENT(HLAfloat64LE, double, rink::standard::LittleEndian<double>)
RINK_DEFINE_BASIC_ELEMENT(HLAinteger16LE, Integer16, rink::standard::LittleEndian<Integer16>)
RINK_DEFINE_BASIC_ELEMENT(HLAinteger16BE, Integer16, rink::standard::BigEndian<Integer16>)
RINK_DEFINE_BASIC_ELEMENT(HLAinteger32BE, Integer32, rink::standard::BigEndian<Integer32>)
RINK_DEFINE_BASIC_ELEMENT(HLAinteger32LE, Integer32, rink::standard::LittleEndian<Integer32>)
RINK_DEFINE_BASIC_ELEMENT(HLAinteger64BE, Integer64, rink::standard::BigEndian<Integer64>)
RINK_DEFINE_BASIC_ELEMENT(HLAinteger64LE, Integer64, rink::standard::LittleEndian<Integer64>)
RINK_DEFINE_BASIC_ELEMENT(HLAoctet, Octet, rink::standard::BigEndian<Octet>)
RINK_DEFINE_BASIC_ELEMENT(HLAoctetPairBE, OctetPair, rink::standard::OctetPairForm<true>)
RINK_DEFINE_BASIC_ELEMENT(HLAoctetPairLE, OctetPair, rink::standard::OctetPairForm<false>)
RINK_DEFINE_BASIC_ELEMENT(HLAunicodeChar, wchar_t, rink::standard::UnicodeCharForm)
RINK_DEFINE_BASIC_ELEMENT(HLAunicodeString, std::wstring, rink::standard::UnicodeStringForm)
#undef RINK_DEFINE_BASIC_ELEMENT

}  // namespace rti1516e
