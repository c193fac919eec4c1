// Finds pairs of bodies that can touch within a time: discs that contain all places a body can get
// to, in cells.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "loadgen/measure/truth/surroundings.h"

namespace rink::loadgen {

/// A body under a number of the caller's. No point of it leaves the disc of radius `around` [m]
/// within the time.
struct Reaching {
  std::uint32_t entity = 0;
  Vector2 centre{0.0, 0.0};
  double around = 0.0;
  bool is_puck = false;
};

/// Two bodies can touch if their discs do. Bodies are binned by counting sort into cells that hold
/// one on average, and looked for as far as the widest disc reaches. Those of more than twice the
/// mean radius are kept in a list of their own: one fast body does not widen every search, and at
/// most half are such.
class Encounters {
 public:
  /// `length` x `width` [m] is where most bodies are.
  Encounters(double length, double width) : length_(length), width_(width) {}

  /// Replaces the bodies by `bodies`, whose numbers ascend (asserted) and are small and dense.
  void build(std::span<const Reaching> bodies);
  /// Writes all bodies but `own` that can touch `own`, or a puck that can touch it, to `found` in
  /// ascending order. `own` must be among the bodies. Depths are 0, since they are hardly ever
  /// needed.
  void find(std::uint32_t own, std::vector<Relevant>& found);

  /// The way in which a found body can reach `own`: directly, or through the puck `via`. Depth [m]
  /// is the sum of the radii less the distance, or the lesser of two such.
  struct Way {
    double depth = 0.0;
    std::optional<std::uint32_t> via{};
  };
  /// The deepest way.
  Way way(std::uint32_t own, std::uint32_t entity) const;

  /// Asserts that every body is in its cell once and is found under its number.
  void check() const;

 private:
  using Word = std::uint64_t;
  static constexpr std::uint32_t word_bits = 64;

  std::uint32_t column(double x) const;
  std::uint32_t row(double y) const;
  void choose_cells(std::span<const Reaching> bodies);
  void add_near(const Reaching& body, std::uint32_t first, std::uint32_t last);
  const Word* near(std::uint32_t index);
  bool is_there(std::uint32_t entity) const {
    return entity < index_of_.size() && index_of_[entity] < bodies_.size() &&
           bodies_[index_of_[entity]].entity == entity;
  }
  const Reaching& body(std::uint32_t entity) const { return bodies_[index_of_[entity]]; }

  double length_, width_, cell_ = 1.0;
  double wide_from_ = 0.0,
         narrow_max_ =
             0.0;  ///< radius [m] from which on a disc is in the list, and the largest below
  std::uint32_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> begins_, cell_of_;
  struct Disc {
    double x, y, around;
    std::uint32_t index;
  };
  std::vector<Reaching> bodies_;
  std::vector<std::uint32_t> index_of_;  ///< in bodies_, by entity
  std::vector<Disc> sorted_;             ///< by cell, the wide ones last
  std::size_t words_ = 0;                ///< that hold a bit for each body
  std::vector<Word> pucks_;              ///< a bit for each body
  std::vector<Word> near_;  ///< `words_` for each body whose neighbours are known: their bits
  std::vector<std::uint32_t>
      near_row_;  ///< by body: which in near_, from 1 on; 0 if they are not known
  std::vector<std::uint32_t> listed_;  ///< neighbours as they are found
  std::size_t listed_count_ = 0;
  std::uint32_t near_rows_ = 0;
  std::vector<Word> found_;
};

}  // namespace rink::loadgen
