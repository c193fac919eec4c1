// The tree that an assertion's text becomes.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rink::loadgen {

/// A number, a figure, or an operator on one or two others; comparisons and `and`, `or`, `not` are
/// true or false, all else are numbers.
struct AssertionNode {
  enum class Kind {
    number,
    figure,
    negative,
    sum,
    difference,
    product,
    quotient,
    less,
    less_or_equal,
    greater,
    greater_or_equal,
    equal,
    unequal,
    both,
    either,
    negation
  };
  Kind kind = Kind::number;
  double number = 0.0;
  std::string text;  ///< of a figure with its selection, as written
  std::string name;  ///< of a figure
  std::vector<std::pair<std::string, std::string>> selection;  ///< of a figure: key and value
  std::unique_ptr<const AssertionNode> left, right;  ///< right is absent for negative and negation
  bool is_true_or_false() const { return kind >= Kind::less; }
};

/// Throws ExperimentError. Names are not looked up.
std::unique_ptr<const AssertionNode> parse_assertion(const std::string& text);

}  // namespace rink::loadgen
