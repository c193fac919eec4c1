// One of the peers that share a simulation: it owns the bodies in its zones, plays them window by
// window among ghosts of their neighbours, and proves each window right.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "game/peer/division.h"
#include "game/peer/messages.h"
#include "game/peer/session/part_replica.h"
#include "game/peer/validation.h"
#include "game/physics/subdomain.h"

namespace rink::peer {

/// Counts of a peer since it was made.
struct PeerCounters {
  std::uint64_t windows = 0, repeats = 0;          ///< final windows, and repetitions
  std::uint64_t own_events = 0, ghost_events = 0;  ///< in final windows: events with own bodies,
                                                   ///< and without
  std::uint64_t hand_overs = 0;                    ///< bodies that left for another owner
  std::uint64_t held_max = 0;  ///< the most bodies at a window's start, own ones and ghosts; of
                               ///< several peers, the busiest one's
  std::uint64_t ghost_windows = 0;   ///< ghosts held, summed over the windows
  std::uint64_t border_windows = 0;  ///< own bodies that another peer has as ghosts, summed over
                                     ///< the windows, each counted once per such peer
  std::uint64_t arrival_bytes = 0, claim_bytes = 0, verdict_bytes = 0;  ///< sent

  PeerCounters& operator+=(const PeerCounters& other);
};

/// A bat of a live player of `peer`, which observes the `puck_count` nearest pucks at `phase`,
/// `phase` + `period`, ... [s], or at every window's end if `period` is 0.
struct Seat {
  std::uint32_t bat = 0;
  PeerNumber peer = 0;
  double period = 0.05, phase = 0.0;
  std::uint32_t puck_count = 0;
  /// True if an observation is due in the window from `begin` [s], not included, to `end`.
  bool is_due(double begin, double end) const;
};

enum class Outcome : std::uint8_t { final, repeat };

/// The protocol in its order (docs/peer-to-peer.md). All call `play`; then each makes claims for
/// each other, receives those of all others, judges, and receives all verdicts; `conclude` then
/// returns the same to all. `final`: each makes a handover for each other, receives theirs, and
/// commits. `repeat`: each makes a handover for those that repeat, these receive them and call
/// `replay`, and all continue with claims. Knows no network and no clock.
class Peer {
 public:
  /// `halo` [m] is the first width of the halo.
  Peer(const physics::WorldSpec& spec, const Division& division, PeerNumber number,
       std::uint32_t body_count, double halo);

  /// Call it at the start, before the first window, for every body of the whole: takes own bodies
  /// and those in the halo.
  void consider(std::uint32_t body, const BodyState& state);
  /// These replace `consider` to begin at a later window: its number and start [s], then parts of
  /// the whole, with all own bodies, those in the halo, and those in rest contact with them.
  void enter(std::uint32_t window, double start);
  void take(const Handover& part);
  /// Call it next; the first window ends at `until` [s].
  void begin(double until);

  /// Between windows: sets which peers play on. The others have no zones, and nothing is expected
  /// of them.
  void set_present(PeerNumber peer, bool is_present) {
    assert(peer < is_present_.size() && (is_present || peer != number_));
    is_present_[peer] = is_present;
  }
  bool is_present(PeerNumber peer) const {
    assert(peer < is_present_.size());
    return is_present_[peer];
  }
  /// Set for the next verdicts until changed.
  void wish_to_leave(bool wishes) { wishes_to_leave_ = wishes; }
  void announce(Admission admission) { admission_ = std::move(admission); }
  /// After `conclude` returned final, before the handovers: changes the zones from the window's end
  /// on, perhaps for more peers, which are not present yet. Equal at all peers.
  void divide(const Division& division);
  /// Makes `change` list the changes of each commit; the first one, after `begin`, lists all.
  void keep_changes() { keeps_changes_ = true; }
  /// The change of the own part since the last window, or all of it if `is_whole`; its step is left
  /// out.
  PartChange change(bool is_whole) const;
  /// After a commit: puts a scored puck, with its owner's state, back in play at `place`, which is
  /// free at all peers.
  void put_back(const Handover::Body& scored, const Vector2& place);
  bool owns(std::uint32_t body) const {
    assert(body < roles_.size());
    return roles_[body] == own;
  }

  /// Adds a key of an own bat before the first window.
  void press_first(const Key& key) { keys_.push_back(key); }

  /// Between windows, equal at all peers: sets the player of the bat. One player for each.
  void seat(const Seat& seat) {
    assert(seat.bat < roles_.size() && seat.period >= 0.0);
    seats_.push_back(seat);
  }
  /// The observations for own players, since the last commit.
  const std::vector<Observation>& observations() const { return observations_; }
  /// The observations of all own bats that `player` plays, due or not.
  std::vector<Observation> observations_of_all(PeerNumber player) const;
  /// After a commit and before the claims of the next window: sends an own player's key to `owner`,
  /// which the newest observation of the bat names. The owner stamps it with the end of that window
  /// or, if later, with its own instant, at most `ahead_max` later; the instants of a player's keys
  /// must not fall.
  void press(PeerNumber owner, const Press& press) {
    assert(owner < presses_.size() && press.input != 0);
    presses_[owner].push_back(press);
  }
  static constexpr double ahead_max = 1.0;  ///< s
  /// The end of the next window [s].
  double end() const { return end_; }
  /// Keys of live players that took effect on own bats in the last window, in order.
  const std::vector<Key>& log() const { return log_; }

  void play();
  Claims claims_for(PeerNumber peer);
  /// Checks all messages by `validator` from now on. An invalid one is dropped, and its sender is
  /// reported.
  void validate_by(Validator validator) { validator_ = std::move(validator); }
  void receive(PeerNumber from, Claims claims);
  const Verdict& judge();
  void receive(PeerNumber from, const Verdict& verdict);
  Outcome conclude();
  const Verdict& verdict() const { return verdicts_[number_]; }
  const Verdict& verdict_of(PeerNumber peer) const {
    assert(peer < verdicts_.size());
    return verdicts_[peer];
  }
  bool repeats(PeerNumber peer) const {
    assert(peer < is_repeating_.size());
    return is_repeating_[peer];
  }
  /// Between the handovers for `peer` and the commit: true if `peer` will have the own body in the
  /// next window, as its own or as a ghost.
  bool will_have(PeerNumber peer, std::uint32_t body) const;

  Handover handover_for_repeat(PeerNumber peer);
  /// `until` [s]: the end of the next window.
  Handover handover_for(PeerNumber peer, double until);
  void receive(PeerNumber from, Handover handover);
  void replay();
  void commit(double until);
  /// After a commit, and before anything is played: shortens the prepared window to this end [s].
  void end_at(double until);

  PeerNumber number() const { return number_; }
  double now() const { return subdomain_.world().now(); }
  const std::vector<std::uint32_t>& owned() const { return owned_; }
  const std::vector<std::uint32_t>& ghosts() const { return ghosts_; }
  BodyState state(std::uint32_t body) const { return subdomain_.state(body); }
  /// A place where the body certainly was: at the end of the judged window, or at its start if it
  /// is a ghost whose owner claims another path. After a commit, its present place.
  Vector2 known_place(std::uint32_t body) const;
  /// All bodies in its contact group, directly or through others, itself first.
  std::vector<std::uint32_t> group_of(std::uint32_t body) const {
    return subdomain_.group_of(body);
  }
  const physics::World& world() const { return subdomain_.world(); }
  double halo() const { return halos_[number_]; }
  const PeerCounters& counters() const { return counters_; }
  /// The reason why another peer's message cannot be true, naming the peer; empty if all could be.
  const std::string& accusation() const { return accusation_; }
  PeerNumber reported() const { return reported_; }

  /// At a window's start: asserts that every body has one role, that lists of own bodies and ghosts
  /// have those of that role, each once, and that others' ghosts of own bodies are own bodies.
  void check() const;

 private:
  enum Role : std::uint8_t { away, ghost, own };
  /// `late`: since an event in this window; earlier ones were at home.
  enum Watch : std::uint8_t { not_watched, watched, late };
  /// A body's event in the `change`th change of the journal; `state` as in ClaimedFlight.
  struct Step {
    std::uint32_t body, change;
    std::uint64_t state;
  };
  struct PathFlight {
    double begin, end;
    std::uint64_t state;
    Box box;
  };
  /// The path of a body: the flights from `begin` to `end`, the first being that at the window's
  /// start.
  struct Path {
    std::uint32_t body;
    std::size_t begin, end;
  };
  struct Reach {
    std::uint32_t body;
    Box box;
  };
  struct Events {
    std::size_t begin, end;  // changes of one event
  };

  // peer.cpp
  Vector2 extent_of(std::uint32_t body) const { return subdomain_.world().half_extent({body}); }
  Vector2 start_place(std::uint32_t body) const;
  Box reach_of(std::uint32_t body) const;
  bool is_in_region(PeerNumber peer, const Box& box) const {
    return division_.is_near(peer, box, halos_[peer]);
  }
  void play_anew();
  void play_keys(double until);
  void set_rest_contacts(std::vector<RestContact> rest_contacts);
  void correct_doubtful();
  void own_from_now(std::uint32_t body);
  void disown(std::uint32_t body);
  void settle(std::vector<std::uint32_t> candidates);
  void share_keys(double until);

  // peer_handovers.cpp
  bool knows(PeerNumber peer, std::uint32_t body) const;
  Box start_reach(std::uint32_t body) const;
  void enter_bodies(const Handover& handover, PeerNumber from);
  void complete_free_flights(Handover& handover, PeerNumber from);

  // peer_homes.cpp
  std::uint8_t home_of(const Vector2& place, std::uint8_t likely) const;
  double least_margin() const;
  bool is_margin_fit() const;
  void choose_margin();
  void watch(std::uint32_t body, Watch how);
  bool stays(std::uint8_t home, const Vector2& place, const Vector2& velocity, double since) const;
  void choose_watched();
  bool is_watch_fit() const { return end_ <= watched_until_; }
  void find_edge();
  Box room_at_home(std::uint32_t body) const;
  void look_at(std::uint32_t body);
  void note_edge(std::uint32_t body);

  // peer_claims.cpp
  void survey();
  void trace();
  void enter_event(Events event);
  std::span<const Step> steps_of(std::uint32_t body) const;
  physics::Motion motion_after(const Step& step) const;
  void lay_out_paths();

  // peer_verdict.cpp
  double first_difference(std::uint32_t ghost, std::span<const ClaimedFlight> claimed,
                          std::vector<PathFlight>& beyond) const;
  bool may_touch_own(const PathFlight& flight) const;
  std::vector<Goal> goals() const;
  std::vector<std::uint8_t> parts_of_events() const;
  std::uint64_t at_once_bound() const;
  double needed_halo() const;
  bool validate_claims();
  bool validate_ghosts();
  void blame(bool doubts_ghosts);
  bool report(PeerNumber peer, const std::string& of);

  // peer_players.cpp
  Observation observation_of(const Seat& seat) const;
  std::vector<Observation> observations_for(PeerNumber peer) const;
  void handle_observations(PeerNumber from);
  void handle_presses();
  void note_log();

  // peer_parts.cpp
  void make_room(PeerNumber peer_count);
  void note_changed();

  template <class Message, class... Instants>
  bool is_sound(PeerNumber from, const Message& message, Instants... instants);

  physics::Subdomain subdomain_;
  std::optional<Validator> validator_;
  Division division_;
  PeerNumber number_;
  double halo_max_;
  std::uint32_t window_ = 0;
  double start_ = 0.0, end_ = 0.0;  // of the window
  double told_ = 0.0;               // of the states that are handed over next
  double usual_halo_, halo_min_, extent_max_ = 0.0;
  double margin_ =
      -1.0;  // a place deeper in a zone is at home: no other peer's halo reaches a body there
  std::vector<Box> interiors_;  // of the own zones
  std::vector<double> halos_;   // by peer
  std::vector<bool> is_repeating_, is_present_;
  bool wishes_to_leave_ = false, keeps_changes_ = false;
  Admission admission_;
  std::vector<std::uint32_t> changed_, left_;  // in the last commit: own bodies whose states
                                               // changed, or that came; and those that went
  std::vector<std::uint32_t>
      free_flights_;  // in the last commit: own bodies that free impacts alone changed
  std::vector<std::uint8_t> roles_, homes_, end_homes_,
      is_edge_;  // homes: 1 + number of the own zone in which a body is at home; 0 if in none, or
                 // if it has companions
  std::vector<std::uint8_t> is_watched_;
  std::vector<std::uint32_t> watched_;  // own bodies; all others are at home, and stay there until
                                        // `watched_until_` [s] if nothing happens to them
  double watched_until_ = -1.0;
  std::vector<std::uint32_t> edge_;  // own bodies that were not at home all the time; sorted
  std::vector<std::uint32_t> owned_places_;  // in `owned_`
  std::vector<PeerNumber> owners_;           // of those that are there, in this window
  std::vector<std::uint32_t> owned_, ghosts_;
  std::vector<Reach>
      groups_;  // own bodies with companions: what they all take up at the window's start
  std::vector<Reach> outskirts_;  // own bodies that are not at home at the window's end: what they
                                  // and their companions take up then
  std::vector<std::vector<std::uint32_t>>
      known_;  // to each peer, at the window's start: which of the own bodies it has; sorted
  std::vector<RestContact>
      entered_holds_;  // of parts that were taken, until the first window begins
  std::vector<std::vector<std::uint32_t>>
      coming_;  // to each peer, in the next window: which of the own bodies it will have; sorted
  std::vector<Key> keys_, due_;  // still to come, of own bats; in this window
  std::vector<Seat> seats_;
  std::vector<Observation> observations_;
  std::vector<std::vector<Press>> presses_;  // by owner: to go with the next claims
  std::vector<Key> log_;
  std::vector<Step>
      steps_;  // of ghosts and of own bodies that were not at home all the time; by body
  std::vector<Events> mixed_;  // events of own bodies and ghosts
  std::vector<Path> paths_;    // of own bodies that were not at home all the time
  std::vector<PathFlight> flights_;
  Box hull_{};  // holds all of these
  std::vector<double>
      doubts_;  // as in ghosts_: when the ghost ceases to be what its owner says; never, as a rule
  std::vector<bool> is_unmoved_;  // by ghost: its owner says that nothing happened to it
  std::vector<Claims> claims_;
  std::vector<Verdict> verdicts_;
  std::vector<Handover> handovers_;
  std::uint64_t own_events_ = 0, ghost_events_ = 0;
  std::uint32_t attempts_ = 0;
  PeerCounters counters_;
  std::string accusation_;
  PeerNumber reported_ = 0;
};

}  // namespace rink::peer
