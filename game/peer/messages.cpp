// Writes, reads and measures messages.
#include "game/peer/messages.h"

#include <array>
#include <cassert>

#include "game/peer/message_bytes.h"
#include "game/physics/snapshot_stream.h"

namespace rink::peer {

namespace {

/// The checksum of messages of every window, most of which are shorter than a longer checksum would
/// be.
constexpr int short_checksum = 4;

/// Counts bytes.
class Measure : public physics::SnapshotStream<Measure> {
 public:
  bool word(std::uint64_t&, int byte_count) {
    return byte_count_ += static_cast<std::size_t>(byte_count), true;
  }
  static std::uint64_t count_max() { return 0xffffffff; }
  std::size_t byte_count() const { return byte_count_; }

 private:
  std::size_t byte_count_ = 0;
};

/// Writes words into memory that is large enough.
class Scribe : public physics::SnapshotStream<Scribe> {
 public:
  explicit Scribe(std::uint8_t* to) : begin_(to), to_(to) {}
  std::size_t written() const { return static_cast<std::size_t>(to_ - begin_); }
  bool word(std::uint64_t& value, int byte_count) {
    for (int byte = 0; byte < byte_count; ++byte)
      to_[byte] = static_cast<std::uint8_t>(value >> (8 * byte));
    return to_ += byte_count, true;
  }
  static std::uint64_t count_max() { return 0xffffffff; }

 private:
  const std::uint8_t* begin_;
  std::uint8_t* to_;
};

template <class Message>
std::size_t size_of(Message& message) {
  Measure measure;
  [[maybe_unused]] const bool is_sound = exchange(measure, message);
  assert(is_sound && "what we say, others must be able to take");
  return measure.byte_count() + short_checksum;
}

}  // namespace

std::vector<std::uint8_t> written(Handover message) { return bytes_from(message, short_checksum); }
std::vector<std::uint8_t> written(Claims message) { return bytes_from(message, short_checksum); }
std::vector<std::uint8_t> written(Verdict message) { return bytes_from(message, short_checksum); }
bool read(std::span<const std::uint8_t> bytes, Handover& message) {
  return read_whole(bytes, message, short_checksum);
}
bool read(std::span<const std::uint8_t> bytes, Claims& message) {
  return read_whole(bytes, message, short_checksum);
}
bool read(std::span<const std::uint8_t> bytes, Verdict& message) {
  return read_whole(bytes, message, short_checksum);
}

std::size_t measured(Handover& message) { return size_of(message); }
std::size_t measured(Claims& message) { return size_of(message); }
std::size_t measured(Verdict& message) { return size_of(message); }

std::vector<std::uint8_t> bytes_of(BodyState state) { return bytes_from(state); }

bool are_same(BodyState a, BodyState b) {
  std::array<std::uint8_t, sizeof(BodyState)> bytes_a{},
      bytes_b{};  // no number takes more room as bytes
  Scribe scribe_a(bytes_a.data()), scribe_b(bytes_b.data());
  exchange(scribe_a, a), exchange(scribe_b, b);
  assert(scribe_a.written() == scribe_b.written() && scribe_a.written() <= bytes_a.size());
  return bytes_a == bytes_b;
}

}  // namespace rink::peer
