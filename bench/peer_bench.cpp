// What sharing a gas between two peers in two threads gains over one engine on one thread, with the
// states of both compared to the bit.
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <thread>

#include "bench/clock.h"
#include "bench/trials/diagram_trials.h"
#include "game/peer/protocol.h"
#include "tests/peer/thread_mail.h"

namespace rink::bench::peer_bench {
namespace {

namespace peer = rink::peer;
namespace physics = rink::physics;
using peer::PeerNumber;

constexpr PeerNumber peer_count = 2;

/// Collisions in which a disc takes part per second, at mean speed 1, by Enskog's theory: a disc
/// sweeps twice its diameter at the mean relative speed, the root of two. Each is one of two discs.
double collision_rate(double packing) {
  constexpr double radius = 0.04;  // m
  const double density = packing / (std::numbers::pi * radius * radius),
               crowding = (1.0 - 7.0 / 16.0 * packing) / std::pow(1.0 - packing, 2);
  return std::sqrt(2.0) * 4.0 * radius * density * crowding;
}

physics::World gas(std::uint32_t count, double packing) {
  const rink::accuracy::Trial trial = rink::accuracy::gas(count, packing);
  physics::World world(trial.world);
  rink::accuracy::load(trial, world);
  return world;
}

double real_s() { return seconds_of(CLOCK_MONOTONIC); }

/// Looks again and again for a while before it sleeps, as who has a processor of its own may: to be
/// woken takes longer than most waits.
class WatchfulMail final : public peer::Mail {
 public:
  WatchfulMail(peer::test::PostOffice& office, PeerNumber number)
      : office_(office), number_(number), mail_(office, number) {}
  void send(PeerNumber to, std::vector<std::uint8_t> bytes) override {
    mail_.send(to, std::move(bytes));
  }
  std::vector<std::uint8_t> receive(PeerNumber from) override {
    constexpr double patience_s = 3e-3;
    const double begin = seconds_of();
    while (office_.between(from, number_).is_empty() && seconds_of() < begin + patience_s) {
    }
    watched_s_ += seconds_of() - begin;
    return mail_.receive(from);
  }
  /// Processor time spent on looking.
  double watched_s() const { return watched_s_; }

 private:
  peer::test::PostOffice& office_;
  PeerNumber number_;
  peer::test::ThreadMail mail_;
  double watched_s_ = 0.0;
};

struct Share {
  std::unique_ptr<peer::Peer> peer;
  peer::PeerCounters before;
  double processor_s = 0.0;
};

/// Two peers, of whom one plays in a thread of its own.
class Couple {
 public:
  Couple(const physics::World& whole, double window) : window_(window) {
    const peer::Division division = peer::Division::into_strips(whole.spec().field, peer_count);
    for (PeerNumber number = 0; number < peer_count; ++number) {
      shares_[number].peer =
          std::make_unique<peer::Peer>(whole.spec(), division, number, whole.body_count(), 0.5);
      for (std::uint32_t body = 0; body < whole.body_count(); ++body)
        shares_[number].peer->consider(body, physics::Subdomain::state_in(whole, body));
      shares_[number].peer->begin(window);
    }
  }
  /// Real time [s] of so many windows.
  double play(int count) {
    const double begin = real_s();
    {
      const std::jthread other([&] { play(1, count); });
      play(0, count);
    }
    played_ += count;
    return real_s() - begin;
  }
  std::array<Share, peer_count>& shares() { return shares_; }

 private:
  void play(PeerNumber number, int count) {
    Share& share = shares_[number];
    WatchfulMail mail(office_, number);
    share.before = share.peer->counters();
    const double begin = seconds_of();
    for (int k = 1; k <= count; ++k)
      peer::play_window(*share.peer, peer_count, mail, window_ * (played_ + k + 1));
    share.processor_s = seconds_of() - begin - mail.watched_s();
  }

  double window_;
  int played_ = 0;
  std::array<Share, peer_count> shares_;
  peer::test::PostOffice office_{peer_count};
};

/// Both play the same windows; the first ones, in which halos find their width, are not timed. One
/// iteration, for the two must be of one state.
void share(benchmark::State& state, std::uint32_t count, double packing) {
  const double window = 0.4 / collision_rate(packing);
  const int warm_up = 10, timed = 50;
  for (auto _ : state) {
    physics::World whole = gas(count, packing);
    Couple couple(whole, window);
    whole.advance(window * warm_up);
    couple.play(warm_up);
    const std::uint64_t impacts_before = whole.counters().disc_impacts;
    const double begin = real_s(), processor_begin = seconds_of();
    whole.advance(window * (warm_up + timed));
    const double alone_processor_s = seconds_of() - processor_begin, alone_s = real_s() - begin;
    const double shared_s = couple.play(timed);
    state.SetIterationTime(shared_s);
    double busier_s = 0.0, repeats = 0.0, bytes = 0.0, border = 0.0, ghost_events = 0.0,
           own_events = 0.0;
    std::uint32_t different = 0, owned = 0;
    std::vector<peer::Handover> parts;
    for (const Share& share : couple.shares()) {
      const peer::PeerCounters &now = share.peer->counters(), &then = share.before;
      busier_s = std::max(busier_s, share.processor_s);
      parts.push_back(peer::own_bodies(*share.peer));
      repeats += static_cast<double>(now.repeats - then.repeats);
      bytes += static_cast<double>(now.arrival_bytes + now.claim_bytes - then.arrival_bytes -
                                   then.claim_bytes);
      border += static_cast<double>(now.border_windows - then.border_windows);
      ghost_events += static_cast<double>(now.ghost_events - then.ghost_events),
          own_events += static_cast<double>(now.own_events - then.own_events);
      for (const std::uint32_t body : share.peer->owned())
        different += peer::bytes_of(share.peer->share().state(body)) !=
                     peer::bytes_of(physics::Subdomain::state_in(whole, body)),
            ++owned;
    }
    const auto shared_hash = peer::hash_of_whole(whole.spec(), whole.body_count(), parts);
    if (different > 0 || owned != count || shared_hash != whole.hash())
      return state.SkipWithError("the peers' states are not the engine's");
    char label[64];
    std::snprintf(label, sizeof label, "hash %016llx of both",
                  static_cast<unsigned long long>(*shared_hash));
    state.SetLabel(label);
    // On a quiet machine both columns agree, but for the time in which one peer waits for the
    // other.
    state.counters["alone_real_s"] = alone_s,
    state.counters["alone_processor_s"] = alone_processor_s;
    state.counters["shared_real_s"] = shared_s, state.counters["busier_processor_s"] = busier_s;
    state.counters["speed_up"] = alone_s / shared_s;
    state.counters["speed_up_by_processor_time"] = alone_processor_s / busier_s;
    state.counters["collisions_per_body_and_window"] =
        2.0 * static_cast<double>(whole.counters().disc_impacts - impacts_before) /
        (static_cast<double>(count) * timed);
    state.counters["repeated_share"] = repeats / (timed * peer_count);
    state.counters["bytes_per_border_body_and_window"] = bytes / border;
    state.counters["border_bodies"] = border / (timed * peer_count);
    state.counters["ghost_event_share"] = ghost_events / own_events;
    state.counters["different_states"] = different;
  }
}

const bool registered = [] {
  for (const double packing : {0.05, 0.3}) {
    char name[64];
    std::snprintf(name, sizeof name, "peer/share/peers:2/n:100000/packing:%g", packing);
    benchmark::RegisterBenchmark(name,
                                 [=](benchmark::State& state) { share(state, 100'000, packing); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  }
  return true;
}();

}  // namespace
}  // namespace rink::bench::peer_bench
