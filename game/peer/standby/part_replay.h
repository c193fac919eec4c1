// Plays a part again, from a snapshot and the inputs of its steps since.
#pragma once

#include <string>
#include <vector>

#include "game/peer/division.h"
#include "game/peer/standby/part_record.h"
#include "game/peer/validation.h"
#include "game/physics/subdomain.h"

namespace rink::peer {

/// A peer's own part at a step.
struct Part {
  double time = 0.0;                         ///< s
  std::vector<Handover::Body> bodies{};      ///< own ones, by number
  std::vector<RestContact> rest_contacts{};  ///< of these
  std::vector<Key> keys{};                   ///< as PartRecord's `pending`
};

/// What it is told must be sound (fault_of).
class PartReplay {
 public:
  /// `time` [s] is that of the snapshot; `scene` must outlive it.
  PartReplay(const physics::WorldSpec& spec, const Validator& scene, const PartSnapshot& snapshot,
             double time);

  /// The next step.
  void play(const PartRecord& record);
  /// What of it is own at the last step, where the zones of `peer` are those of `division`.
  Part part(const Division& division, PeerNumber peer) const;

 private:
  void enter(const PartInput& input);

  const Validator& scene_;
  physics::Subdomain subdomain_;
  std::vector<Key> pending_;
};

/// Why these inputs of a step cannot be true, as in "hands over body 7 at no place"; empty if they
/// can. The run begins at `start` and ends at `end` [s].
std::string fault_of(const PartRecord& record, const Validator& scene, double start, double end);
std::string fault_of(const PartSnapshot& snapshot, const Validator& scene, double time);

}  // namespace rink::peer
