// Sends each flush: one gathered write per destination, shared blocks without a copy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rti/buffering/buffering.h"
#include "rti/central_component.h"
#include "rti/federation/delivery/announcements.h"
#include "rti/federation/delivery/best_effort_receiver.h"
#include "rti/federation/delivery/best_effort_sender.h"
#include "rti/federation/delivery/entry_writer.h"
#include "rti/federation/delivery/flush_context.h"
#include "rti/federation/delivery/periodic_writer.h"
#include "rti/federation/delivery/residual_writer.h"
#include "rti/federation/delivery/turn_writer.h"
#include "rti/federation/delivery/update_rates.h"
#include "rti/federation/expulsion.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/newest_stamps.h"

namespace rink::rti {

class Sender final {
 public:
  struct Uses {
    DataDistribution& distribution;
    Buffering& buffering;
    const NewestStamps& newest;
    Announcements& announcements;
    EntryWriter& entries;
    PeriodicWriter& periodic;
    TurnWriter& turns;
    ResidualWriter& residuals;
    BestEffortSender& datagrams;
    BestEffortReceiver& received;
    UpdateRates& rates;
  };
  Sender(const FederationBasis& basis, const Uses& uses, Expulsion expel)
      : basis_(basis), uses_(uses), expel_(std::move(expel)) {}

  /// Sends to all joined federates, group by group of `UpdateRates`, in the order of slots.
  void flush(Outlet& outlet);

 private:
  void look_ahead(std::uint32_t slot) const;
  void flush_group(std::uint32_t group, std::span<const UpdateRun> runs, std::uint64_t& keyframes,
                   Outlet& outlet);
  void flush_between_turns(std::span<const UpdateRun> runs, Outlet& outlet);
  void write_prompts(FlushContext& context, std::span<const UpdateRates::Prompt> prompts);
  void flush_federate(FlushContext& context, Outlet& outlet);
  void write_content(FlushContext& context, Outlet& outlet);
  void settle_interest(FlushContext& context);
  std::size_t entry_room(const FlushContext& context, const Outlet& outlet) const;
  bool holds_back(const FlushContext& context, const Outlet& outlet);
  void hold_back(FlushContext& context);
  void write_due_states(FlushContext& context);
  void gather_runs(FlushContext& context);
  void gather_whole(std::size_t index, FlushContext& context);
  void gather_run(const UpdateRun& run, FlushContext& context);
  void gather_cut_run(const UpdateRun& run, FlushContext& context);
  void send_frame(FlushContext& context, Outlet& outlet);

  FederationBasis basis_;
  Uses uses_;
  Expulsion expel_;
  GatheredFrame frame_;                      ///< lent to the flush at hand
  std::vector<ObjectSlot> full_state_sent_;  ///< lent to the flush at hand
  std::vector<std::byte> values_;            ///< of one record
  std::uint64_t keyframes_ = 0;  ///< flushes with periodic state to those updated at every match
};

}  // namespace rink::rti
