// Publishes the bodies of a game at each tick, each by the writer of the cell that it is in.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "game/control/game.h"
#include "loadgen/dds/domain.h"
#include "loadgen/dds/partition_grid.h"

namespace rink::loadgen {

/// A reader sees a body in one cell at a time: where it has crossed into another it is written
/// there first, then unregistered by the writer that it has left, so that who reads both cells
/// never misses it and who reads the old one alone knows that it went.
class StateWriters {
 public:
  /// Before any other writer of the process: those batch what they send until they are flushed.
  StateWriters(const Domain& domain, const PartitionGrid& grid);

  /// Takes the states of all entities, at now().
  void look(const game::Game& game);
  /// Sends what `look` took.
  void send();

  std::uint64_t written() const { return written_; }
  /// Changes of cells.
  std::uint64_t crossings() const { return crossings_; }
  /// Of bodies in cells that a reader of `player` is matched with, by player, ascending: what the
  /// partitions let through now.
  std::map<std::uint32_t, std::vector<std::uint32_t>> scopes();

 private:
  static constexpr std::uint32_t nowhere = 0xffffffffu;
  struct Shown {
    std::uint32_t body = 0, cell = 0;
    physics::Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};
  };
  struct Left {
    std::uint32_t body = 0, cell = 0;
  };

  void send_all();
  void unregister_left();
  std::vector<std::uint32_t> players_reading(DdsEntity writer);

  const PartitionGrid& grid_;
  std::vector<DdsEntity> writers_;        ///< by cell
  std::vector<std::uint32_t> cell_of_;    ///< by body
  std::vector<bool> is_there_, is_used_;  ///< by body, by cell
  std::vector<Shown> shown_;
  std::vector<Left> left_;
  std::map<std::uint64_t, std::uint32_t> player_of_reader_;
  std::int64_t stamp_ns_ = 0;
  std::uint64_t written_ = 0, crossings_ = 0;
};

}  // namespace rink::loadgen
