// Finds free seats by name first, so that a player that comes back gets its own bat.
#include "game/net/server/players/seats.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <system_error>

#include "game/replication/names.h"

namespace rink::game {

void Seats::keep_to(std::uint32_t first, std::uint32_t count) {
  assert(player_count_ == 0 && first <= is_taken_.size() && count <= is_taken_.size() - first);
  for (std::uint32_t player = 0; player < is_taken_.size(); ++player)
    is_taken_[player] = player < first || player - first >= count;
}

void Seats::open(std::uint32_t player) {
  assert(player < is_taken_.size() && !federate_of(player));
  is_taken_[player] = false;
}

std::optional<rti::FederateHandle> Seats::take_waiting(std::uint64_t token) {
  const auto one = std::ranges::find(waiting_, token, &Waiting::token);
  if (one == waiting_.end()) return std::nullopt;
  const rti::FederateHandle federate = one->federate;
  waiting_.erase(one);
  return federate;
}

/// By the number at the end of the name: comparing it with all bats' names took 7 % of the time in
/// which 2,500 players joined.
std::optional<std::uint32_t> Seats::named(std::string_view federate_name) const {
  const char* const end = federate_name.data() + federate_name.size();
  const std::size_t digits = federate_name.find_last_not_of("0123456789") + 1;
  std::uint32_t player = 0;
  const auto read = std::from_chars(federate_name.data() + digits, end, player);
  if (read.ec != std::errc() || player >= is_taken_.size() || federate_name != bat_name(player))
    return std::nullopt;
  return player;
}

std::optional<std::uint32_t> Seats::free(std::string_view federate_name) const {
  const std::optional<std::uint32_t> own = named(federate_name);
  if (own && !is_taken_[*own]) return own;
  const auto free = std::find(is_taken_.begin(), is_taken_.end(), false);
  if (free == is_taken_.end()) return std::nullopt;
  return static_cast<std::uint32_t>(free - is_taken_.begin());
}

void Seats::enter(rti::FederateHandle federate, std::uint32_t player) {
  assert(player < is_taken_.size() && !is_taken_[player] && find(federate) == nullptr);
  if (seats_.size() <= federate.value) seats_.resize(federate.value + std::size_t{1});
  seats_[federate.value] = Seat{.player = player};
  is_taken_[player] = true;
  is_leaving_[player] = false;
  ++player_count_;
}

void Seats::leave(rti::FederateHandle federate, bool takes_bat) {
  assert(find(federate) != nullptr);
  const Seat seat = *seats_[federate.value];
  assert(is_taken_[seat.player] && player_count_ > 0);
  if (seat.is_turn_done) --turns_done_;
  --player_count_;
  is_taken_[seat.player] = false;
  if (takes_bat) is_leaving_[seat.player] = true;
  seats_[federate.value].reset();
}

const Seats::Seat* Seats::find(rti::FederateHandle federate) const {
  return federate.value < seats_.size() && seats_[federate.value] ? &*seats_[federate.value]
                                                                  : nullptr;
}

std::optional<rti::FederateHandle> Seats::federate_of(std::uint32_t player) const {
  for (std::uint32_t federate = 0; federate < seats_.size(); ++federate)
    if (seats_[federate] && seats_[federate]->player == player)
      return rti::FederateHandle{federate};
  return std::nullopt;
}

void Seats::end_turn(rti::FederateHandle federate) {
  assert(find(federate) != nullptr);
  Seat& seat = *seats_[federate.value];
  turns_done_ += seat.is_turn_done ? 0u : 1u;
  seat.is_turn_done = true;
  assert(turns_done_ <= player_count_);
}

void Seats::begin_turns() {
  for (std::optional<Seat>& seat : seats_)
    if (seat) seat->is_turn_done = false;
  turns_done_ = 0;
}

}  // namespace rink::game
