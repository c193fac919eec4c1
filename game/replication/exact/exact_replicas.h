// The receiver's side of the policy "exact": computes all that it knows with the engine's own
// subdomain, bit for bit as the server does.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/physics/subdomain.h"
#include "game/replication/exact/exact_messages.h"
#include "rti/types.h"
#include "rti/wire/bytes.h"

namespace rink::game {

/// Counts since the replicas were made.
struct ExactReplicaCounters {
  std::uint64_t ticks = 0, keys = 0, entries = 0, exits = 0, starts = 0;
  std::uint64_t doubtful = 0;  ///< bodies that were told in a tick, since what hit them was
                               ///< unknown: in doubt from the hit until the tick's end
  std::uint64_t hashes = 0, wrong_hashes = 0, malformed = 0;
};

/// Knows no network. A message of another version of the server, or a wrong one, never harms: it
/// is refused, and nothing is exact until the next start.
class ExactReplicas {
 public:
  /// Of the keys of one conversation so many wrong hashes without a right one in between, and the
  /// receiver computes otherwise than the sender.
  static constexpr std::uint32_t wrong_in_row_max = 3;

  struct Body {
    std::uint32_t number = 0, exact_class = 0, player = 0;
    rti::ObjectHandle object;
    bool is_in_scope = true;   ///< else it lingers: it left, and is computed on while that costs
                               ///< nothing
    bool is_computed = false;  ///< else it is held by somebody unknown, and told at each change
    physics::BodyState state;  ///< while it is not computed, or is a post
    Drive drive;               ///< of bats
  };

  enum class Result : std::uint8_t {
    exact,    ///< all known bodies are as at the sender
    waiting,  ///< for all to be sent again
    resend,   ///< something does not fit: all must be sent again
    hopeless  ///< and that has not helped
  };
  /// One message of the sender, which is not trusted.
  Result receive(rti::Bytes message);

  /// Whether the last message left all that is known exact.
  bool is_exact() const { return is_exact_; }
  /// Why not; empty if it is.
  const std::string& error() const { return error_; }

  double time() const { return time_; }  ///< of the last tick [s]
  std::uint64_t tag() const { return tag_; }
  std::uint32_t felt() const { return felt_; }
  /// By number.
  std::span<const Body> bodies() const { return bodies_; }
  const ExactClass& class_of(const Body& body) const { return start_->classes[body.exact_class]; }
  const physics::WorldSpec& spec() const { return start_->spec; }
  /// The law of a known body from its last event on, as of the last tick or where look_ahead() left
  /// it.
  physics::Motion motion(const Body& body) const;
  bool is_in_play(const Body& body) const;
  physics::BodyState state(const Body& body) const {
    return body.is_computed ? part_->state(body.number) : body.state;
  }

  /// Who left with the last message, perhaps for good.
  struct Left {
    rti::ObjectHandle object;
    bool is_removed = false;
  };
  std::span<const Left> left() const { return left_; }
  /// Bodies in scope since the last message, and all known ones that move otherwise than before it.
  std::span<const std::uint32_t> entered() const { return entered_; }
  std::span<const std::uint32_t> changed() const { return changed_; }
  /// Null if it is not known.
  const Body* find(std::uint32_t number) const;
  /// Whether the last message began the conversation, or began it anew.
  bool has_started() const { return has_started_; }

  /// Plays on to `instant` [s] without news; the next message takes it back and plays it again.
  /// Nobody is exact until then. An instant that is not after that of the last tick, or more than
  /// `ahead_max` after it, only goes so far.
  void look_ahead(double instant);
  /// Takes look_ahead() back: all are again as of the last tick. changed() lists whom it had
  /// changed.
  void look_back();
  static constexpr double ahead_max = 0.5;  ///< s

  const ExactReplicaCounters& counters() const { return counters_; }
  std::size_t memory_bytes() const {
    return sizeof *this + bodies_.capacity() * (sizeof(Body) + sizeof(physics::BodyState));
  }

 private:
  Result refuse(const std::string& why);
  bool read(rti::Bytes message, ExactTick& tick);
  void begin(const ExactStart& start);
  bool apply(const ExactTick& tick);
  void set_aside(const ExactTick& tick);
  void play(const ExactTick& tick);
  bool enter(const ExactTick& tick);
  void leave(const ExactTick& tick);
  void cast_off(std::uint32_t number);
  bool settle_groups();
  bool takes_part(const Body& body, std::vector<std::uint32_t>& group) const;
  std::uint32_t hash() const;
  bool are_held_by_contacts(std::span<const std::uint32_t> settled) const;
  void list_ranks();
  void list_changed();
  Body* known_at(std::uint32_t number);

  std::optional<ExactStart> start_;
  std::unique_ptr<physics::Subdomain> part_;
  std::vector<Body> bodies_;  ///< known ones, by number
  struct Ranks {
    std::vector<std::uint32_t> classes;  ///< of all known bodies
    std::vector<std::uint32_t> bats;     ///< numbers
    std::vector<Drive> drives;           ///< of these
  };
  Ranks ranks_;
  /// Of bodies that are not computed.
  std::vector<physics::RestContact> outer_contacts_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> outer_jams_;  ///< a body and its companion
  double time_ = 0.0;
  std::uint64_t tag_ = 0;
  std::uint32_t felt_ = 0, wrong_in_row_ = 0;
  bool is_exact_ = false, awaits_start_ = true, is_ahead_ = false, has_started_ = false;
  std::string error_;
  std::vector<Left> left_;
  std::vector<std::uint32_t> entered_, changed_;
  physics::ChangeCursor cursor_;
  ExactReplicaCounters counters_;
};

}  // namespace rink::game
