// Reads update messages, body by body.
#include "game/net/peer/interest/peer_replicas.h"

#include <cmath>

#include "game/replication/attributes.h"
#include "game/replication/trajectory_codec.h"
#include "rti/wire/stream.h"

namespace rink::game {

namespace {

/// The next body of a message; false if there is no whole one.
bool take(rti::Reader& reader, bool has_trajectories, BodyUpdate& update) {
  std::uint64_t head = 0;
  if (!reader.varint(head) || head >> 2 > 0xffffffffu) return false;
  update = {.body = static_cast<std::uint32_t>(head >> 2),
            .form = static_cast<BodyUpdate::Form>(head & 3),
            .motion = {}};
  const bool has_motion =
      update.form == BodyUpdate::Form::motion || update.form == BodyUpdate::Form::motion_and_felt;
  if ((update.form == BodyUpdate::Form::felt || update.form == BodyUpdate::Form::motion_and_felt) &&
      !reader.varint(update.felt))
    return false;
  if (!has_motion) return true;
  const std::optional<std::size_t> size =
      has_trajectories ? TrajectoryCodec().size(reader.rest()) : std::optional(sizeof(Position));
  return size && reader.rest(update.motion, *size);
}

}  // namespace

bool PeerReplicas::receive(peer::PeerNumber from, rti::Bytes message, double windows_per_s) {
  rti::Reader reader(message);
  std::uint32_t window = 0;
  if (!reader.varint(window)) return false;
  while (!reader.is_at_end()) {
    const std::size_t before = reader.left();
    BodyUpdate update;
    if (!take(reader, has_trajectories_, update) || update.body >= kinds_.size() ||
        !apply(from, update, window / windows_per_s))
      return false;
    received_.push_back({update.body, static_cast<std::uint32_t>(before - reader.left())});
  }
  return true;
}

bool PeerReplicas::apply(peer::PeerNumber from, const BodyUpdate& update, double time) {
  if (update.form == BodyUpdate::Form::felt || update.form == BodyUpdate::Form::motion_and_felt)
    felt_ = std::max(felt_, update.felt);
  if (update.form == BodyUpdate::Form::left && this->replica(update.body).source == from)
    forget_body(update.body);
  if (update.motion.empty()) return true;
  Replica replica;
  rti::Reader reader(update.motion);
  if (has_trajectories_) {
    std::vector<std::byte> value;
    Trajectory trajectory;
    if (!TrajectoryCodec().decode(update.motion, time, value)) return false;
    rti::Reader whole(value);
    if (!exchange(whole, trajectory)) return false;
    replica.motion = motion_of(trajectory, drag_.of(kinds_[update.body]));
  } else {
    Position position;
    if (!exchange(reader, position) || !std::isfinite(position.x) || !std::isfinite(position.y))
      return false;
    replica.motion.time = time;
    replica.motion.position = {static_cast<double>(position.x), static_cast<double>(position.y)};
  }
  replica.source = from;
  replica.is_there = true;
  replicas_[update.body] = replica;
  return true;
}

void PeerReplicas::forget(peer::PeerNumber source) {
  for (auto& [body, replica] : replicas_)
    if (replica.source == source) replica.is_there = false;
}

void PeerReplicas::forget_body(std::uint32_t body) {
  if (const auto found = replicas_.find(body); found != replicas_.end())
    found->second.is_there = false;
}

void PeerReplicas::drop_forgotten() {
  std::erase_if(replicas_, [](const auto& entry) { return !entry.second.is_there; });
}

const Replica& PeerReplicas::replica(std::uint32_t body) const {
  static const Replica none;
  const auto found = replicas_.find(body);
  return found == replicas_.end() ? none : found->second;
}

}  // namespace rink::game
