// What several sources ask of a parsed expression.
#pragma once

#include <algorithm>
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

/// True of the stages that hold updates of relevant pairs back.
inline bool holds_updates(const Expression& expression) {
  return expression.kind == Expression::Kind::stage &&
         (expression.name == "dyconits" || expression.name == "vfc");
}

/// The first stage `swept` in `expression`, or nothing.
inline const Expression* swept_in(const Expression& expression) {
  if (expression.kind == Expression::Kind::stage && expression.name == "swept") return &expression;
  for (const Expression& operand : expression.operands)
    if (const Expression* const found = swept_in(operand)) return found;
  return nullptr;
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
  const auto search = [&is_one](const auto& self, const Expression& expression) -> bool {
    if (expression.kind == Expression::Kind::scheme && is_one(expression)) return true;
    return std::any_of(expression.operands.begin(), expression.operands.end(),
                       [&](const Expression& operand) { return self(self, operand); });
  };
  Expression expression;
  return read_expression(text, expression).empty() && search(search, expression);
}

}  // namespace rink::im
