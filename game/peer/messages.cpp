// Messages to bytes and back, through the stream that snapshots of worlds go through.
#include "game/peer/messages.h"

#include <array>

#include "game/peer/mirror.h"
#include "game/peer/scoring.h"
#include "game/peer/session.h"
#include "game/physics/snapshot_stream.h"

namespace rink::peer {

namespace {

constexpr std::size_t checksum_size = 8;

/// Counts bytes.
class Measure : public physics::SnapshotStream<Measure> {
 public:
  bool word(std::uint64_t&, int byte_count) { return byte_count_ += static_cast<std::size_t>(byte_count), true; }
  static std::uint64_t count_max() { return 0xffffffff; }
  std::size_t byte_count() const { return byte_count_; }

 private:
  std::size_t byte_count_ = 0;
};

/// Puts words into room that is there.
class Scribe : public physics::SnapshotStream<Scribe> {
 public:
  explicit Scribe(std::uint8_t* to) : to_(to) {}
  bool word(std::uint64_t& value, int byte_count) {
    for (int byte = 0; byte < byte_count; ++byte) to_[byte] = static_cast<std::uint8_t>(value >> (8 * byte));
    return to_ += byte_count, true;
  }
  static std::uint64_t count_max() { return 0xffffffff; }

 private:
  std::uint8_t* to_;
};

template <class Message>
std::vector<std::uint8_t> bytes_from(Message& message) {
  physics::SnapshotWriter writer;
  exchange(writer, message);
  return writer.finish();
}

template <class Message>
bool read_whole(std::span<const std::uint8_t> bytes, Message& message) {
  physics::SnapshotReader reader(bytes);
  return reader.is_intact() && exchange(reader, message) && reader.is_at_end();
}

template <class Item>
std::size_t size_of() {
  Measure measure;
  Item item;
  exchange(measure, item);
  return measure.byte_count();
}

}  // namespace

std::vector<std::uint8_t> written(Arrivals message) { return bytes_from(message); }
std::vector<std::uint8_t> written(Claims message) { return bytes_from(message); }
std::vector<std::uint8_t> written(Verdict message) { return bytes_from(message); }
std::vector<std::uint8_t> written(PartChange message) { return bytes_from(message); }
std::vector<std::uint8_t> written(Loss message) { return bytes_from(message); }
std::vector<std::uint8_t> written(FaceOffWord message) { return bytes_from(message); }
std::vector<std::uint8_t> written(Entry message) { return bytes_from(message); }
bool read(std::span<const std::uint8_t> bytes, Entry& message) { return read_whole(bytes, message); }
bool read(std::span<const std::uint8_t> bytes, PartChange& message) { return read_whole(bytes, message); }
bool read(std::span<const std::uint8_t> bytes, Loss& message) { return read_whole(bytes, message); }
bool read(std::span<const std::uint8_t> bytes, FaceOffWord& message) { return read_whole(bytes, message); }
bool read(std::span<const std::uint8_t> bytes, Arrivals& message) { return read_whole(bytes, message); }
bool read(std::span<const std::uint8_t> bytes, Claims& message) { return read_whole(bytes, message); }
bool read(std::span<const std::uint8_t> bytes, Verdict& message) { return read_whole(bytes, message); }

std::size_t measured(const Arrivals& m) {
  static const std::size_t empty = size_of<Arrivals>(), body = size_of<Arrivals::Body>(), flown = size_of<Flown>(), hold = size_of<Hold>(), key = size_of<Key>();
  static const std::size_t glimpse = size_of<Glimpse>(), puck = size_of<Glimpse::Puck>();
  std::size_t seen = m.glimpses.size() * glimpse;
  for (const Glimpse& shown : m.glimpses) seen += shown.pucks.size() * puck;
  return empty + m.bodies.size() * body + m.flown.size() * flown + m.holds.size() * hold + m.keys.size() * key + seen + checksum_size;
}
std::size_t measured(const Claims& m) {
  static const std::size_t empty = size_of<Claims>(), body = size_of<Claims::Body>(), flight = size_of<ClaimedFlight>(), press = size_of<Press>();
  return empty + m.bodies.size() * body + m.flights.size() * flight + m.presses.size() * press + checksum_size;
}
std::size_t measured(const Verdict& m) {
  static const std::size_t empty = size_of<Verdict>(), goal = size_of<Goal>();
  std::size_t said = 0;
  if (!m.admission.is_empty()) {
    Measure measure;
    Admission admission = m.admission;
    exchange(measure, admission);
    said = measure.byte_count();
  }
  return empty + m.listed.size() + m.goals.size() * goal + said + checksum_size;
}

std::vector<std::uint8_t> bytes_of(BodyState state) { return bytes_from(state); }

bool are_same(BodyState a, BodyState b) {
  std::array<std::uint8_t, sizeof(BodyState)> bytes_a{}, bytes_b{};  // no number takes more room as bytes
  Scribe scribe_a(bytes_a.data()), scribe_b(bytes_b.data());
  exchange(scribe_a, a), exchange(scribe_b, b);
  return bytes_a == bytes_b;
}

}  // namespace rink::peer
