// Asks the local network for matches, and lists those that answer.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "game/net/discovery/discovery_message.h"

namespace rink::game {

/// A host that has answered lately.
struct FoundMatch {
  std::string name, place;      ///< `place`: HOST:PORT to join
  double ping_s = 0.0;          ///< the shortest of its answers, with the host's wait for its turn
  bool is_same_version = true;  ///< else joining would be refused
  friend bool operator==(const FoundMatch&, const FoundMatch&) = default;
};

struct SearchCounters {
  std::uint64_t asked = 0, answers = 0, refused = 0;  ///< the last were no answers to these queries
};

/// Knows no clock: `now_s` is real time [s], which never falls.
class MatchSearch {
 public:
  static constexpr double asks_every_s = 1.0, forgets_after_s = 4.0;
  static constexpr std::size_t found_max = 16;  ///< on a screen; a stranger could be any number

  /// `draw` gives numbers that nobody can guess. `group`: discovery_group(), or a test's own.
  MatchSearch(const rti::MulticastGroup& group, std::function<std::uint64_t()> draw);

  /// Asks if it is time to, and takes up the answers.
  void search(double now_s);
  /// By name, then place.
  const std::vector<FoundMatch>& found() const { return found_; }
  const SearchCounters& counters() const { return counters_; }

 private:
  struct Query {
    std::uint64_t number;
    double asked_s;
  };
  struct Host {
    std::uint64_t id;
    double heard_s;
    FoundMatch match;
  };
  void ask(double now_s);
  void take(rti::Bytes bytes, const rti::DatagramSource& from, double now_s);
  void list();

  rti::MulticastSocket socket_;
  std::function<std::uint64_t()> draw_;
  std::vector<Query> queries_;  ///< that may still be answered
  std::vector<Host> hosts_;
  std::vector<FoundMatch> found_;
  SearchCounters counters_;
};

}  // namespace rink::game
