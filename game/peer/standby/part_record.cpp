// Writes and reads what a standby is told.
#include "game/peer/standby/part_record.h"

#include "game/peer/message_bytes.h"

namespace rink::peer {

namespace {

/// As that of the other messages of every window.
constexpr std::size_t record_checksum = 4;

}  // namespace

std::vector<std::uint8_t> written(PartRecord message) {
  return bytes_from(message, record_checksum);
}
std::vector<std::uint8_t> written(PartSnapshot message) { return bytes_from(message); }
std::vector<std::uint8_t> written(SnapshotPiece message) {
  return bytes_from(message, record_checksum);
}
bool read(std::span<const std::uint8_t> bytes, PartRecord& message) {
  return read_whole(bytes, message, record_checksum);
}
bool read(std::span<const std::uint8_t> bytes, PartSnapshot& message) {
  return read_whole(bytes, message);
}
bool read(std::span<const std::uint8_t> bytes, SnapshotPiece& message) {
  return read_whole(bytes, message, record_checksum);
}

}  // namespace rink::peer
