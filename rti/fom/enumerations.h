// Enumerated data types: the values of enumerators, and the enumerators that an alternative of a
// variant record names, both alone, in lists and in ranges (IEEE 1516.2-2010, 4.13).
#pragma once

#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "rti/fom/fom_modules.h"

namespace rink::rti {

/// What lies between commas; a range "[first..last]" is one entry, without its brackets. Blanks
/// around names count for nothing. Throws `FileError` at `node` if an entry is empty or a bracket
/// or name is missing.
struct ListEntry {
  std::string first, last;  ///< the same if it is no range
};
std::vector<ListEntry> entries_of(const FomModules& modules, const pugi::xml_node& node,
                                  std::string_view list);

/// Checks an `enumeratedData` whose representation takes `size` bytes: names are unique, and values
/// are whole numbers that fit it, signed or not; a range ascends. A value that two enumerators have
/// is a warning, for published models have such.
void check_enumerators(FomModules& modules, const pugi::xml_node& enumeration,
                       std::optional<std::uint32_t> size);

/// Checks the alternatives of a `variantRecordData` against the enumerators of its discriminant, in
/// their order: each is named at most once, ranges ascend, HLAother comes alone.
void check_alternatives(const FomModules& modules, const pugi::xml_node& variant,
                        const std::vector<std::string>& enumerators);

}  // namespace rink::rti
