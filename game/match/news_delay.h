// Measures the delay of updates: so far behind the own bat all is known, and the other bat can be
// shown at its true place.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

namespace rink::game {

/// A body that is shown at P - delay is right if no later update is about instants up to there. An
/// update with the stamp T is about what happened since the tick before, T - tick; so it came late
/// by P - (T - tick), P being that of the last frame in which it was not known. The most of that
/// which was seen of late, but for the latest of every 32, holds all that delays it: both ways,
/// their jitter, the server's ticks and how late it is with them, and the frames in which the
/// client listens. Guessing it from round trips would count a frame or two that news need not wait
/// for. Pure.
class NewsDelay {
 public:
  static constexpr double spare = 2e-3;     ///< s: reserve beyond the recent delays
  static constexpr double late_most = 2.0;  ///< s: greater delays have other causes and do not
                                            ///< count
  static constexpr std::size_t remembered = 64,
                               needed =
                                   16;  ///< pieces of news: of five seconds, and one, of a match

  /// An update about events from `since_s` on came; the last frame before it showed the own bat at
  /// `shown_s` [s, simulated].
  void received(double shown_s, double since_s) {
    if (shown_s - since_s > late_most) return;
    late_.push_back(shown_s - since_s);
    if (late_.size() > remembered) late_.pop_front();
  }
  /// The delay by which to show the other bat [s]; nothing until there are enough updates.
  std::optional<double> delay() const {
    if (late_.size() < needed) return std::nullopt;
    std::vector<double> sorted(late_.begin(), late_.end());
    const auto latest = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 32);
    std::nth_element(sorted.begin(), latest, sorted.end(), std::greater<>());
    return std::max(0.0, *latest + spare);
  }

 private:
  std::deque<double> late_;
};

}  // namespace rink::game
