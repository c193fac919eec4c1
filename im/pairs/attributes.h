// The names that conditions and scores may use, and what each stands for.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "im/filter.h"
#include "im/pairs/program.h"

namespace rink::im {

enum class ValueType { number, truth, team, owner, kind };

/// "a number", "true or false", "a team" ...
const char* text_of(ValueType type);

/// A name of the language. `its` is the entity's value, `mine` the subscriber's, which is written
/// `my.` and the name; a name of the pair has no `mine`.
struct NamedAttribute {
  const char* name;
  ValueType type;
  PairUses uses;
  Program::Attribute its, mine;
};
std::span<const NamedAttribute> named_attributes();

/// A number that a word stands for: the kinds.
struct NamedKind {
  const char* name;
  EntityKind kind;
};
std::span<const NamedKind> named_kinds();

}  // namespace rink::im
