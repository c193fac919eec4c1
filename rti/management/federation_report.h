// A report of a federation execution and its federates, in the terms of the management object model
// of IEEE 1516.1-2010, clause 11.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "rti/handles.h"

namespace rink::rti {

/// The RTI's counts of one federate since it joined; "sent" and "received" are seen from the
/// federate.
struct FederateCounts {
  std::uint64_t updates_sent = 0, reflections_received = 0;  ///< objects, not attributes
  std::uint64_t interactions_sent = 0, interactions_received = 0;
  std::uint64_t bytes_sent = 0, bytes_received = 0;  ///< payload, frame headers included
  std::uint64_t queue_bytes = 0;  ///< sent to it, not yet taken by the operating system
  std::uint32_t objects_owned = 0, objects_in_scope = 0, regions = 0;
  std::uint8_t is_time_regulating = 0, is_time_constrained = 0;
  double logical_time = 0.0;    ///< [s]; 0 while it neither regulates nor is constrained
  double earliest_stamp = 0.0;  ///< the least that it may still use [s]; 0 unless it regulates
  double silence_s = 0.0;       ///< since the federate last sent anything
  friend bool operator==(const FederateCounts&, const FederateCounts&) = default;
};

struct FederateReport {
  FederateHandle federate;
  std::string name, type;
  FederateCounts counts;
  friend bool operator==(const FederateReport&, const FederateReport&) = default;
};

struct FederationReport {
  static constexpr std::size_t drop_count_max = 32;
  std::string federation, model, filter;
  std::uint32_t objects = 0;
  std::array<std::uint64_t, drop_count_max> drops{};  ///< connections dropped, by `Violation`
  std::vector<FederateReport> federates;              ///< joined now
  friend bool operator==(const FederationReport&, const FederationReport&) = default;
};

}  // namespace rink::rti
