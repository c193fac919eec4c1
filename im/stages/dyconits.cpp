// The stage `dyconits`: each square of the world is a unit of consistency, of which a subscriber is
// told all that was held back as soon as that is too much or too old (Donkervliet et al. 2021).
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "im/matching/buffer.h"
#include "im/schemes/cells.h"
#include "im/stages/held_updates.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

class Dyconits final : public HeldUpdates {
 public:
  Dyconits(std::unique_ptr<Filter> inner, const Region& world, const DyconitBounds& bounds)
      : HeldUpdates(std::move(inner), "dyconits"), world_(world), bounds_(bounds) {
    assert(bounds_.cell_size > 0.0 && bounds_.matches >= 0.0 && bounds_.error >= 0.0);
  }

 private:
  struct Cell {
    double column, row;
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  struct Untold {
    Cell cell;
    std::size_t place;  ///< in the list
  };
  static bool is_before(const Untold& a, const Untold& b) {
    if (a.cell.column != b.cell.column) return a.cell.column < b.cell.column;
    return a.cell.row != b.cell.row ? a.cell.row < b.cell.row : a.place < b.place;
  }

  Cell cell_at(const Half& half) const {
    return {cell_of(half.x, 0.5 * world_.low_x, 0.5 * bounds_.cell_size),
            cell_of(half.y, 0.5 * world_.low_y, 0.5 * bounds_.cell_size)};
  }

  /// As a king walks; at most so many that the product with a bound of 0 is 0.
  static double steps_between(const Cell& a, const Cell& b) {
    constexpr double far = 1e9;
    return std::min(far, std::max(std::abs(a.column - b.column), std::abs(a.row - b.row)));
  }

  void judge(Subscriber subscriber, std::span<Held> held) override {
    untold_.clear();
    for (std::size_t i = 0; i < held.size(); ++i)
      untold_.push_back({cell_at(place(held[i].entity)), i});
    const Untold *const end = untold_.data() + untold_.size(), *first = untold_.data();
    std::sort(untold_.data(), untold_.data() + untold_.size(), is_before);
    const Cell own = cell_at(middle_of(subscription(subscriber)));
    while (first != end) {
      double error = 0.0;
      std::uint64_t oldest = 0;
      const Untold* last = first;
      for (; last != end && last->cell == first->cell; ++last) {
        error += held[last->place].way;
        oldest = std::max(oldest, age(held[last->place]));
      }
      const double steps = steps_between(first->cell, own);
      const bool is_due =
          error > steps * bounds_.error || static_cast<double>(oldest) > steps * bounds_.matches;
      for (; first != last; ++first) held[first->place].is_due = is_due;
    }
  }

  Region world_;
  DyconitBounds bounds_;
  Buffer<Untold> untold_;
};

}  // namespace

std::unique_ptr<Filter> make_dyconits(std::unique_ptr<Filter> inner, const Region& world,
                                      const DyconitBounds& bounds) {
  return std::make_unique<Dyconits>(std::move(inner), world, bounds);
}

}  // namespace rink::im
