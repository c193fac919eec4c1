// What several sources ask of a parsed expression.
#pragma once

#include <string>

#include "im/composition/expression.h"
#include "im/pairs/condition.h"
#include "im/pairs/rink_plugin.h"

namespace rink::im {

/// True of the stages that choose among a subscriber's entities, by what holds at that instant.
inline bool is_rank(const Expression& expression) {
  return expression.kind == Expression::Kind::stage &&
         (expression.name == "nearest" || expression.name == "psense" || expression.name == "top" ||
          expression.name == "von");
}

/// True of the stages that compare all relevant entities of a subscriber by where they are.
inline bool chooses(const Expression& expression) {
  return is_rank(expression) ||
         (expression.kind == Expression::Kind::stage && expression.name == "donnybrook");
}

/// True of the stages that hold updates of relevant pairs back.
inline bool holds_updates(const Expression& expression) {
  return expression.kind == Expression::Kind::stage &&
         (expression.name == "dyconits" || expression.name == "vfc");
}

/// The outermost part, and of those the first in the text, for which `is_one` holds, or nothing.
template <class IsOne>
const Expression* first_part(const Expression& expression, const IsOne& is_one) {
  if (is_one(expression)) return &expression;
  for (const Expression& operand : expression.operands)
    if (const Expression* const found = first_part(operand, is_one)) return found;
  return nullptr;
}

/// The first stage `swept` in `expression`, or nothing.
inline const Expression* swept_in(const Expression& expression) {
  return first_part(expression, [](const Expression& part) {
    return part.kind == Expression::Kind::stage && part.name == "swept";
  });
}

/// A part that a combination takes as one operand.
inline bool is_operand(const Expression& expression) {
  return expression.kind == Expression::Kind::scheme || expression.kind == Expression::Kind::stage;
}

/// What the text after `when`, `anywhere` or `by` must be.
inline Wanted wanted_of(const Expression& owner) {
  return owner.kind == Expression::Kind::stage ? Wanted::score : Wanted::condition;
}

/// The plugin that it names, or nothing.
inline const rink_plugin* plugin_of(const Expression& owner, const FilterSettings& settings) {
  for (const rink_plugin* plugin : settings.plugins)
    if (owner.function == plugin->name) return plugin;
  return nullptr;
}

/// True if `is_one` holds for a scheme in the expression `text`.
template <class IsOne>
bool has_scheme(const std::string& text, const IsOne& is_one) {
  Expression expression;
  return read_expression(text, expression).empty() &&
         first_part(expression, [&is_one](const Expression& part) {
           return part.kind == Expression::Kind::scheme && is_one(part);
         });
}

}  // namespace rink::im
