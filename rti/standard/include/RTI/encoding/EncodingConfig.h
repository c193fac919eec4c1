// The integers and octets that encoding helpers take.
#pragma once

#include <utility>
#include <vector>

namespace rti1516e {

using Integer8 = char;
using Integer16 = short;
using Integer32 = int;
#if defined(RTI_USE_64BIT_LONGS)
using Integer64 = long;
#else
using Integer64 = long long;
#endif
using Octet = Integer8;
using OctetPair = std::pair<Octet, Octet>;

}  // namespace rti1516e
