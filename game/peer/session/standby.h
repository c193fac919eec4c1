// A session's side of standby copies: the own part is told to who keeps it, step by step, and those
// of others are kept here. docs/peer-to-peer.md, "Standby copies".
#pragma once

#include <cstdint>
#include <vector>

#include "game/peer/protocol.h"
#include "game/peer/session/inbox.h"
#include "game/peer/session/replicas.h"
#include "game/peer/session/session_settings.h"
#include "game/peer/session/session_state.h"
#include "game/peer/standby/standby_feed.h"

namespace rink::peer {

class Standby {
 public:
  /// All must outlive it.
  Standby(const SessionSettings& settings, Inbox& inbox, Mail& mail)
      : settings_(settings),
        inbox_(inbox),
        mail_(mail),
        replicas_(settings.number),
        feed_(settings.standby) {}

  const Replicas& replicas() const { return replicas_; }
  void make_room(PeerNumber slots) { replicas_.make_room(slots); }
  /// At the start, which all know: begins the copies of others, and of the own part.
  void begin_others(const Start& start, const State& now);
  void begin_own(PartLog& log);
  /// A newcomer has nothing yet.
  void enter(const State& now, PartLog& log);

  /// Brings the copies of the own part, here and at another peer, and those of others here, from
  /// `now` to the step that leads to `next`. `is_anew`: the own part is another since then. Throws
  /// PeerGone.
  struct Step {
    const State& now;
    const State& next;
    bool is_anew = false;
  };
  void pass(const Step& step, Peer& peer, PartRecord record);
  void rewind(std::uint64_t step) { replicas_.rewind(step); }
  /// After that: the own part at this step, and those that this peer stands in for, whose keys it
  /// inherits.
  std::vector<Part> played_parts(const State& now, const physics::WorldSpec& spec,
                                 std::vector<Key>& inherited) const;
  /// Bytes sent; and how many snapshots were due because replays had become long.
  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t snapshots() const { return snapshots_; }

 private:
  void note_own(const Step& step, PartLog& log, const PartRecord& record, bool is_first);
  void tell(PeerNumber keeper, PartRecord record, bool is_first);
  void hear(PeerNumber from, const Step& step, const Peer& peer);

  const SessionSettings& settings_;
  Inbox& inbox_;
  Mail& mail_;
  Replicas replicas_;  ///< of the own part, and of those that this peer keeps
  StandbyFeed feed_;   ///< of whoever keeps the own part
  std::uint64_t bytes_ = 0, snapshots_ = 0;
};

}  // namespace rink::peer
