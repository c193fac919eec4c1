// Puts a snapshot into a subdomain, and does there what the part's owner did.
#include "game/peer/standby/part_replay.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "game/peer/standby/packed_states.h"
#include "game/peer/window/share.h"

namespace rink::peer {

namespace {

constexpr const char* no_states = "sends what are no states of bodies";

/// The keys of a run in the order in which they took effect: by time, then bat.
std::vector<Key> keys_of(const PartRecord& record) {
  std::vector<Key> keys = record.other_keys;
  keys.insert(keys.end(), record.own_keys.begin(), record.own_keys.end());
  std::ranges::stable_sort(keys, {}, [](const Key& key) { return std::pair(key.time, key.bat); });
  return keys;
}

std::string fault_of_states(std::span<const std::uint8_t> states,
                            std::vector<RestContact> rest_contacts, const Validator& scene,
                            double time) {
  auto bodies = unpacked(states, scene);
  if (!bodies) return no_states;
  Handover message;
  message.bodies = std::move(*bodies), message.rest_contacts = std::move(rest_contacts);
  return scene.fault_of_part(message, time);
}

std::string fault_of_input(const PartInput& input, const Validator& scene, double time) {
  for (const std::uint32_t body : input.dropped)
    if (!scene.has_body(body))
      return "gives away body " + std::to_string(body) + ", which does not exist";
  return fault_of_states(input.states, input.rest_contacts, scene, time);
}

/// A liar's copy may lack contacts of its own bodies: whoever handed these on would be named for
/// it.
void release_unheld(Part& part) {
  for (auto& [body, state] : part.bodies)
    for (const int axis : {0, 1})
      if (physics::Subdomain::is_held_along(state, axis) &&
          !is_held_by(part.rest_contacts, body, axis))
        physics::release(state, axis);
}

}  // namespace

std::string fault_of(const PartRecord& record, const Validator& scene, double start, double end) {
  for (const auto& [input, time] : {std::pair(&record.repeated, start), {&record.committed, end}})
    if (std::string fault = fault_of_input(*input, scene, time); !fault.empty()) return fault;
  for (const std::vector<Key>* keys : {&record.own_keys, &record.inherited})
    if (std::string fault = scene.fault_of_log(*keys, end); !fault.empty()) return fault;
  for (const std::vector<Key>* keys : {&record.other_keys, &record.pending})
    if (std::string fault = scene.fault_of(*keys); !fault.empty()) return fault;
  return {};
}

std::string fault_of(const PartSnapshot& snapshot, const Validator& scene, double time) {
  for (const std::string& fault :
       {scene.fault_of(snapshot.pending), scene.fault_of_log(snapshot.log, time)})
    if (!fault.empty()) return fault;
  return fault_of_states(snapshot.states, snapshot.rest_contacts, scene, time);
}

PartReplay::PartReplay(const physics::WorldSpec& spec, const Validator& scene,
                       const PartSnapshot& snapshot, double time)
    : scene_(scene), subdomain_(spec, scene.body_count()), pending_(snapshot.pending) {
  assert(std::isfinite(time) && time >= 0.0);
  // Its events are counted, not listed: nobody asks which they were.
  subdomain_.set_rooms({physics::Journal::Room{-infinity, -infinity, infinity, infinity}}, 0.0);
  subdomain_.advance(time);
  enter(
      {.states = snapshot.states, .sets_contacts = true, .rest_contacts = snapshot.rest_contacts});
}

void PartReplay::enter(const PartInput& input) {
  std::vector<RestContact> contacts =
      input.sets_contacts ? input.rest_contacts : subdomain_.rest_contacts();
  for (const std::uint32_t body : input.dropped) subdomain_.drop(body);
  const auto bodies = unpacked(input.states, scene_);
  assert(bodies);
  for (const auto& [body, state] : *bodies) subdomain_.put(body, state);
  for (const std::uint32_t body : subdomain_.take_entered()) subdomain_.set_room(body, 1);
  for (const auto& [body, state] : *bodies) subdomain_.set_room(body, 1);
  subdomain_.set_rest_contacts(sound_contacts(std::move(contacts), subdomain_));
  subdomain_.begin_window();
}

/// As Share::play, but for keys of a bat that is not there, of which the truth has none.
void PartReplay::play(const PartRecord& record) {
  if (!record.repeated.is_empty()) enter(record.repeated);
  for (const Key& key : keys_of(record)) {
    if (!subdomain_.is_there(key.bat)) continue;
    subdomain_.advance(std::clamp(key.time, subdomain_.world().now(), record.time));
    subdomain_.set_thrust(key.bat, key.thrust);
  }
  assert(record.time >= subdomain_.world().now());
  subdomain_.advance(record.time);
  enter(record.committed);
  pending_ = record.pending;
}

Part PartReplay::part(const Division& division, PeerNumber peer) const {
  const physics::PartWorld& world = subdomain_.world();
  Part part{.time = world.now(), .keys = pending_};
  const auto is_own = [&](physics::Partner body) {
    return body < physics::partner::field_parts && subdomain_.is_there(body) &&
           division.owner_of(world.position({body})) == peer;
  };
  for (std::uint32_t body = 0; body < scene_.body_count(); ++body)
    if (is_own(body)) part.bodies.push_back({body, subdomain_.state(body)});
  for (const RestContact& rest : subdomain_.rest_contacts())
    if (is_own(rest.low) || is_own(rest.high)) part.rest_contacts.push_back(rest);
  release_unheld(part);
  return part;
}

}  // namespace rink::peer
