// The command line of rink play.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "game/apps/flags.h"
#include "game/net/peer/playing_peer.h"
#include "game/view/menu.h"
#include "game/view/picture_of.h"
#include "game/view/window/frame_pace.h"

namespace rink::view {

struct PlayOptions {
  bool is_two = false;
  std::string bot, host, join, watch, replay, records;
  std::string peer, peer_listen;
  game::PlayingPeerSettings sharing;
  std::string camera, control;
  std::string size = "1280x720";
  bool is_full_screen = false, is_muted = false, shows_figures = false, is_discovered = true;
  std::string settings_file, key_file, continued, pictures;
  std::uint64_t seed = 1;
  bool is_offscreen = false;
  std::string script, screenshot;
  double at_s = 0.0, picture_rate = 60.0, frame_limit = FramePace::limit_default;
  std::set<std::string> given{};  ///< the flags that were given
};

void add_options(game::Flags& flags, PlayOptions& options);

/// The match to play at once by the command line; nothing: the menu.
std::optional<MatchWish> wish_of(const PlayOptions& options);

std::optional<Viewpoint> viewpoint_of(const PlayOptions& options);

/// Nothing unless `text` is two whole numbers like 1280x720, from 320x240 to 8192x8192.
std::optional<WindowSize> size_of(const std::string& text);

}  // namespace rink::view
