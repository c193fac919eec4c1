// Federates that do anything their services allow, come late, leave and die: every bound against
// relaxation, every message exactly once, nobody stuck.
#include <map>

#include "tests/rti/time/relaxed_time.h"
#include "tests/rti/time/timed_federation.h"

namespace rink::rti {
namespace {

using namespace testing;
using What = TimedFederate::Heard::What;

class Chaos {
 public:
  explicit Chaos(std::uint64_t seed)
      : random_(seed), federation_(relaxed(), with_entry_room(seed % 2 == 0 ? 1 : 512 << 10)) {
    const std::uint64_t count = 2 + below(3);
    for (std::uint64_t i = 0; i < count; ++i) join();
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) act();
    bring_to_the_end();
    judge();
  }

 private:
  struct Said {
    std::size_t sender = 0;
    RetractionHandle handle;
    bool has_arrived = false, is_retracted = false;  ///< at the RTI
    bool is_taken_back = false;                      ///< by the sender
  };
  std::uint64_t below(std::uint64_t count) { return random_() % count; }
  /// Coarse, so that equal times are the rule.
  double some(std::uint64_t halves) { return 0.5 * static_cast<double>(below(halves)); }
  double some_lookahead() {
    constexpr double lookaheads[] = {0.0, 0.0, 0.5, 1.0, 1e-300};
    return lookaheads[below(5)];
  }
  TimedFederate& at(std::size_t i) { return *federation_.federates()[i]; }
  std::size_t count() const { return federation_.federates().size(); }

  void join() {
    federation_.join();
    for (std::size_t i = 0; i + 1 < count(); ++i) note_arrival(i);
    since_.push_back(said_.size());
  }
  void note_arrival(std::size_t sender) {
    if (at(sender).is_gone) return;
    for (Said& each : said_) {
      if (each.sender != sender) continue;
      each.has_arrived = true;
      each.is_retracted = each.is_taken_back;
    }
  }
  void act() {
    const std::size_t i = below(count());
    const std::uint64_t what = below(100);
    if (what < 25) return federation_.carry_up(at(i)), note_arrival(i);
    if (what < 45) return federation_.tick();
    if (what < 65) return federation_.carry_down(at(i));
    if (at(i).is_gone) return;
    if (what == 65 && count() < 8) return join();
    if (what == 66 && below(4) == 0) return note_arrival(i), federation_.resign(at(i));
    if (what == 67 && below(4) == 0) return federation_.kill(at(i));
    try {
      serve(i, below(16));
    } catch (const RtiException&) {
    }  // what a federate may not do now, it is told; the RTI must agree with all that it may
  }
  void serve(std::size_t i, std::uint64_t what) {
    TimedFederate& federate = at(i);
    Ambassador& ambassador = federate.ambassador;
    const double now = federate.clock().time();
    switch (what) {
      case 0:
        return federate.clock().is_regulating() && below(4) == 0
                   ? ambassador.disable_time_regulation()
                   : ambassador.enable_time_regulation(some_lookahead());
      case 1:
        return federate.clock().is_constrained() && below(4) == 0
                   ? ambassador.disable_time_constrained()
                   : ambassador.enable_time_constrained();
      case 2:
        return ambassador.modify_lookahead(some_lookahead());
      case 3:
        return ambassador.time_advance_request(LogicalTime(now + some(7)));
      case 4:
        return ambassador.time_advance_request_available(LogicalTime(now + some(7)));
      case 5:
      case 6:
        return ambassador.next_message_request(LogicalTime(now + some(9)));
      case 7:
        return ambassador.next_message_request_available(LogicalTime(now + some(9)));
      case 8:
        return ambassador.flush_queue_request(LogicalTime(now + some(5)));
      case 9:
        return take_back();
      default: {
        if (!federate.clock().is_regulating()) return;
        const RetractionHandle handle =
            TimedFederation::say(federate, federate.clock().earliest() + some(5));
        said_.push_back({i, handle});
      }
    }
  }
  void take_back() {
    if (said_.empty()) return;
    Said& chosen = said_[said_.size() - 1 - below(std::min<std::size_t>(said_.size(), 6))];
    if (chosen.is_taken_back || at(chosen.sender).is_gone) return;
    at(chosen.sender).ambassador.retract(chosen.handle);
    chosen.is_taken_back = true;
  }

  /// Whoever still lives goes to one late instant, regulating and constrained as it is.
  void bring_to_the_end() {
    constexpr double end = 1e6;
    for (int round = 0; round < 20; ++round) {  // each brings at least one further: those ahead
                                                // that want to be constrained wait for those behind
      federation_.carry();
      for (std::size_t i = 0; i < count(); ++i) {
        note_arrival(i);
        if (at(i).is_gone || at(i).clock().is_advancing() || at(i).clock().time() == end) continue;
        try {
          at(i).ambassador.time_advance_request(LogicalTime(end));
        } catch (const RtiException& exception) {
          EXPECT_EQ(exception.error(),
                    HlaError::request_for_time_constrained_pending);  // it waits for the others to
                                                                      // come to where it is
        }
      }
    }
    federation_.carry();
    for (std::size_t i = 0; i < count(); ++i) {
      if (at(i).is_gone) continue;
      EXPECT_FALSE(at(i).clock().is_advancing())
          << "federate " << i << " is stuck at " << at(i).clock().time();
      EXPECT_EQ(at(i).clock().time(), end);
    }
  }
  void judge() {
    for (const std::uint64_t drops : federation_.execution().counters().drops)
      EXPECT_EQ(drops, 0u) << "the RTI refuses what the ambassador let pass";
    for (std::size_t i = 0; i < count(); ++i) {
      EXPECT_EQ(at(i).lost, "");
      if (at(i).is_gone) continue;
      std::map<std::pair<std::uint32_t, std::uint64_t>, int> heard, asked;
      for (const TimedFederate::Heard& each : at(i).heard) {
        const std::pair name{each.handle.sender.value, each.handle.number};
        if (each.what == What::message) ++heard[name];
        if (each.what == What::retraction) {
          EXPECT_EQ(heard[name], 1) << "asked to take back what it does not have";
          ++asked[name];
        }
        if (each.what == What::message && each.is_in_order) {
          EXPECT_GE(each.time, each.clock) << "in its past";
        }
      }
      for (std::size_t k = since_[i]; k < said_.size(); ++k) {
        const Said& said = said_[k];
        if (said.sender == i || !said.has_arrived) continue;
        const std::pair name{said.handle.sender.value, said.handle.number};
        EXPECT_EQ(heard[name], said.is_retracted ? asked[name] : 1)
            << "message " << k << " at " << said.handle.time << " to federate " << i;
        heard[name] = 1;
      }
      for (const auto& [name, times] : heard) EXPECT_LE(times, 1);
    }
  }

  std::mt19937_64 random_;
  TimedFederation federation_;
  std::vector<Said> said_;
  std::vector<std::size_t> since_;  ///< by federate: the first message that it must hear
};

void expect_order_in_chaos(std::uint64_t seed, int steps) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Chaos(seed).run(steps);
}

TEST(TimeChaos, EveryMessageComesOnceInOrderAndNobodyIsStuck) {
  for (std::uint64_t seed = 1; seed <= 300 && !::testing::Test::HasFailure(); ++seed)
    expect_order_in_chaos(seed, 400);
}

TEST(TimeChaosLong, EveryMessageComesOnceInOrderAndNobodyIsStuck) {
  for (std::uint64_t seed = 10'000; seed <= 20'000 && !::testing::Test::HasFailure(); ++seed)
    expect_order_in_chaos(seed, 600);
}

}  // namespace
}  // namespace rink::rti
