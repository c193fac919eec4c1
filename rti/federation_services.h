// The parts of a federation execution that a user may replace by parts of their own.
#pragma once

#include <functional>
#include <memory>

#include "im/filter.h"
#include "rti/buffering/buffering.h"
#include "rti/distribution/data_distribution.h"
#include "rti/groups/group_communication.h"
#include "rti/ownership/ownership.h"
#include "rti/time/time_management.h"

namespace rink::rti {

/// How each part is made; empty: the one that comes with the RTI. A maker is called once, by the
/// execution's constructor if nothing else is said, and what it is handed outlives what it makes.
struct FederationServices {
  /// Who receives what. `filter` is the one that the settings name.
  std::function<std::unique_ptr<DataDistribution>(const Fom& fom, const ObjectTable& objects,
                                                  const Ownership& ownership,
                                                  std::unique_ptr<im::Filter> filter)>
      data_distribution;

  /// Whom an interaction reaches of those who subscribe to its class (rti/groups/member_lists.h).
  std::function<std::unique_ptr<GroupCommunication>()> group_communication;

  /// How updates are collected, and who is told the newest state instead
  /// (rti/buffering/newest_state.h).
  std::function<std::unique_ptr<Buffering>()> buffering;

  /// When who may advance. Made when the first federate asks for it, so a federation without has
  /// none.
  std::function<std::unique_ptr<TimeManagement>()> time_management;
};

}  // namespace rink::rti
