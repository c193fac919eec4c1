// Choices of the standard's API that the core has by other names.
#pragma once

#include "rti/standard/standard_headers.h"
#include "rti/types.h"

namespace rink::standard {

/// Throws InvalidUpdateRateDesignator: there are no update rates but the default.
inline void check_update_rate(const std::wstring& designator) {
  if (!designator.empty())
    throw rti1516e::InvalidUpdateRateDesignator(L"there is no update rate '" + designator + L"'");
}

/// Throws InvalidTransportationType.
inline rti::Transportation to_core(rti1516e::TransportationType type) {
  if (type == rti1516e::RELIABLE) return rti::Transportation::reliable;
  if (type == rti1516e::BEST_EFFORT) return rti::Transportation::best_effort;
  throw rti1516e::InvalidTransportationType(L"it is neither RELIABLE nor BEST_EFFORT");
}

/// Throws `Error` for what is neither.
template <class Error>
rti::Order to_core(rti1516e::OrderType type) {
  if (type == rti1516e::RECEIVE) return rti::Order::receive;
  if (type == rti1516e::TIMESTAMP) return rti::Order::timestamp;
  throw Error(L"it is neither RECEIVE nor TIMESTAMP");
}

}  // namespace rink::standard
