// Values of the management object model: Rink's forms of them (rti/management/management_values.h)
// and the standard's.
#pragma once

#include <string_view>

#include "rti/standard/standard_headers.h"
#include "rti/wire/bytes.h"

namespace rink::standard {

/// HLAunicodeString, which Rink has as UTF-8; HLAhandle, which it has as a number; and lists of
/// these. All else is alike.
rti1516e::VariableLengthData management_to_standard(std::string_view data_type, rti::Bytes value);
/// HLAhandle of an interaction that is for the RTI. Throws RTIinternalError for one that is none.
rti1516e::VariableLengthData management_from_standard(std::string_view data_type,
                                                      rti1516e::VariableLengthData const& value);

}  // namespace rink::standard
