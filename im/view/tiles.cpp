// The scheme `tiles`: an entity matters to a subscriber while their rectangles overlap and the way
// between their tiles, round posts, has so many steps at most: the tile distance of Boulanger,
// Kienzle and Verbrugge (2006), on squares.
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "im/view/cell_filter.h"
#include "im/view/middle_cell.h"
#include "im/view/shadow.h"

namespace rink::im {
namespace {

/// A step leads over a side that no post covers whole: both of its ends are inside of none.
class TileDistance {
 public:
  explicit TileDistance(const FilterSettings& settings)
      : cells_(settings), steps_(static_cast<int>(settings.tile_steps)) {
    for (const Disc& post : settings.posts)
      if (4.0 * post.radius > cells_.size())  // the others cover no side, however it is rounded
        posts_.push_back({plain(post.x), plain(post.y), plain(post.radius)});
  }

  Judgement operator()(const Party& subscriber, const Party& entity) {
    const MiddleCell mine = cells_.around(subscriber.region), its = cells_.around(entity.region);
    const double columns = its.column - mine.column, rows = its.row - mine.row;
    return {is_near(mine, columns, rows), std::min(mine.slack, its.slack)};
  }

 private:
  static constexpr std::uint8_t unreached = 255;
  /// Numbers of steps from a tile to those around it, row by row.
  using Steps = std::vector<std::uint8_t>;

  bool is_near(const MiddleCell& from, double columns, double rows) {
    if (!(std::abs(columns) + std::abs(rows) <= steps_)) return false;
    if (posts_.empty() || (columns == 0.0 && rows == 0.0)) return true;
    const Steps& steps = steps_from(from);
    return steps.empty() ||
           steps[index(static_cast<int>(columns), static_cast<int>(rows))] <= steps_;
  }
  std::size_t index(int columns, int rows) const {
    assert(std::abs(columns) <= steps_ && std::abs(rows) <= steps_);
    const std::ptrdiff_t from = steps_, row = from + rows, column = from + columns;
    return static_cast<std::size_t>(row * (2 * from + 1) + column);
  }

  /// Those of tiles that somebody looks from are kept, 16 MiB of them; none are needed where no
  /// post is in the way.
  const Steps& steps_from(const MiddleCell& tile) {
    constexpr std::size_t bytes_max = std::size_t{1} << 24;
    const std::pair place{tile.column, tile.row};
    const auto known = known_.find(place);
    if (known != known_.end()) return known->second;
    if ((known_.size() + 1) * (index(steps_, steps_) + 64) > bytes_max) {
      const auto next = known_.upper_bound(place);
      known_.erase(next == known_.end() ? known_.begin() : next);
    }
    return known_[place] = counted(tile);
  }

  /// By breadth: each round goes one step from the tiles that the round before reached.
  Steps counted(const MiddleCell& tile) const {
    const double reach = (steps_ + 1) * cells_.size();
    std::vector<Disc> near;
    for (const Disc& post : posts_)
      if (post.x + post.radius >= tile.box.low_x - reach &&
          post.x - post.radius <= tile.box.high_x + reach &&
          post.y + post.radius >= tile.box.low_y - reach &&
          post.y - post.radius <= tile.box.high_y + reach)
        near.push_back(post);
    if (near.empty()) return {};
    Steps steps(index(steps_, steps_) + 1, unreached);
    std::vector<std::pair<int, int>> reached{{0, 0}}, next;
    steps[index(0, 0)] = 0;
    for (int count = 1; count <= steps_ && !reached.empty(); ++count) {
      next.clear();
      for (const auto& [column, row] : reached)
        for (const auto& [to_column, to_row] : {std::pair{column - 1, row},
                                                {column + 1, row},
                                                {column, row - 1},
                                                {column, row + 1}}) {
          std::uint8_t& there = steps[index(to_column, to_row)];
          if (there != unreached || is_closed(near, tile, std::max(column, to_column),
                                              std::max(row, to_row), row == to_row))
            continue;
          there = static_cast<std::uint8_t>(count);
          next.emplace_back(to_column, to_row);
        }
      std::swap(reached, next);
    }
    return steps;
  }
  /// The left side of the tile that lies so many columns and rows from `tile`, or its low one.
  bool is_closed(const std::vector<Disc>& posts, const MiddleCell& tile, int columns, int rows,
                 bool is_left) const {
    const double column = tile.column + columns, row = tile.row + rows,
                 x = plain(cells_.low_x(column)), y = plain(cells_.low_y(row)),
                 end_x = is_left ? x : plain(cells_.low_x(column + 1.0)),
                 end_y = is_left ? plain(cells_.low_y(row + 1.0)) : y;
    return std::any_of(posts.begin(), posts.end(), [&](const Disc& post) {
      return holds(post, x, y) && holds(post, end_x, end_y);
    });
  }

  MiddleCells cells_;
  int steps_;
  std::vector<Disc> posts_;
  std::map<std::pair<double, double>, Steps> known_;
};

}  // namespace

std::unique_ptr<Filter> make_tiles_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_tiles_filter(const FilterSettings& settings) {
  return std::make_unique<CellFilter<TileDistance>>(settings);
}

}  // namespace rink::im
