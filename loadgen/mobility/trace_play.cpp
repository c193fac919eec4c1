// Each instant is a window of its own.
#include "loadgen/mobility/trace_play.h"

namespace rink::loadgen {

std::optional<game::ShownWindow> TracePlay::show_next(double until, game::Game& game) {
  if (until <= shown_s_) return std::nullopt;
  shown_s_ = until;
  follower_.show(until, game);
  game::ShownWindow window;
  for (const std::uint32_t agent : follower_.left()) window.left.push_back(*game.bat(agent));
  for (const std::uint32_t agent : follower_.came()) window.told.push_back(*game.bat(agent));
  return window;
}

}  // namespace rink::loadgen
