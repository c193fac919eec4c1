// Reads update messages, body by body.
#include "game/net/peer/interest/player_picture.h"

#include <cmath>

#include "game/replication/attributes.h"
#include "game/replication/trajectory_codec.h"
#include "rti/wire/stream.h"

namespace rink::game {

namespace {

/// The next body of a message; false if there is no whole one.
bool take(rti::Reader& reader, bool has_trajectories, ToldOf& told) {
  std::uint64_t head = 0;
  if (!reader.varint(head) || head >> 2 > 0xffffffffu) return false;
  told = {.body = static_cast<std::uint32_t>(head >> 2),
          .form = static_cast<ToldOf::Form>(head & 3),
          .motion = {}};
  const bool has_motion =
      told.form == ToldOf::Form::motion || told.form == ToldOf::Form::motion_and_felt;
  if ((told.form == ToldOf::Form::felt || told.form == ToldOf::Form::motion_and_felt) &&
      !reader.varint(told.felt))
    return false;
  if (!has_motion) return true;
  const std::optional<std::size_t> size =
      has_trajectories ? TrajectoryCodec().size(reader.rest()) : std::optional(sizeof(Position));
  return size && reader.rest(told.motion, *size);
}

}  // namespace

bool PlayerPicture::hear(peer::PeerNumber from, rti::Bytes message, double windows_per_s) {
  rti::Reader reader(message);
  std::uint32_t window = 0;
  if (!reader.varint(window)) return false;
  while (!reader.is_at_end()) {
    const std::size_t before = reader.left();
    ToldOf told;
    if (!take(reader, has_trajectories_, told) || told.body >= kinds_.size() ||
        !apply(from, told, window / windows_per_s))
      return false;
    heard_.push_back({told.body, static_cast<std::uint32_t>(before - reader.left())});
  }
  return true;
}

bool PlayerPicture::apply(peer::PeerNumber from, const ToldOf& told, double time) {
  if (told.form == ToldOf::Form::felt || told.form == ToldOf::Form::motion_and_felt)
    felt_ = std::max(felt_, told.felt);
  if (told.form == ToldOf::Form::left && this->belief(told.body).source == from)
    forget_body(told.body);
  if (told.motion.empty()) return true;
  Belief belief;
  rti::Reader reader(told.motion);
  if (has_trajectories_) {
    std::vector<std::byte> value;
    Trajectory trajectory;
    if (!TrajectoryCodec().decode(told.motion, time, value)) return false;
    rti::Reader whole(value);
    if (!exchange(whole, trajectory)) return false;
    belief.motion = motion_of(trajectory, drag_.of(kinds_[told.body]));
  } else {
    Position position;
    if (!exchange(reader, position) || !std::isfinite(position.x) || !std::isfinite(position.y))
      return false;
    belief.motion.time = time;
    belief.motion.position = {static_cast<double>(position.x), static_cast<double>(position.y)};
  }
  belief.source = from;
  belief.is_there = true;
  beliefs_[told.body] = belief;
  return true;
}

void PlayerPicture::forget(peer::PeerNumber source) {
  for (auto& [body, belief] : beliefs_)
    if (belief.source == source) belief.is_there = false;
}

void PlayerPicture::forget_body(std::uint32_t body) {
  if (const auto found = beliefs_.find(body); found != beliefs_.end())
    found->second.is_there = false;
}

void PlayerPicture::drop_forgotten() {
  std::erase_if(beliefs_, [](const auto& entry) { return !entry.second.is_there; });
}

const Belief& PlayerPicture::belief(std::uint32_t body) const {
  static const Belief none;
  const auto found = beliefs_.find(body);
  return found == beliefs_.end() ? none : found->second;
}

}  // namespace rink::game
