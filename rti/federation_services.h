// The parts of a federation execution that a user may replace.
#pragma once

#include <functional>
#include <memory>

#include "im/filter.h"
#include "rti/buffering/buffering.h"
#include "rti/distribution/data_distribution.h"
#include "rti/groups/group_communication.h"
#include "rti/ownership/ownership.h"
#include "rti/save/save_store.h"
#include "rti/time/time_management.h"

namespace rink::rti {

/// Functions that make each part; an empty one stands for the RTI's own part. Each is called once,
/// by the execution's constructor unless stated otherwise, and again for a federation that is
/// restored; its arguments outlive what it makes.
struct FederationServices {
  /// Decides who receives what. `filter` is the one that the settings name.
  std::function<std::unique_ptr<DataDistribution>(const Fom& fom, const ObjectTable& objects,
                                                  const Ownership& ownership,
                                                  std::unique_ptr<im::Filter> filter)>
      data_distribution;

  /// Decides which subscribers of its class an interaction reaches (rti/groups/member_lists.h).
  std::function<std::unique_ptr<GroupCommunication>()> group_communication;

  /// Collects updates and decides who receives the newest state instead
  /// (rti/buffering/newest_state.h).
  std::function<std::unique_ptr<Buffering>()> buffering;

  /// Decides when each federate may advance. Made when the first federate asks for it, so a
  /// federation without time management has none.
  std::function<std::unique_ptr<TimeManagement>()> time_management;

  /// Where federations are saved (rti/save/save_directory.h); null: they cannot be.
  std::shared_ptr<SaveStore> save_store;
};

}  // namespace rink::rti
