// A set of attributes of one object class.
#pragma once

#include <bit>
#include <cassert>
#include <cstdint>
#include <initializer_list>

#include "rti/handles.h"

namespace rink::rti {

/// A set of attributes is one word.
inline constexpr std::uint32_t attribute_max = 32;
/// Every object has this attribute, HLAprivilegeToDeleteObject, whether its class names it or not: who owns it may delete the object. It has no value, whoever
/// publishes any attribute of a class publishes it, and only ownership management takes and tells it.
inline constexpr AttributeHandle privilege_to_delete_object{attribute_max - 1};
/// Most attributes that a class may name, inherited ones included.
inline constexpr std::uint32_t named_attribute_max = attribute_max - 1;

/// Attributes of one class; bit k stands for the attribute whose handle is k.
struct AttributeSet {
  std::uint32_t bits = 0;

  constexpr AttributeSet() = default;
  explicit constexpr AttributeSet(std::uint32_t bits) : bits(bits) {}
  AttributeSet(std::initializer_list<AttributeHandle> attributes) {
    for (const AttributeHandle attribute : attributes) insert(attribute);
  }
  void insert(AttributeHandle attribute) {
    assert(attribute.value < attribute_max);
    bits |= 1u << attribute.value;
  }
  bool contains(AttributeHandle attribute) const { return attribute.value < attribute_max && (bits >> attribute.value & 1u) != 0; }
  bool includes(AttributeSet other) const { return (other.bits & ~bits) == 0; }
  bool is_empty() const { return bits == 0; }
  int count() const { return std::popcount(bits); }
  AttributeSet without(AttributeSet other) const { return AttributeSet(bits & ~other.bits); }
  friend AttributeSet operator|(AttributeSet a, AttributeSet b) { return AttributeSet(a.bits | b.bits); }
  friend AttributeSet operator&(AttributeSet a, AttributeSet b) { return AttributeSet(a.bits & b.bits); }
  friend bool operator==(AttributeSet, AttributeSet) = default;
};

}  // namespace rink::rti
