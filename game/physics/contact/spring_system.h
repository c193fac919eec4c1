// Systems of springs between bodies, solved directly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "game/physics/contact/contact_problem.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Cholesky's method on 2 x 2 squares, one for each two bodies that a spring, or the elimination of
/// others, connects. Who has the fewest neighbours left is eliminated next (Tinney and Walker
/// 1967): a pile of 400 pucks then takes a ninth of the products that bodies in order of their
/// distance from one end take, whose envelope is as wide as the pile. Keeps its memory, and the
/// order as long as the same bodies touch.
class SpringSystem {
 public:
  /// Masses, and a place for a spring along each touch of the problem, all of stiffness 0.
  void lay_out(const ContactProblem& problem);
  /// Back to masses alone.
  void clear(const ContactProblem& problem);
  /// The spring along a touch pulls along its normal.
  void add_spring(const ContactProblem& problem, std::size_t touch, Real stiffness);
  void factorise();
  /// Turns the forces on the bodies into what moves them so; after factorise().
  void solve(std::vector<RealVector>& forces);

 private:
  struct Square {
    RealVector upper, lower;  // rows
  };
  /// The place of the square of two bodies. The first of them is eliminated later.
  struct Entry {
    std::uint32_t place, end;  // in `squares_`, and where its column ends
  };
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  bool has_same_pairs(const ContactProblem& problem);
  void connect(std::size_t body_count);
  void order();
  void eliminate(std::uint32_t body);
  void list_rows();
  void place_springs();
  void gather_column(std::uint32_t column);
  void finish_column(std::uint32_t column);
  std::span<const std::uint32_t> column_rows(std::uint32_t column) const {
    return {&rows_[begins_[column]], begins_[column + 1] - begins_[column]};
  }

  std::vector<Pair> pairs_;                             // bodies, by touch
  std::vector<std::vector<std::uint32_t>> neighbours_;  // by body, of those not yet eliminated
  std::vector<std::uint32_t> joined_;
  std::vector<Pair> queue_;             // numbers of neighbours, and whose: a heap
  std::vector<std::uint32_t> order_;    // bodies
  std::vector<std::uint32_t> places_;   // by body, its place in the order
  std::vector<std::uint32_t> begins_;   // by column, where its squares are; its own comes first
  std::vector<std::uint32_t> rows_;     // by square; while the order is sought, bodies
  std::vector<Square> squares_;         // of the triangle
  std::vector<std::uint32_t> springs_;  // by touch, its square beside the diagonal
  std::vector<std::uint32_t> entry_begins_;
  std::vector<Entry> entries_;        // by row, its squares before the diagonal
  std::vector<std::uint32_t> where_;  // by row, its square in the column at hand
  std::vector<RealVector> solution_;  // by place in the order
};

}  // namespace rink::physics::inline RINK_PRECISION
