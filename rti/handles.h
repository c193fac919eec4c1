// Strongly typed handles of everything that the RTI names.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace rink::rti {

/// A small dense number that can't be mistaken for a handle of another kind. Equal handles name the
/// same thing within one federation execution.
template <class Tag>
struct Handle {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t value = none;
  explicit operator bool() const { return value != none; }
  friend auto operator<=>(const Handle&, const Handle&) = default;
};

using FederateHandle = Handle<struct FederateTag>;
using ObjectClassHandle = Handle<struct ObjectClassTag>;
using AttributeHandle =
    Handle<struct AttributeTag>;  ///< index within its class, inherited attributes first
using InteractionClassHandle = Handle<struct InteractionClassTag>;
using ParameterHandle = Handle<struct ParameterTag>;  ///< index within its class
using DimensionHandle = Handle<struct DimensionTag>;
using ObjectHandle = Handle<struct ObjectTag>;
using RegionHandle = Handle<struct RegionTag>;  ///< local to the federate that made it

}  // namespace rink::rti

template <class Tag>
struct std::hash<rink::rti::Handle<Tag>> {
  std::size_t operator()(const rink::rti::Handle<Tag>& handle) const { return handle.value; }
};
