// Decisions of interest management for a watcher: regions, cells, and which player receives what.
#pragma once

#include <cstdint>
#include <vector>

namespace rink::game {

/// Decisions at one instant about one thing that the watcher asked about. Counts are complete;
/// lists may be cut to the size of a message.
struct InterestSeen {
  static constexpr std::uint32_t nothing = 0xffffffffu;

  /// The region to which one player's federate subscribes.
  struct View {
    std::uint32_t bat = nothing;  ///< the player's bat, by the id of its Thing
    bool hears = false;           ///< receives the thing asked about
    float low_x = 0.0f, low_y = 0.0f, high_x = 0.0f, high_y = 0.0f;  ///< m
    friend bool operator==(const View&, const View&) = default;
  };

  std::uint32_t asked = nothing;  ///< the id of the Thing
  float cell_size = 0.0f;         ///< m; 0 if the scheme has no cells
  std::uint32_t view_count = 0, heard_count = 0, hearer_count = 0;
  std::vector<View> views;
  std::vector<std::uint32_t>
      heard;  ///< ids of the things in the scope of the federate that plays `asked`, ascending
  friend bool operator==(const InterestSeen&, const InterestSeen&) = default;
};

}  // namespace rink::game
