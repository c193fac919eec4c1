// One bot of a game over DDS: reads the cells that its region touches, keeps replicas, and writes
// its keys.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "game/net/following_view.h"
#include "loadgen/dds/dds_engine.h"
#include "loadgen/dds/domain.h"
#include "loadgen/dds/partition_grid.h"
#include "loadgen/run/bots/key_schedule.h"

namespace rink::loadgen {

/// What a bot knows of a body: the newest sample of the cell that sent it last.
struct DdsReplica {
  bool is_known = false;
  std::uint32_t cell = 0;
  std::int64_t stamp_ns = -1;  ///< of the game
  physics::Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};

  physics::Vector2 position_at(double simulated_s, bool extrapolates) const {
    if (!extrapolates) return position;
    return position + velocity * (simulated_s - 1e-9 * static_cast<double>(stamp_ns));
  }
};

/// The session as the server says it.
struct DdsSession {
  std::optional<double> origin_s;  ///< of the machine's clock when the game begins, once it does
  double begin_s = 0.0, rate_hz = 1.0, cell_size = 0.0, extent = 0.0;
  std::uint32_t seats = 0;  ///< players of the game
  im::Region field;
  bool is_over = false;
  std::uint32_t body = 0;  ///< of the bot's bat
  physics::Vector2 place{0.0, 0.0};
};

class DdsBot {
 public:
  /// Called for each state and for each body that comes and goes.
  struct Listener {
    virtual ~Listener() = default;
    virtual void state_came(const DdsBot& bot, std::uint32_t body, std::int64_t stamp_ns) = 0;
    virtual void scope_changed(const DdsBot& bot, std::uint32_t body, bool is_in) = 0;
  };

  /// `waiting` is a set of the process to which readers are attached: what triggers it names the
  /// bot and the reader (`bot_of`, `reader_of`). Beside a server in one process all bots are of
  /// later domain instances than its, the first.
  DdsBot(const DdsBotsOptions& options, std::uint32_t number, DdsEntity waiting, Listener& listener,
         std::uint32_t instances_before = 0);

  static std::uint32_t bot_of(std::intptr_t which) {
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(which) >> 32);
  }
  static DdsEntity reader_of(std::intptr_t which) {
    return static_cast<DdsEntity>(static_cast<std::uint64_t>(which) & 0xffffffffu);
  }

  std::uint32_t number() const { return number_; }
  const std::optional<DdsSession>& session() const { return session_; }
  const std::vector<DdsReplica>& replicas() const { return replicas_; }
  std::int64_t newest_ns() const { return newest_ns_; }  ///< stamp; below 0 before any
  std::uint64_t states() const { return states_; }
  /// Of readers of cells made and deleted since the start.
  std::uint64_t cells_joined() const { return cells_joined_; }
  std::size_t cells_read() const { return readers_.size(); }

  /// Takes what `reader` has. Throws DdsError if the bot has no seat in the game.
  void take(DdsEntity reader);
  /// Lets bodies go that left their cells and came in no other, and those not heard of for long.
  /// To be called when all readers that have something were asked, in any order.
  void settle();
  /// Reads the cells around the bat where that has moved far enough, or was lost, at `now_s` on the
  /// clock.
  void follow(double now_s);
  /// True once the bot has what it needs: said once.
  bool say_ready();
  bool is_server_there() const;
  void press(const KeyChange& change, double due_s) const;

 private:
  struct Reader {
    std::uint32_t cell = 0;
    Endpoint endpoint;
  };
  /// A body that is no longer written in a cell.
  struct Left {
    std::uint32_t body = 0, cell = 0;
    std::int64_t stamp_ns = 0;  ///< of the tick at which it had left
  };

  void take_session();
  void take_states(const Reader& reader);
  void read_cells(const std::vector<std::uint32_t>& cells);
  void attach(DdsEntity reader) const;
  void forget(std::uint32_t body);
  void forget_cell(std::uint32_t cell);
  void forget_silent();
  double half_side() const;

  const DdsBotsOptions& options_;
  std::uint32_t number_;
  DdsEntity waiting_;
  Listener& listener_;
  Domain domain_;
  Endpoint sessions_, inputs_;
  std::optional<DdsSession> session_;
  std::optional<PartitionGrid> grid_;
  game::FollowingView view_;
  std::vector<Reader> readers_;  ///< ascending by cell
  std::vector<DdsReplica> replicas_;
  std::vector<Left> left_;      ///< since the bot settled last
  std::int64_t swept_ns_ = -1;  ///< newest stamp when those not heard of were let go last
  std::int64_t newest_ns_ = -1;
  std::uint64_t states_ = 0, cells_joined_ = 0;
  double bat_seen_s_ = 0.0;
  bool is_ready_ = false, reads_all_ = false;
};

}  // namespace rink::loadgen
