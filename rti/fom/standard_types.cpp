// One table.
#include "rti/fom/standard_types.h"

#include <algorithm>
#include <array>

namespace rink::rti {

namespace {

constexpr std::array standard_types = {
    // Basic data representations (4.13) and the simple types over them.
    StandardType{"HLAoctet", 1},
    StandardType{"HLAbyte", 1},
    StandardType{"HLAASCIIchar", 1},
    StandardType{"HLAoctetPairBE", 2},
    StandardType{"HLAoctetPairLE", 2},
    StandardType{"HLAunicodeChar", 2},
    StandardType{"HLAinteger16BE", 2},
    StandardType{"HLAinteger16LE", 2},
    StandardType{"HLAinteger32BE", 4},
    StandardType{"HLAinteger32LE", 4},
    StandardType{"HLAinteger64BE", 8},
    StandardType{"HLAinteger64LE", 8},
    StandardType{"HLAfloat32BE", 4},
    StandardType{"HLAfloat32LE", 4},
    StandardType{"HLAfloat64BE", 8},
    StandardType{"HLAfloat64LE", 8},
    // The MIM's simple types: counts, times and normalized values.
    StandardType{"HLAcount", 4},
    StandardType{"HLAseconds", 4},
    StandardType{"HLAmsec", 4},
    StandardType{"HLAindex", 4},
    StandardType{"HLAnormalizedFederateHandle", 4},
    StandardType{"HLAinteger64Time", 8},
    StandardType{"HLAfloat64Time", 8},
    // Its enumerations, each an HLAinteger32BE.
    StandardType{"HLAboolean", 4},
    StandardType{"HLAfederateState", 4},
    StandardType{"HLAtimeState", 4},
    StandardType{"HLAownership", 4},
    StandardType{"HLAresignAction", 4},
    StandardType{"HLAorderType", 4},
    StandardType{"HLAswitch", 4},
    StandardType{"HLAsynchPointStatus", 4},
    StandardType{"HLAnormalizedServiceGroup", 4},
    StandardType{"HLAtoken", 0},  // a fixed array of no octets: its presence says all
    // Its arrays, and the records that hold some.
    StandardType{"HLAASCIIstring", {}},
    StandardType{"HLAunicodeString", {}},
    StandardType{"HLAopaqueData", {}},
    StandardType{"HLAhandle", {}},
    StandardType{"HLAtransportationName", {}},
    StandardType{"HLAupdateRateName", {}},
    StandardType{"HLAlogicalTime", {}},
    StandardType{"HLAtimeInterval", {}},
    StandardType{"HLAhandleList", {}},
    StandardType{"HLAinteractionSubList", {}},
    StandardType{"HLAargumentList", {}},
    StandardType{"HLAobjectClassBasedCounts", {}},
    StandardType{"HLAinteractionCounts", {}},
    StandardType{"HLAsynchPointList", {}},
    StandardType{"HLAsynchPointFederateList", {}},
    StandardType{"HLAmoduleDesignatorList", {}},
    StandardType{"HLAinteractionSubscription", {}},
    StandardType{"HLAobjectClassBasedCount", {}},
    StandardType{"HLAinteractionCount", {}},
    StandardType{"HLAsynchPointFederate", {}},
};

}  // namespace

std::optional<StandardType> standard_type(std::string_view name) {
  const auto found = std::ranges::find(standard_types, name, &StandardType::name);
  return found == standard_types.end() ? std::nullopt : std::optional(*found);
}

}  // namespace rink::rti
