// The syntax of composed schemes: names with parameters, and, or, not, parentheses, and stages
// after `with`.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "im/filter.h"

namespace rink::im {

/// A composed scheme as a tree.
///
///     expression = alternative { "with" stage }
///     alternative = conjunction { "or" conjunction }
///     conjunction = term { "and" term }
///     term = "not" term | "(" expression ")" | condition | scheme
///     condition = ("when" | "anywhere") function
///     scheme = named
///     stage = named [ "by" function ]
///     named = name [ "(" { key "=" number } ")" ]
///     function = quoted text | name of a plugin
struct Expression {
  enum class Kind { scheme, stage, conjunction, alternative, negation };
  struct Parameter {
    std::string key;
    double value;
    friend bool operator==(const Parameter&, const Parameter&) = default;
  };
  /// Where the expression begins in the text, from 0; it has no meaning, so any two places are
  /// equal.
  struct Place {
    std::size_t character = 0;
    friend bool operator==(const Place&, const Place&) { return true; }
  };
  Kind kind = Kind::scheme;
  std::string name;                   ///< of a scheme or stage
  std::vector<Parameter> parameters;  ///< of it, as written
  std::vector<Expression> operands;   ///< one of a stage and of `not`; two of `and` and `or`
  Place place{};
  std::string function{};  ///< after `when`, `anywhere` and `by`; empty if there is none
  bool is_plugin = false;  ///< `function` is a plugin's name, else a text
  Place function_place{};

  friend bool operator==(const Expression&, const Expression&) = default;

  /// That of `key`, or `otherwise`.
  double parameter(std::string_view key, double otherwise) const;
  /// All those of `key`, as written.
  std::vector<double> parameters_called(std::string_view key) const;
};

/// True of `when` and `anywhere`, which a function follows.
bool is_condition(std::string_view name);

/// Reads `text` into `expression`. Returns its fault, naming the faulty part, and sets `place` to
/// where that begins; an empty text if there is none.
std::string read_expression(std::string_view text, Expression& expression,
                            Expression::Place* place = nullptr);

/// The fault of the names and parameters in `expression`, and its `place`; an empty text if there
/// is none.
std::string judge_expression(const Expression& expression, Expression::Place* place = nullptr);

/// Builds the filter of a checked expression.
std::unique_ptr<Filter> build_filter(const Expression& expression, const FilterSettings& settings);

}  // namespace rink::im
