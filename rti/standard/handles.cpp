// What the standard's handles do.
#include "rti/standard/handles.h"

#include <array>
#include <bit>
#include <cstring>
#include <ostream>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "rti/standard/errors.h"

namespace rti1516e {

/// The message that a retraction handle names.
class MessageRetractionHandleImplementation {
 public:
  rink::rti::RetractionHandle handle;
};

namespace {

/// Handles travel as big-endian words.
constexpr std::size_t handle_size = 4, retraction_size = 4 + 8 + 8;

void put(std::span<unsigned char> bytes, std::uint64_t number) {
  for (std::size_t i = bytes.size(); i > 0; --i, number >>= 8)
    bytes[i - 1] = static_cast<unsigned char>(number & 0xff);
}

std::uint64_t get(std::span<const unsigned char> bytes) {
  std::uint64_t number = 0;
  for (const unsigned char each : bytes) number = number << 8 | each;
  return number;
}

/// The bytes of an encoded handle; throws CouldNotDecode if it has another size.
template <std::size_t size>
std::array<unsigned char, size> encoded(VariableLengthData const& bytes) {
  if (bytes.size() != size)
    throw CouldNotDecode(L"a handle has " + std::to_wstring(size) + L" bytes, not " +
                         std::to_wstring(bytes.size()));
  std::array<unsigned char, size> found;
  std::memcpy(found.data(), bytes.data(), size);
  return found;
}

template <std::size_t size>
size_t copy_encoded(const std::array<unsigned char, size>& bytes, void* buffer, size_t room) {
  if (room < size)
    throw CouldNotEncode(L"a handle needs " + std::to_wstring(size) + L" bytes, not " +
                         std::to_wstring(room));
  std::memcpy(buffer, bytes.data(), size);
  return size;
}

template <class Implementation>
std::array<unsigned char, handle_size> number_bytes(Implementation* handle) {
  std::array<unsigned char, handle_size> bytes;
  put(bytes, reinterpret_cast<std::uintptr_t>(handle) - 1);
  return bytes;
}

std::array<unsigned char, retraction_size> retraction_bytes(
    const rink::rti::RetractionHandle& handle) {
  std::array<unsigned char, retraction_size> bytes;
  const std::span<unsigned char> all(bytes);
  put(all.first(4), handle.sender.value);
  put(all.subspan(4, 8), handle.number);
  put(all.subspan(12, 8), std::bit_cast<std::uint64_t>(handle.time));
  return bytes;
}

}  // namespace

// What all kinds do alike, on their bytes.
// NOLINTBEGIN(bugprone-macro-parentheses): types, which the argument is, have none.
#define RINK_DEFINE_HANDLE_ENCODING(Kind, bytes, bytes_count)                   \
  bool Kind::isValid() const { return _impl != nullptr; }                       \
  bool Kind::operator!=(Kind const& rhs) const { return !(*this == rhs); }      \
  VariableLengthData Kind::encode() const {                                     \
    const auto encoding = bytes(_impl);                                         \
    return VariableLengthData(encoding.data(), encoding.size());                \
  }                                                                             \
  void Kind::encode(VariableLengthData& buffer) const { buffer = encode(); }    \
  size_t Kind::encode(void* buffer, size_t bufferSize) const {                  \
    return copy_encoded(bytes(_impl), buffer, bufferSize);                      \
  }                                                                             \
  size_t Kind::encodedLength() const { return bytes_count; }                    \
  const Kind##Implementation* Kind::getImplementation() const { return _impl; } \
  Kind##Implementation* Kind::getImplementation() { return _impl; }             \
  std::wostream& operator<<(std::wostream& stream, Kind const& handle) {        \
    return stream << handle.toString();                                         \
  }

#define RINK_DEFINE_HANDLE(Kind)                                                                  \
  Kind::Kind() : _impl(nullptr) {}                                                                \
  Kind::~Kind() = default;                                                                        \
  Kind::Kind(Kind const& rhs) = default;                                                          \
  Kind& Kind::operator=(Kind const& rhs) = default;                                               \
  Kind::Kind(Kind##Implementation* impl) : _impl(impl) {}                                         \
  Kind::Kind(VariableLengthData const& encodedValue)                                              \
      : Kind(Kind##Friend::make(                                                                  \
            static_cast<std::uint32_t>(get(encoded<handle_size>(encodedValue))))) {}              \
  bool Kind::operator==(Kind const& rhs) const { return _impl == rhs._impl; }                     \
  bool Kind::operator<(Kind const& rhs) const {                                                   \
    return reinterpret_cast<std::uintptr_t>(_impl) < reinterpret_cast<std::uintptr_t>(rhs._impl); \
  }                                                                                               \
  long Kind::hash() const { return static_cast<long>(reinterpret_cast<std::uintptr_t>(_impl)); }  \
  std::wstring Kind::toString() const {                                                           \
    return isValid() ? std::to_wstring(Kind##Friend::number(*this)) : L"invalid";                 \
  }                                                                                               \
  RINK_DEFINE_HANDLE_ENCODING(Kind, number_bytes, handle_size)
// NOLINTEND(bugprone-macro-parentheses)

RINK_DEFINE_HANDLE(FederateHandle)
RINK_DEFINE_HANDLE(ObjectClassHandle)
RINK_DEFINE_HANDLE(InteractionClassHandle)
RINK_DEFINE_HANDLE(ObjectInstanceHandle)
RINK_DEFINE_HANDLE(AttributeHandle)
RINK_DEFINE_HANDLE(ParameterHandle)
RINK_DEFINE_HANDLE(DimensionHandle)
RINK_DEFINE_HANDLE(RegionHandle)

namespace {

rink::rti::RetractionHandle value_of(const MessageRetractionHandleImplementation* impl) {
  return impl == nullptr ? rink::rti::RetractionHandle{} : impl->handle;
}

auto bytes_of(const MessageRetractionHandleImplementation* impl) {
  return retraction_bytes(value_of(impl));
}

MessageRetractionHandleImplementation* copy_of(const MessageRetractionHandleImplementation* impl) {
  return impl == nullptr ? nullptr : new MessageRetractionHandleImplementation(*impl);
}

rink::rti::RetractionHandle decoded(VariableLengthData const& bytes) {
  const auto all = encoded<retraction_size>(bytes);
  const std::span<const unsigned char> parts(all);
  return {{static_cast<std::uint32_t>(get(parts.first(4)))},
          get(parts.subspan(4, 8)),
          std::bit_cast<double>(get(parts.subspan(12, 8)))};
}

}  // namespace

MessageRetractionHandle::MessageRetractionHandle() : _impl(nullptr) {}
MessageRetractionHandle::~MessageRetractionHandle() { delete _impl; }
MessageRetractionHandle::MessageRetractionHandle(MessageRetractionHandle const& rhs)
    : _impl(copy_of(rhs._impl)) {}
MessageRetractionHandle& MessageRetractionHandle::operator=(MessageRetractionHandle const& rhs) {
  if (this != &rhs) delete std::exchange(_impl, copy_of(rhs._impl));
  return *this;
}
MessageRetractionHandle::MessageRetractionHandle(MessageRetractionHandleImplementation* impl)
    : _impl(impl) {}
MessageRetractionHandle::MessageRetractionHandle(VariableLengthData const& encodedValue)
    : _impl(nullptr) {
  const rink::rti::RetractionHandle handle = decoded(encodedValue);
  if (handle) _impl = new MessageRetractionHandleImplementation{handle};
}
bool MessageRetractionHandle::operator==(MessageRetractionHandle const& rhs) const {
  return value_of(_impl) == value_of(rhs._impl);
}
bool MessageRetractionHandle::operator<(MessageRetractionHandle const& rhs) const {
  const rink::rti::RetractionHandle one = value_of(_impl), other = value_of(rhs._impl);
  return std::tie(one.sender, one.number, one.time) <
         std::tie(other.sender, other.number, other.time);
}
long MessageRetractionHandle::hash() const {
  const rink::rti::RetractionHandle handle = value_of(_impl);
  return static_cast<long>(handle.number * 31 + handle.sender.value);
}
std::wstring MessageRetractionHandle::toString() const {
  const rink::rti::RetractionHandle handle = value_of(_impl);
  return isValid() ? std::to_wstring(handle.sender.value) + L"." + std::to_wstring(handle.number)
                   : L"invalid";
}
RINK_DEFINE_HANDLE_ENCODING(MessageRetractionHandle, bytes_of, retraction_size)

MessageRetractionHandle MessageRetractionHandleFriend::make(
    const rink::rti::RetractionHandle& handle) {
  return MessageRetractionHandle(handle ? new MessageRetractionHandleImplementation{handle}
                                        : nullptr);
}
rink::rti::RetractionHandle MessageRetractionHandleFriend::value(
    MessageRetractionHandle const& handle) {
  return value_of(handle.getImplementation());
}

#undef RINK_DEFINE_HANDLE
#undef RINK_DEFINE_HANDLE_ENCODING

}  // namespace rti1516e

namespace rink::standard {

rti::AttributeSet to_core(const rti1516e::AttributeHandleSet& attributes) {
  rti::AttributeSet set;
  for (const rti1516e::AttributeHandle& each : attributes) {
    const rti::AttributeHandle attribute = to_core(each);
    if (attribute.value >= rti::attribute_max)
      throw rti1516e::AttributeNotDefined(L"no class has the attribute " + each.toString());
    set.insert(attribute);
  }
  return set;
}

rti::DimensionSet to_core(const rti1516e::DimensionHandleSet& dimensions) {
  rti::DimensionSet set;
  for (const rti1516e::DimensionHandle& each : dimensions) {
    const rti::DimensionHandle dimension = to_core(each);
    if (dimension.value >= rti::dimension_max)
      throw rti1516e::InvalidDimensionHandle(L"no dimension has the handle " + each.toString());
    set.insert(dimension);
  }
  return set;
}

std::vector<rti::FederateHandle> to_core(const rti1516e::FederateHandleSet& federates) {
  std::vector<rti::FederateHandle> all;
  all.reserve(federates.size());
  for (const rti1516e::FederateHandle& each : federates) all.push_back(to_core(each));
  return all;
}

std::vector<rti::RegionHandle> to_core(const rti1516e::RegionHandleSet& regions) {
  std::vector<rti::RegionHandle> all;
  all.reserve(regions.size());
  for (const rti1516e::RegionHandle& each : regions) all.push_back(to_core(each));
  return all;
}

std::vector<rti::AttributeRegions> to_core(
    const rti1516e::AttributeHandleSetRegionHandleSetPairVector& pairs) {
  std::vector<rti::AttributeRegions> all;
  all.reserve(pairs.size());
  for (const auto& [attributes, regions] : pairs)
    all.push_back({to_core(attributes), to_core(regions)});
  return all;
}

rti1516e::AttributeHandleSet to_standard(rti::AttributeSet attributes) {
  rti1516e::AttributeHandleSet set;
  attributes.for_each([&](rti::AttributeHandle each) { set.insert(set.end(), to_standard(each)); });
  return set;
}

rti1516e::DimensionHandleSet to_standard(rti::DimensionSet dimensions) {
  rti1516e::DimensionHandleSet set;
  dimensions.for_each([&](rti::DimensionHandle each) { set.insert(set.end(), to_standard(each)); });
  return set;
}

}  // namespace rink::standard
