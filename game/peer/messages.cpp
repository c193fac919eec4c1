// Writes, reads and measures messages.
#include "game/peer/messages.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <tuple>

#include "game/peer/message_bytes.h"

namespace rink::peer {

namespace {

/// The checksum of messages of every window, most of which are shorter than a longer checksum would
/// be.
constexpr std::size_t short_checksum = 4;

/// The bytes of a state, without memory of their own; no number takes more room as bytes.
class StateBytes {
 public:
  std::size_t size() const { return size_; }
  std::uint8_t* data() { return bytes_.data(); }
  void resize(std::size_t size) {
    assert(size <= bytes_.size());
    size_ = size;
  }
  bool operator==(const StateBytes&) const = default;

 private:
  std::array<std::uint8_t, sizeof(BodyState)> bytes_{};
  std::size_t size_ = 0;
};

template <class Message>
std::size_t size_of(Message& message) {
  ByteMeasurer measurer;
  [[maybe_unused]] const bool is_sound = exchange(measurer, message);
  assert(is_sound && "what we say, others must be able to take");
  return measurer.size() + short_checksum;
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
  StateBytes bytes_a, bytes_b;
  ByteWriter writer_a(bytes_a), writer_b(bytes_b);
  exchange(writer_a, a), exchange(writer_b, b);
  return bytes_a == bytes_b;
}

bool are_same(const std::vector<RestContact>& a, const std::vector<RestContact>& b) {
  const auto parts = [](const RestContact& rest) {
    return std::tuple(rest.low, rest.high, rest.axis, std::bit_cast<std::uint64_t>(rest.pull_time),
                      std::bit_cast<std::uint64_t>(rest.force),
                      std::bit_cast<std::uint64_t>(rest.turn_time),
                      std::bit_cast<std::uint64_t>(rest.age.time), rest.age.follows_keys,
                      rest.age.lower, rest.age.higher, rest.age.rank);
  };
  return std::ranges::equal(a, b, {}, parts, parts);
}

}  // namespace rink::peer
