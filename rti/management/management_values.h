// Values of the management object model: how the RTI writes them, and how a federate that
// subscribes to it reads them.
#pragma once

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "rti/handles.h"
#include "rti/wire/stream.h"

namespace rink::rti {

/// Appends values as the standard encodes them, big-endian; one of varying size follows its length
/// [bytes], a little-endian u32, as everywhere on the wire.
class ManagementWriter {
 public:
  explicit ManagementWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  /// HLAcount, HLAseconds and HLAboolean: HLAinteger32BE; greater values are clamped.
  void count(std::uint64_t value) {
    constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
    big_endian(value < most ? value : most, 4);
  }
  /// HLAhandle: u32.
  void handle(std::uint32_t value) { big_endian(value, 4); }
  /// HLAlogicalTime and HLAtimeInterval: HLAfloat64BE [s].
  void time(double value) { big_endian(std::bit_cast<std::uint64_t>(value), 8); }
  /// HLAunicodeString: UTF-8.
  void text(std::string_view value) {
    Bytes text = std::as_bytes(std::span(value));
    Writer(bytes_).bytes<std::uint32_t>(text, text.size());
  }
  /// HLAhandleList: u32 each.
  void handles(const std::vector<std::uint32_t>& values) {
    auto size = static_cast<std::uint32_t>(4 * values.size());
    Writer(bytes_).number(size);
    for (const std::uint32_t each : values) handle(each);
  }

 private:
  void big_endian(std::uint64_t value, unsigned size) {
    assert(size == 8 || (size < 8 && value >> 8 * size == 0));
    while (size-- > 0) bytes_.push_back(static_cast<std::byte>(value >> 8 * size & 0xff));
  }

  std::vector<std::byte>& bytes_;
};

/// Reads values one after the other. Values that are cut short read as zeros and empty texts, and
/// clear `is_whole`.
class ManagementReader {
 public:
  explicit ManagementReader(Bytes bytes) : reader_(bytes) {}

  std::int32_t count() { return static_cast<std::int32_t>(big_endian(4)); }
  std::uint32_t handle() { return static_cast<std::uint32_t>(big_endian(4)); }
  double time() { return std::bit_cast<double>(big_endian(8)); }
  std::string_view text() {
    const Bytes found = varying();
    return {reinterpret_cast<const char*>(found.data()), found.size()};
  }
  std::vector<std::uint32_t> handles() {
    ManagementReader list(varying());
    std::vector<std::uint32_t> found;
    while (!list.is_at_end() && list.is_whole()) found.push_back(list.handle());
    is_whole_ = is_whole_ && list.is_whole();
    return found;
  }
  bool is_whole() const { return is_whole_; }
  bool is_at_end() const { return reader_.is_at_end(); }

 private:
  Bytes varying() {
    Bytes found;
    is_whole_ = is_whole_ && reader_.bytes<std::uint32_t>(found, reader_.left());
    return found;
  }
  std::uint64_t big_endian(std::size_t size) {
    Bytes found;
    is_whole_ = is_whole_ && reader_.rest(found, size);
    std::uint64_t value = 0;
    for (const std::byte each : found) value = value << 8 | std::to_integer<std::uint64_t>(each);
    return value;
  }

  Reader reader_;
  bool is_whole_ = true;
};

}  // namespace rink::rti
