// The services by which a federate takes part in saving and restoring its federation (IEEE
// 1516.1-2010, 4.16 to 4.31).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/services/federate_time.h"
#include "rti/federate/services/join_session.h"
#include "rti/federate/services/sparing.h"
#include "rti/wire/save_messages.h"

namespace rink::rti {

/// The federate is asked to save or restore itself; its ambassador's state goes to the RTI with the
/// federate's word that it has saved, and comes back when all have restored.
class FederateSaves {
 public:
  struct Uses {
    JoinSession& session;
    Sparing& sparing;
    UpdateSender& sender;
    const FederateTime& time;
  };
  using Write = std::function<void(std::vector<std::byte>& state)>;
  /// False if the state is damaged.
  using Read = std::function<bool(Bytes state, std::uint32_t block)>;
  FederateSaves(const AmbassadorBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}
  /// Call it once, before the federate joins.
  void keep_by(Write write, Read read) {
    write_ = std::move(write);
    read_ = std::move(read);
  }

  /// Throws SaveInProgress or RestoreInProgress.
  void require_idle() const {
    if (activity_ != Activity::none) refuse_busy();
  }
  void request(std::string_view label, std::optional<LogicalTime> time);
  void begun();
  void complete(bool is_success);
  void abort();
  void query();
  void request_restore(std::string_view label);
  void complete_restore(bool is_success);
  void abort_restore();
  void query_restore();

  bool handle_notice(Reader& reader);
  bool handle_status(Reader& reader);
  bool handle_restored(Reader& reader);
  /// False while nothing but saving and restoring is done, and once restored: a datagram may be
  /// older than the restore.
  bool takes_datagrams() const { return activity_ == Activity::none && !was_restored_; }

 private:
  enum class Activity : std::uint8_t { none, saving, restoring };
  enum class Step : std::uint8_t { none, asked, begun, answered };
  [[noreturn]] void refuse_busy() const;
  void require_not(Activity activity) const;
  /// Sends a window of pieces, and that it is complete with the last.
  void send_state();
  void say(SaveWord word, std::string_view label = {}, double time = 0.0);
  /// True, and noted, if this answers a save or restore that has ended, of which the federate may
  /// not have been told yet.
  bool is_late(Activity activity, Step step);
  void end();
  void settle();
  void call_back(const SaveNoticeMessage& message);

  AmbassadorBasis basis_;
  Uses uses_;
  Write write_;
  Read read_;
  Activity activity_ = Activity::none;
  Step step_ = Step::none;
  Activity ended_ = Activity::none;  ///< the last, as long as an answer to it may come
  Step ended_step_ = Step::none;     ///< how far it was when it ended
  std::uint32_t number_ = 0;         ///< of the save or restore under way
  bool was_restored_ = false;
  std::vector<std::byte> outgoing_, incoming_;  ///< state that is sent, or that comes
  std::size_t sent_ = 0;                        ///< of the former
};

}  // namespace rink::rti
