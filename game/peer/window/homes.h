// Own bodies deep in their zones, where no other peer's halo reaches: they are not claimed, and
// hardly any is checked.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "game/peer/window/halos.h"
#include "game/peer/window/share.h"
#include "game/peer/window/window.h"

namespace rink::peer {

/// A home is the interior of an own zone: no other halo reaches a body whose place is in it.
/// Watched are those own bodies that might leave theirs soon even if nothing happens to them. The
/// edge is who was not at home from a window's start to its end.
class Homes {
 public:
  /// Both must outlive it. It alone sets the rooms of `share`.
  Homes(Share& share, const Halos& halos);

  /// At a window's start, after bodies or halos changed.
  void settle(const Settlement& settled, const Window& window);
  /// Whether homes fit the halos, which must not reach them, and should not stay far away.
  bool are_fit() const;
  /// Chooses the homes, and so the bodies at home. Until the next window all are watched, and a run
  /// that was played must be repeated.
  void choose(const Window& window);
  /// Whether no halo and no annex reaches a home.
  bool are_safe() const { return margin_ >= least_margin(); }
  /// After the zones changed, or annexes came that reach a home: all own bodies may be elsewhere,
  /// or ghosts of others, at the window's end.
  void reopen();

  /// At a window's start: whether it ends before anything unwatched could have left its home; else
  /// `choose_watched` is due, which watches all that might leave theirs for some windows to come.
  bool is_watch_fit(const Window& window) const { return window.end <= watched_until_; }
  void choose_watched(const Window& window);
  /// Before a run: bodies with entries in the last window have their rooms again, unless they have
  /// been watched since.
  void restore_rooms();
  /// After a run: finds the edge, and the outskirts.
  void find_edge();
  /// Before `settle`: where bodies are at the last window's end is where they are now.
  void begin_window();

  /// Own bodies that were not at home from the window's start to its end, by number.
  const std::vector<std::uint32_t>& edge() const { return edge_; }
  bool is_at_edge(std::uint32_t body) const {
    assert(body < is_edge_.size());
    return is_edge_[body] != 0;
  }
  /// Own bodies that are not at home at the window's end: what they and their companions take up.
  const std::vector<Reach>& outskirts() const { return outskirts_; }
  /// True if its earlier events in this window may be missing in the journal: all were at home.
  bool was_unwatched(std::uint32_t body) const { return watches_[body] == Watch::late; }
  /// Where the centre of a body that is at home may be, without infinite sides.
  Box room_of(std::uint32_t body) const;
  /// Whether the box meets a home.
  bool are_met_by(const Box& box) const;

  /// Asserts that bodies have homes that exist, and that who is watched is in the list.
  void check() const;

 private:
  /// `late`: since an event in this window.
  enum class Watch : std::uint8_t { none, watched, late };

  std::uint8_t home_of(const Vector2& place, std::uint8_t likely) const;
  double least_margin() const;
  void watch(std::uint32_t body, Watch how);
  bool stays(std::uint8_t home, const Vector2& place, const Vector2& velocity, double since) const;
  void look_at(std::uint32_t body);
  void note_edge(std::uint32_t body);

  Share& share_;
  const Halos& halos_;
  double margin_ = -1.0;                         ///< between a home and the border of its zone [m]
  std::vector<Box> interiors_;                   ///< of the own zones
  std::vector<std::uint8_t> homes_, end_homes_;  ///< 1 + number of the own zone in which a body is
                                                 ///< at home; 0 if in none, or with companions
  std::vector<Watch> watches_;
  std::vector<std::uint32_t> watched_;  ///< all others are at home, and stay there until
                                        ///< `watched_until_` [s] if nothing happens to them
  double watched_until_ = -1.0;
  std::vector<std::uint8_t> is_edge_;
  std::vector<std::uint32_t> edge_;
  std::vector<Reach> outskirts_;
};

}  // namespace rink::peer
