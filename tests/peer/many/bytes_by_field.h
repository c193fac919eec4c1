// Counts what a node sends, by message and field.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "game/peer/messages.h"
#include "game/peer/standby/part_record.h"
#include "game/peer/verdict_tree.h"
#include "im/basics/byte_stream.h"

namespace rink::peer::test {

/// Bytes, by names as in "claims/bodies"; those of heads, counts and checksums are "other".
class BytesByField {
 public:
  const std::map<std::string, std::uint64_t>& bytes() const { return bytes_; }
  /// Of all fields whose names begin so.
  std::uint64_t of(std::string_view message) const {
    std::uint64_t sum = 0;
    for (const auto& [field, count] : bytes_) sum += field.starts_with(message) ? count : 0;
    return sum;
  }
  BytesByField& operator+=(const BytesByField& other) {
    for (const auto& [field, count] : other.bytes_) bytes_[field] += count;
    return *this;
  }

  /// One that a session has sent.
  void count(std::span<const std::uint8_t> bytes) {
    if (Claims claims; read(bytes, claims))
      count("claims/", bytes, {{"bodies", part(claims.bodies)}, {"flights", part(claims.flights)}});
    else if (Handover handover; read(bytes, handover))
      count("handover/", bytes,
            {{"states", part(handover.bodies)},
             {"flights", part(handover.free_flights)},
             {"contacts", part(handover.rest_contacts)}});
    else if (Verdict verdict; read(bytes, verdict)) count("verdict/", bytes, {});
    else if (VerdictBundle bundle; read(bytes, bundle)) count("verdict/", bytes, {});
    else if (PartRecord record; read(bytes, record))
      count("record/", bytes,
            {{"repeated states", record.repeated.states.size()},
             {"states", record.committed.states.size()},
             {"dropped", numbers(record.repeated.dropped) + numbers(record.committed.dropped)},
             {"known", numbers(record.committed.known)},
             {"contacts",
              part(record.repeated.rest_contacts) + part(record.committed.rest_contacts)}});
    else if (SnapshotPiece piece; read(bytes, piece)) count("snapshot/", bytes, {});
    else count("rest/", bytes, {});
  }

 private:
  template <class Item>
  static std::uint64_t part(std::vector<Item>& list) {
    ByteMeasurer measurer;
    if (!list.empty()) exchange_part(measurer, true, list);
    return measurer.size();
  }
  static std::uint64_t numbers(std::vector<std::uint32_t>& list) {
    ByteMeasurer measurer;
    if (!list.empty()) exchange_numbers(measurer, true, list);
    return measurer.size();
  }
  void count(const std::string& message, std::span<const std::uint8_t> bytes,
             std::initializer_list<std::pair<const char*, std::uint64_t>> fields) {
    std::uint64_t rest = bytes.size();
    for (const auto& [field, size] : fields) bytes_[message + field] += size, rest -= size;
    bytes_[message + "other"] += rest;
  }

  std::map<std::string, std::uint64_t> bytes_;
};

}  // namespace rink::peer::test
