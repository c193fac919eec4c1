// Says rounds, and turns their keys into those of the session.
#include "game/node/match/match_rounds.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "game/control/bat_controller.h"
#include "game/model/time_grid.h"
#include "game/net/peer/crowd.h"
#include "game/physics/snapshot_stream.h"
#include "game/physics/subdomain.h"
#include "im/basics/fnv_hash.h"

namespace rink::game {
namespace {

constexpr std::size_t check_size = 4;
constexpr std::uint64_t window_mask = 0x3f, keys_bit = 0x40, always_bit = 0x80;

/// Of the content and of the state together: either differs if it does.
std::uint64_t check_of(std::span<const std::uint8_t> content, std::uint64_t state) {
  Fnv64 hash;
  for (const std::uint8_t byte : content) hash.add(byte);
  for (int shift = 0; shift < 64; shift += 8) hash.add(static_cast<std::uint8_t>(state >> shift));
  const std::uint64_t sum = hash.value();
  return (sum ^ sum >> 32) & 0xffffffffULL;
}

/// Of another window than `round` is for it is false.
bool read(std::span<const std::uint8_t> content, Round& round) {
  ByteReader reader(std::as_bytes(content));
  std::uint8_t head = 0;
  if (!reader.number(head) || (head & always_bit) == 0 ||
      (head & window_mask) != (round.window & window_mask))
    return false;
  const bool has_keys = (head & keys_bit) != 0;
  return peer::exchange_part(reader, has_keys, round.keys) && reader.is_at_end() &&
         round.keys.size() <= Round::keys_max;
}

std::uint32_t code_of(const peer::Press& press) {
  const auto row = [](double along) { return along > 0.0 ? 2u : along < 0.0 ? 0u : 1u; };
  return press.input - 1u + 8u * (3u * row(press.thrust.y()) + row(press.thrust.x()));
}

std::uint32_t steps_from(double start, double time) {
  if (time <= start) return 0;
  return static_cast<std::uint32_t>(
      std::min(std::ceil((time - start) / key_grid), static_cast<double>(RoundKey::steps_max)));
}

bool holds(const NodeSeats& seats, peer::PeerNumber node, std::uint32_t player) {
  const auto holder = seats.holders().find(player);
  return holder != seats.holders().end() && holder->second == node;
}

}  // namespace

std::uint64_t state_of(const peer::Session& session) {
  Fnv64 hash;
  hash.add_word(physics::hash_of(session.peer().share().subdomain()));
  hash.add_word(std::uint64_t{session.scoring().left} << 32 | session.scoring().right);
  for (const physics::HalfStay& stay : session.scoring().halves.stays())
    hash.add_word(std::bit_cast<std::uint64_t>(stay.until));
  return hash.value();
}

std::vector<std::uint8_t> written(const Round& round, std::uint64_t state) {
  assert(round.keys.size() <= Round::keys_max);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(64);
  physics::SnapshotWriter writer(bytes);
  auto head = static_cast<std::uint8_t>((round.window & window_mask) | always_bit |
                                        (round.keys.empty() ? 0 : keys_bit));
  std::vector<RoundKey> keys = round.keys;
  writer.number(head), peer::exchange_part(writer, !keys.empty(), keys);
  std::uint64_t check = check_of(bytes, state);
  writer.part(check, check_size);
  return bytes;
}

std::string fault_of(std::span<const std::uint8_t> bytes, std::uint64_t state, Round& round) {
  const std::string window = std::to_string(round.window + 1);
  if (bytes.size() < check_size) return "said no round of window " + window;
  const auto content = bytes.first(bytes.size() - check_size);
  if (!read(content, round)) return "said no round of window " + window;
  std::uint64_t check = 0;
  ByteReader(std::as_bytes(bytes.last(check_size))).part(check, check_size);
  if (check == check_of(content, state)) return {};
  return "has another state than this node before window " + window + " of the match";
}

peer::Vector2 thrust_of(const RoundKey& key, double thrust) {
  assert(key.code < RoundKey::codes);
  const std::uint32_t direction = key.code / 8;
  return thrust * peer::Vector2(static_cast<double>(direction % 3) - 1.0,
                                static_cast<double>(direction / 3) - 1.0);
}

std::vector<RoundKey> MatchRounds::take_keys(const SharedGame& game, const NodeSeats& seats,
                                             double start) {
  std::vector<RoundKey> keys;
  std::vector<peer::Press> kept;
  for (const peer::Press& press : std::exchange(pressed_, {})) {
    const std::uint32_t player = *game.start().entity({press.bat}).player;
    if (keys.size() == Round::keys_max || !holds(seats, seats.number(), player))
      kept.push_back(press);
    else keys.push_back({player, code_of(press), steps_from(start, press.time)});
  }
  pressed_ = std::move(kept);
  return keys;
}

/// Whose state differs from most others' is wrong. Of two none can know which is.
std::vector<Round> MatchRounds::said_by_all(MatchMembers& members, Round own,
                                            std::uint64_t state) const {
  const std::vector<std::vector<std::uint8_t>> said = members.exchange(written(own, state));
  std::vector<Round> rounds(said.size(), Round{.window = window_});
  std::vector<std::pair<peer::PeerNumber, std::string>> faults;
  std::size_t count = 0;
  for (peer::PeerNumber from = 0; from < said.size(); ++from) {
    if (said[from].empty()) continue;
    ++count;
    if (from == members.number()) continue;
    const std::string fault = fault_of(said[from], state, rounds[from]);
    if (!fault.empty()) faults.emplace_back(from, fault), rounds[from].keys.clear();
  }
  rounds[members.number()] = std::move(own);
  if (faults.empty()) return rounds;
  if (members.is_surviving() && count > 2 && 2 * faults.size() >= count)
    throw peer::Halt("most others have another state than this node before window " +
                     std::to_string(window_ + 1) + " of the match: it halts, they may go on");
  for (const auto& [from, fault] : faults) {
    if (count <= 2) throw peer::ProtocolError("peer " + std::to_string(from) + " " + fault);
    if (!members.is_lost(from)) members.give_up(from, fault);
  }
  return rounds;
}

void MatchRounds::feel(peer::Press press, std::uint32_t player, peer::Session& session) {
  const InputEvent event = event_of(press.input, press.time, player);
  Felt& felt = felt_[player];
  press.time = std::max(press.time, felt.released_s);
  felt.held.set(event.key, event.kind == InputKind::key_down);
  felt.last = std::max(felt.last, press.time);
  session.peer().receive(session.peer().number(), {&press, 1});
}

/// A node that is a round behind knows of it a window earlier. What is felt just where a window
/// ends might be in its state there and not in that of others. Whoever gets the bat next presses no
/// key before it.
void MatchRounds::release(const SharedGame& game, std::uint32_t player, double from_s,
                          peer::Session& session) {
  const Felt felt = felt_[player];
  BatController controller(game.scene().bodies.bats[player].thrust, felt.held, 0);
  for (const Key key : all_keys) {
    if (!felt.held.is_down(key)) continue;
    controller.press(key, false);
    feel({.bat = game.start().bat(player)->index,
          .thrust = controller.thrust(),
          .input = input_of({.kind = InputKind::key_up, .key = key}),
          .time = std::max(felt.last, from_s + key_grid)},
         player, session);
  }
  felt_[player].released_s = felt_[player].last;
}

void MatchRounds::exchange(MatchMembers& members, const SharedGame& game, const NodeSeats& seats,
                           peer::Session& session) {
  assert(session.window() == window_);
  const double start = session.peer().now();
  const Round own{.window = window_, .keys = take_keys(game, seats, start)};
  const std::vector<Round> rounds = said_by_all(members, own, state_of(session));
  for (peer::PeerNumber from = 0; from < rounds.size(); ++from)
    for (const RoundKey& key : rounds[from].keys) {
      if (!holds(seats, from, key.player)) {
        const std::string fault =
            "presses a key of player " + std::to_string(key.player) + ", who does not play there";
        if (members.left().size() <= 2)
          throw peer::ProtocolError("peer " + std::to_string(from) + " " + fault);
        if (!members.is_lost(from)) members.give_up(from, fault);
        continue;
      }
      const double thrust = game.scene().bodies.bats[key.player].thrust;
      feel({.bat = game.start().bat(key.player)->index,
            .thrust = thrust_of(key, thrust),
            .input = static_cast<std::uint8_t>(key.code % 8 + 1),
            .time = start + key.steps * key_grid},
           key.player, session);
    }
  ++window_;
}

void MatchRounds::confirm(MatchMembers& members, std::uint64_t state) {
  said_by_all(members, {.window = window_}, state);
}

}  // namespace rink::game
