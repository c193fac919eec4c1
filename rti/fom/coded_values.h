// Values of sets of attributes as they travel, each coded in its own way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/fom/fom.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

/// True if any attribute of `set` has a codec.
bool is_coded(const ObjectClass& object_class, AttributeSet set);
/// Bytes that the values of `set` take on their way, if that is the same for all values.
std::optional<std::uint32_t> coded_size(const ObjectClass& object_class, AttributeSet set);
/// Bytes that the coded values of `set` take which start `coded`; nothing if they are malformed or
/// not all there.
std::optional<std::size_t> coded_size(const ObjectClass& object_class, AttributeSet set,
                                      Bytes coded);
/// Where the coded value of `attribute` stands in those of `set`, which must be whole.
Bytes coded_value(const ObjectClass& object_class, AttributeSet set, AttributeHandle attribute,
                  Bytes coded);
/// Appends the coded form of `values`, which must fit `set`.
void encode(const ObjectClass& object_class, AttributeSet set, Bytes values, double time,
            std::vector<std::byte>& coded);
/// Appends the values of `set` that `coded` holds; false if they are malformed. `coded` must have
/// their size.
bool decode(const ObjectClass& object_class, AttributeSet set, Bytes coded, double time,
            std::vector<std::byte>& values);

}  // namespace rink::rti
