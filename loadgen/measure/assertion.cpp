// Binds an assertion's figures to cells, one binding for each choice that it leaves open, and
// evaluates it.
#include "loadgen/measure/assertion.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "loadgen/experiment/parameter.h"

#include "game/model/listed.h"
#include "loadgen/experiment/cell_key.h"
#include "loadgen/experiment/csv_number.h"
#include "loadgen/measure/assertion_syntax.h"

namespace rink::loadgen {
namespace {

using Node = AssertionNode;
using Kind = Node::Kind;

/// The value of a statistic that a name's ending selects.
using Part = std::optional<double> (*)(const Statistic&);
constexpr std::array<std::pair<const char*, Part>, 6> parts{
    {{"", [](const Statistic& s) { return s.mean; }},
     {"_sd", [](const Statistic& s) { return s.deviation; }},
     {"_min", [](const Statistic& s) { return s.min; }},
     {"_max", [](const Statistic& s) { return s.max; }},
     {"_low",
      [](const Statistic& s) {
        return s.interval ? std::optional(s.interval->low) : std::nullopt;
      }},
     {"_high", [](const Statistic& s) {
        return s.interval ? std::optional(s.interval->high) : std::nullopt;
      }}}};

struct Reading {
  const char* figure;
  Part part;
};

std::optional<Reading> reading_called(const std::string& name) {
  for (const auto& [ending, part] : parts) {
    for (const Figure& figure : figures()) {
      if (name == std::string(figure.name) + ending) return Reading{figure.name, part};
    }
  }
  return std::nullopt;
}

void gather_figures(const Node& node, std::vector<const Node*>& into) {
  if (node.kind == Kind::figure) into.push_back(&node);
  if (node.left) gather_figures(*node.left, into);
  if (node.right) gather_figures(*node.right, into);
}

/// `context` with what `figure` selects.
Cell selected(const Node& figure, Cell context) {
  for (const auto& [key, value] : figure.selection) key_called(key)->set(context, value);
  return without_idle_parameters(std::move(context));
}

bool is_in(const std::vector<Cell>& cells, const Cell& cell) {
  return std::find(cells.begin(), cells.end(), cell) != cells.end();
}

/// For each figure its cell; one entry for each choice of what is left open.
std::vector<std::vector<Cell>> choices_of(const std::vector<const Node*>& figures,
                                          const std::vector<Cell>& cells) {
  std::vector<std::vector<Cell>> choices;
  for (const Cell& context : cells) {
    std::vector<Cell> choice;
    for (const Node* figure : figures) {
      const Cell cell = selected(*figure, context);
      if (is_in(cells, cell)) choice.push_back(cell);
    }
    if (choice.size() == figures.size() &&
        std::find(choices.begin(), choices.end(), choice) == choices.end())
      choices.push_back(choice);
    if (figures.empty()) break;
  }
  return choices;
}

/// The rows' cells; a cell that only names its replications has seed 0.
std::vector<Cell> distinct_cells(const Experiment& experiment) {
  std::vector<Cell> cells;
  for (Cell cell : cells_of(experiment)) {
    cell.seed = 0;
    if (!is_in(cells, cell)) cells.push_back(cell);
  }
  return cells;
}

void check(const std::string& text, const Node& figure, const std::vector<Cell>& cells) {
  const std::string where = "--assert '" + text + "': ";
  if (!reading_called(figure.name))
    throw ExperimentError(where + "no figure is called " + figure.name + "; there are " +
                          game::listed(figures(), [](const Figure& known) { return known.name; }) +
                          ", each also with _low, _high, _sd, _min, _max");
  for (const auto& [key, value] : figure.selection) {
    const CellKey* known = key_called(key);
    if (!known)
      throw ExperimentError(where + "no key of a cell is called " + key + "; there are " +
                            game::listed(cell_keys(), [](const CellKey& k) { return k.name; }));
    Cell probe;
    if (!known->set(probe, value))
      throw ExperimentError(where + key + " = " + value + " is not a value that " + key +
                            " can have");
  }
  const bool exists = std::any_of(cells.begin(), cells.end(), [&](const Cell& context) {
    return is_in(cells, selected(figure, context));
  });
  if (exists) return;
  const auto seedless = [](const Cell& cell) {
    const std::string name = name_of(cell);
    return name.substr(0, name.rfind("-seed"));
  };
  throw ExperimentError(where + "the experiment has no cell for " + figure.text + "; it has " +
                        game::listed(cells, seedless));
}

using Values = std::map<const Node*, std::optional<double>>;

std::optional<double> number_of(const Node& node, const Values& values) {
  if (node.kind == Kind::number) return node.number;
  if (node.kind == Kind::figure) return values.at(&node);
  assert(node.left && !node.is_true_or_false());
  const auto left = number_of(*node.left, values);
  if (node.kind == Kind::negative) return left ? std::optional(-*left) : std::nullopt;
  assert(node.right && node.kind >= Kind::sum && node.kind <= Kind::quotient);
  const auto right = number_of(*node.right, values);
  if (!left || !right) return std::nullopt;
  double result = 0.0;
  switch (node.kind) {
    case Kind::sum:
      result = *left + *right;
      break;
    case Kind::difference:
      result = *left - *right;
      break;
    case Kind::product:
      result = *left * *right;
      break;
    default:
      result = *left / *right;
      break;
  }
  return std::isfinite(result) ? std::optional(result) : std::nullopt;
}

enum class Truth { no, undefined, yes };

Truth opposite(Truth truth) {
  return truth == Truth::undefined ? truth : truth == Truth::yes ? Truth::no : Truth::yes;
}

Truth truth_of(Kind comparison, double left, double right) {
  const auto truth = [](bool is_so) { return is_so ? Truth::yes : Truth::no; };
  switch (comparison) {
    case Kind::less:
      return truth(left < right);
    case Kind::less_or_equal:
      return truth(left <= right);
    case Kind::greater:
      return truth(left > right);
    case Kind::greater_or_equal:
      return truth(left >= right);
    case Kind::equal:
      return truth(left == right);
    default:
      return truth(left != right);
  }
}

/// An undefined part counts only if the rest does not decide (Kleene's strong logic: `and` is the
/// lesser of two, `or` the greater).
Truth truth_of(const Node& node, const Values& values) {
  assert(node.is_true_or_false());
  if (node.kind == Kind::negation) return opposite(truth_of(*node.left, values));
  if (node.kind == Kind::both)
    return std::min(truth_of(*node.left, values), truth_of(*node.right, values));
  if (node.kind == Kind::either)
    return std::max(truth_of(*node.left, values), truth_of(*node.right, values));
  const auto left = number_of(*node.left, values), right = number_of(*node.right, values);
  return left && right ? truth_of(node.kind, *left, *right) : Truth::undefined;
}

std::string value_text(const std::optional<double>& value) {
  if (!value) return "undefined (not measured, or too few samples)";
  return six_digits(value);
}

/// "name = value" of each figure, or the numbers on both sides of a comparison without one.
std::string values_text(const std::vector<const Node*>& figures, const std::vector<Cell>& choice,
                        const Values& values) {
  assert(figures.size() == choice.size());
  std::string text;
  std::set<std::string> said;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const std::string name = name_of(choice[i]), one = figures[i]->name + " of " +
                                                       name.substr(0, name.rfind("-seed")) + " = " +
                                                       value_text(values.at(figures[i]));
    if (said.insert(one).second) game::add_to_list(text, one);
  }
  return text;
}

}  // namespace

Assertion::Assertion(const std::string& text, const Experiment& experiment)
    : text_(text), root_(parse_assertion(text)) {
  std::vector<const Node*> named;
  gather_figures(*root_, named);
  const std::vector<Cell> cells = distinct_cells(experiment);
  for (const Node* figure : named) check(text_, *figure, cells);
  if (choices_of(named, cells).empty())
    throw ExperimentError(
        "--assert '" + text_ +
        "': the experiment has no cells that differ in nothing but what is selected");
}

Assertion::Assertion(Assertion&&) noexcept = default;
Assertion::~Assertion() = default;

Assertion::Finding Assertion::judge(std::span<const SummaryRow> rows) const {
  std::vector<const Node*> named;
  gather_figures(*root_, named);
  const std::vector<Cell> cells(rows.begin(), rows.end());
  const auto choices = choices_of(named, cells);
  Finding finding{!choices.empty(),
                  choices.empty() ? "  fails: no such cells were measured\n" : ""};
  for (const auto& choice : choices) {
    Values values;
    for (std::size_t i = 0; i < named.size(); ++i) {
      assert(reading_called(named[i]->name) && choice.size() == named.size());
      const Reading reading = *reading_called(named[i]->name);
      values[named[i]] =
          reading.part(std::find(rows.begin(), rows.end(), choice[i])->of(reading.figure));
    }
    const Truth truth = truth_of(*root_, values);
    finding.holds = finding.holds && truth == Truth::yes;
    finding.words += std::string(truth == Truth::yes  ? "  holds: "
                                 : truth == Truth::no ? "  fails: "
                                                      : "  fails, undefined: ") +
                     values_text(named, choice, values) + "\n";
  }
  return finding;
}

}  // namespace rink::loadgen
