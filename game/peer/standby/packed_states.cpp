// Compares states field by field.
#include "game/peer/standby/packed_states.h"

#include <cassert>
#include <utility>

#include "game/physics/snapshot_stream.h"

namespace rink::peer {

void StatePacker::add(std::uint32_t number, const BodyState& state) {
  assert(number >= next_ && scene_.has_body(number));
  physics::SnapshotWriter writer(packed_);
  std::uint32_t further = number - next_;
  BodyState changed = state;
  writer.varint(further), exchange_changes(writer, changed, scene_.still(number));
  next_ = number + 1;
}

std::vector<std::uint8_t> StatePacker::take() {
  next_ = 0;
  return std::exchange(packed_, {});
}

bool unpack(std::span<const std::uint8_t> bytes, const Validator& scene,
            const std::function<void(const Handover::Body&)>& visit) {
  ByteReader reader(std::as_bytes(bytes));
  for (std::uint64_t next = 0; !reader.is_at_end(); ++next) {
    std::uint32_t further = 0;
    if (!reader.varint(further)) return false;
    next += further;
    if (next > 0xffffffffu || !scene.has_body(static_cast<std::uint32_t>(next))) return false;
    Handover::Body body;
    body.number = static_cast<std::uint32_t>(next);
    if (!exchange_changes(reader, body.state, scene.still(body.number))) return false;
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
