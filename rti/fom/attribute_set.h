// A set of attributes of one object class.
#pragma once

#include "rti/fom/handle_set.h"
#include "rti/handles.h"

namespace rink::rti {

using AttributeSet = HandleSet<AttributeHandle, std::uint32_t>;
inline constexpr std::uint32_t attribute_max = AttributeSet::capacity;
/// Every object has this attribute, HLAprivilegeToDeleteObject, whether its class names it or not:
/// who owns it may delete the object. It has no value, whoever publishes any attribute of a class
/// publishes it, and only ownership management takes and tells it.
inline constexpr AttributeHandle privilege_to_delete_object{attribute_max - 1};
/// Most attributes that a class may name, inherited ones included.
inline constexpr std::uint32_t named_attribute_max = attribute_max - 1;

}  // namespace rink::rti
