// The data types that IEEE 1516.2-2010 and the standard's management and initialization module
// (MIM) define, which a model may use without declaring them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace rink::rti {

struct StandardType {
  std::string_view name;
  std::optional<std::uint32_t> size;  ///< [bytes]; nothing: it varies
};
/// Nothing if the standard defines no such type.
std::optional<StandardType> standard_type(std::string_view name);

}  // namespace rink::rti
