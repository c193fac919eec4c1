// The client federate: sends its player's keys, keeps its interest around its bat, and keeps
// replicas of what it receives.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "game/model/key.h"
#include "game/net/client/computed_replicas.h"
#include "game/net/client/interest_questions.h"
#include "game/net/client/joining.h"
#include "game/net/client/match_remote.h"
#include "game/net/client/receipt_log.h"
#include "game/net/client/turn_taker.h"
#include "game/net/following_view.h"
#include "game/replication/replica_set.h"
#include "rti/ambassador.h"

namespace rink::game {

struct ClientSettings {
  std::string federation = "rink";
  std::string name;             ///< of the federate; "bat-17" asks for that bat
  double view_fraction = 0.05;  ///< area of the square view around the bat, as a fraction of the
                                ///< field's; at least 1: everything
  double view_area = 0.0;       ///< area of the view [m^2] instead; 0: use the fraction
  /// How far the declared region reaches beyond the view on each side [m]. It is declared anew when
  /// the bat is half of that from its middle: the other half covers the bat's motion until the RTI
  /// has received it.
  double view_margin = 0.0;
  /// Whether the view is declared as a region that follows the bat. Without it the subscription is
  /// to the default region, that is everything: for the scheme `none`, which ignores places, so
  /// that declarations would be wasted bytes.
  bool declares_regions = true;
  /// Whether entities that are updated by positions alone are extrapolated by the velocity between
  /// the last two; without it they are shown at the last one, as in the paper.
  bool extrapolates = true;
  bool plays_match = false;   ///< a hosted one: receives its state, may pause it and ask for
                              ///< another
  bool only_watches = false;  ///< takes no bat; sees the whole field
  rti::Timeouts timeouts{};   ///< of a silent host
  bool computes = true;       ///< what it knows, where the server's policy is "exact"; else it is
                              ///< sent trajectories there
};

/// One player's federate. No clock, no socket: `ambassador` takes and gives the bytes.
class Client : public rti::FederateAmbassador {
 public:
  using State = Joining::State;

  Client(const rti::Fom& fom, const ObjectModel& model, const ClientSettings& settings);
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  rti::Ambassador& ambassador() { return ambassador_; }
  const rti::Ambassador& ambassador() const { return ambassador_; }

  /// Sends KeyDown or KeyUp and counts it in `keys_sent`. Only while playing. In a hosted match the
  /// key takes effect at the simulated `instant` [s] unless that has passed when it arrives; else,
  /// and in every other game, at its arrival.
  void press(Key key, double instant = 0.0);
  void release(Key key, double instant = 0.0);
  /// With the pushes of its remote, which take effect as keys do.
  std::uint32_t keys_sent() const { return keys_sent_ + (remote_ ? remote_->pushes_sent() : 0); }
  /// Synchronous mode: ends this player's turn; under time management it then asks to advance to
  /// the next tick, so only while it has the turn (asserted).
  void end_turn();
  const TurnTaker& turns() const { return turns_; }
  /// Moves the interest region to where the bat was last seen; call it after each batch received.
  /// Sends nothing if the bat did not move (by half the margin).
  void follow_bat() { follow_bat(replicas_.newest().time); }
  /// Moves the region to the bat's believed place at simulated `instant` [s], since a bat on a
  /// trajectory moves between updates.
  void follow_bat(double instant);

  /// Called before the first update with another stamp than the newest is applied: the replica set
  /// then has the whole state at the newest stamp for the last time.
  std::function<void()> before_next_stamp;

  /// Called after an update is applied, with its stamp, if the update before it had another: once
  /// for each batch, also if several are read at once. The full state of an entity that comes into
  /// scope does not call it, since its stamp is its owner's newest and may be of a tick long
  /// before.
  std::function<void(const rti::Stamp&)> on_news;

  /// What it computes; null unless the server's policy is "exact". Once it has computed otherwise
  /// than the server again and again, it is sent trajectories.
  ComputedReplicas* computed() { return computed_ ? &*computed_ : nullptr; }
  /// A log of received updates for measurements; off at first.
  ReceiptLog& received() { return received_; }
  /// Null unless it plays hosted matches.
  MatchRemote* remote() { return remote_ ? &*remote_ : nullptr; }
  /// Null unless it only watches.
  InterestQuestions* questions() { return questions_ ? &*questions_ : nullptr; }

  State state() const { return joining_.state(); }
  const Joining& joining() const { return joining_; }
  /// The interest region as last declared; it follows the bat by one round trip.
  const im::Region& view() const { return view_.bounds(); }
  /// The replica of the own bat; null before the first update.
  const EntityReplica* bat() const { return replicas_.find(bat_); }
  const ReplicaSet& replicas() const { return replicas_; }
  /// Memory of the client: itself, tables and buffers [bytes].
  std::size_t memory_bytes() const {
    return sizeof *this + replicas_.memory_bytes() + ambassador_.memory_bytes() +
           encoded_.capacity() + (computed_ ? computed_->memory_bytes() : 0);
  }

 private:
  void join_refused(rti::Refusal refusal, std::string_view why) override;
  void connection_lost(std::string_view why) override;
  void announce_synchronization_point(std::string_view label, rti::Bytes tag) override;
  void federation_synchronized(std::string_view label,
                               std::span<const rti::FederateHandle> failed) override;
  void discover_object_instance(rti::ObjectHandle object, rti::ObjectClassHandle object_class,
                                std::string_view name) override;
  void reflect_attribute_values(rti::ObjectHandle object, rti::AttributeSet attributes,
                                rti::Bytes values, const rti::Stamp& stamp) override;
  void attributes_in_scope(rti::ObjectHandle object) override;
  void attributes_out_of_scope(rti::ObjectHandle object) override;
  void remove_object_instance(rti::ObjectHandle object) override;
  void receive_interaction(rti::InteractionClassHandle interaction, rti::Bytes parameters,
                           rti::FederateHandle sender, const rti::Stamp& stamp) override;

  void receive_host_message(rti::Bytes content) override;

  void time_regulation_enabled(rti::LogicalTime time) override;
  void time_constrained_enabled(rti::LogicalTime time) override;
  void time_advance_grant(rti::LogicalTime time) override;
  void time_bounds(double galt, double lits) override;

  void receive_pace(rti::Bytes parameters, const rti::Stamp& stamp);
  void begin_time();
  void ask_for_tick();
  void pass_if_absent();
  void send_key(rti::InteractionClassHandle interaction, Key key, double instant);
  void look_around(const Position& centre);
  void subscribe_once_seated();
  void reach_barrier_once_ready();

  const ObjectModel& model_;
  ClientSettings settings_;
  ReplicaSet replicas_;
  rti::Ambassador ambassador_;
  Joining joining_;
  TurnTaker turns_;
  rti::ObjectHandle bat_;
  rti::RegionHandle region_;  ///< that is declared as the view
  FollowingView view_;
  std::vector<std::byte> encoded_;
  rti::Stamp news_;  ///< of the newest update that was no state on entry
  std::uint32_t keys_sent_ = 0;
  std::optional<MatchRemote> remote_;
  std::optional<InterestQuestions> questions_;
  ReceiptLog received_;
  std::optional<ComputedReplicas> computed_;
};

}  // namespace rink::game
