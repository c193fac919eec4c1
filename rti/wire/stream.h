// The streams by which the RTI writes, reads and measures its messages.
#pragma once

#include <cstddef>
#include <vector>

#include "im/basics/byte_stream.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

using Writer = ByteWriter<std::vector<std::byte>>;
using Reader = ByteReader;
using Measurer = ByteMeasurer;

}  // namespace rink::rti
