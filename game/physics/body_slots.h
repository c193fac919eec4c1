// Which slot of a small world holds which body of a large one: slots in order of the bodies'
// numbers, with blank ones in between for those that come.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rink::physics {

/// Of bodies that are not there nothing is kept. Slots are in order of numbers because a world
/// breaks ties by them: whoever comes first in the large world does so in the small one.
class BodySlots {
 public:
  /// Nobody is ever in this slot, which stands for all bodies that are not there.
  static constexpr std::uint32_t nobody = 0;

  explicit BodySlots(std::uint32_t body_count) : body_count_(body_count) { make_table(); }

  /// Of the large world: numbers are below.
  std::uint32_t body_count() const { return body_count_; }
  std::uint32_t slot_count() const { return static_cast<std::uint32_t>(numbers_.size()); }
  /// How many bodies are there.
  std::uint32_t count() const { return count_; }
  /// `nobody` if it is not there.
  std::uint32_t slot_of(std::uint32_t number) const {
    assert(number < body_count_);
    for (std::size_t k = home_of(number); table_[k] != nobody; k = next(k))
      if (numbers_[table_[k]] == number) return table_[k];
    return nobody;
  }
  /// The body in the slot, or the last one there.
  std::uint32_t number_of(std::uint32_t slot) const {
    assert(slot != nobody && slot < numbers_.size());
    return numbers_[slot];
  }
  /// By slot; of a blank one any number that keeps the order. Valid until the next spread().
  std::span<const std::uint32_t> numbers() const { return numbers_; }

  /// The slot for a body, and the nearest blank one: whoever is in between moves towards it by one.
  struct Room {
    std::uint32_t slot = nobody, blank = nobody;
  };
  /// Nothing if no blank slot is near: then spread() is due.
  std::optional<Room> room_for(std::uint32_t number) const;
  /// Calls `visit(from, to)` for each body that moves, in an order in which `to` is always blank.
  template <class Visit>
  static void visit_moves(const Room& room, Visit&& visit) {
    for (std::uint32_t to = room.blank; to != room.slot;) {
      const std::uint32_t from = to > room.slot ? to - 1 : to + 1;
      visit(from, to);
      to = from;
    }
  }
  /// The body is there from now on, and others have moved.
  void take(std::uint32_t number, const Room& room);
  /// The body is gone: its slot is blank.
  void release(std::uint32_t number);
  /// Divides as many blank slots as are reasonable evenly between bodies, or keeps all at the end
  /// if `number`, which is about to come, is above all others. Returns, by slot, where the body in
  /// it was before; `nobody` for a blank one.
  std::vector<std::uint32_t> spread(std::uint32_t number);

  /// Asserts that numbers rise, and that all bodies are found.
  void check() const;

 private:
  std::size_t home_of(std::uint32_t number) const {
    return static_cast<std::size_t>(number * 0x9e3779b97f4a7c15ULL >> shift_);
  }
  std::size_t next(std::size_t place) const { return (place + 1) & (table_.size() - 1); }
  std::size_t place_of(std::uint32_t slot) const;
  void make_table();
  void enter(std::uint32_t slot);
  void move(std::uint32_t from, std::uint32_t to);

  std::uint32_t body_count_, count_ = 0;
  std::vector<std::uint32_t> numbers_{0};  ///< by slot, not falling from the second one on
  std::vector<std::uint8_t> is_taken_{0};  ///< by slot
  std::vector<std::uint32_t> table_;       ///< of slots by a hash of their bodies' numbers, with
                                           ///< linear probing; at most half full
  int shift_ = 63;
};

}  // namespace rink::physics
