// Compares states by their bytes, eight at a time.
#include "game/peer/standby/packed_states.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "game/physics/snapshot_stream.h"

namespace rink::peer {

namespace {

constexpr std::size_t word_size = 8;

void put_state(BodyState state, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  physics::SnapshotWriter writer(bytes);
  exchange(writer, state);
  // One bit of a mask for each word.
  assert(bytes.size() <= 64 * word_size);
}

std::size_t word_count(std::size_t bytes) { return (bytes + word_size - 1) / word_size; }

/// The last word of a state may be short.
std::span<std::uint8_t> word_at(std::vector<std::uint8_t>& bytes, std::size_t word) {
  const std::size_t first = word * word_size;
  return std::span(bytes).subspan(first, std::min(word_size, bytes.size() - first));
}

bool read_words(ByteReader& reader, std::uint64_t mask, std::vector<std::uint8_t>& state) {
  const std::size_t count = word_count(state.size());
  if (count < 64 && mask >> count != 0) return false;
  for (std::size_t word = 0; word < count; ++word) {
    if ((mask >> word & 1) == 0) continue;
    const std::span<std::uint8_t> bytes = word_at(state, word);
    std::uint64_t value = 0;
    if (!reader.part(value, bytes.size())) return false;
    std::memcpy(bytes.data(), &value, bytes.size());
  }
  return true;
}

}  // namespace

void StatePacker::add(std::uint32_t number, const BodyState& state) {
  assert(number >= next_ && scene_.has_body(number));
  put_state(state, state_), put_state(scene_.still(number), still_);
  assert(state_.size() == still_.size());
  std::uint64_t mask = 0;
  for (std::size_t word = 0; word < word_count(state_.size()); ++word)
    if (!std::ranges::equal(word_at(state_, word), word_at(still_, word)))
      mask |= std::uint64_t{1} << word;
  physics::SnapshotWriter writer(packed_);
  std::uint32_t further = number - next_;
  writer.varint(further), writer.varint(mask);
  for (std::size_t word = 0; word < word_count(state_.size()); ++word) {
    if ((mask >> word & 1) == 0) continue;
    const std::span<std::uint8_t> bytes = word_at(state_, word);
    packed_.insert(packed_.end(), bytes.begin(), bytes.end());
  }
  next_ = number + 1;
}

std::vector<std::uint8_t> StatePacker::take() {
  next_ = 0;
  return std::exchange(packed_, {});
}

bool unpack(std::span<const std::uint8_t> bytes, const Validator& scene,
            const std::function<void(const Handover::Body&)>& visit) {
  std::vector<std::uint8_t> state;
  ByteReader reader(std::as_bytes(bytes));
  for (std::uint64_t next = 0; !reader.is_at_end(); ++next) {
    std::uint32_t further = 0;
    std::uint64_t mask = 0;
    if (!reader.varint(further)) return false;
    next += further;
    if (next > 0xffffffffu || !scene.has_body(static_cast<std::uint32_t>(next))) return false;
    Handover::Body body;
    body.number = static_cast<std::uint32_t>(next);
    put_state(scene.still(body.number), state);
    if (!reader.varint(mask) || !read_words(reader, mask, state)) return false;
    ByteReader state_reader(std::as_bytes(std::span(state)));
    if (!exchange(state_reader, body.state)) return false;
    visit(body);
  }
  return true;
}

std::optional<std::vector<Handover::Body>> unpacked(std::span<const std::uint8_t> bytes,
                                                    const Validator& scene) {
  std::vector<Handover::Body> bodies;
  if (!unpack(bytes, scene, [&](const Handover::Body& body) { bodies.push_back(body); }))
    return std::nullopt;
  return bodies;
}

}  // namespace rink::peer
