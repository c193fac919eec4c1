// Checks expressions and builds the filters that they describe.
#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "im/basics/fnv_hash.h"
#include "im/basics/hexadecimal.h"
#include "im/composition/combination.h"
#include "im/composition/expression.h"
#include "im/composition/pair_states.h"
#include "im/composition/schemes.h"
#include "im/expression_fault.h"
#include "im/matching/rejection.h"
#include "im/stages/stages.h"
#include "im/usage.h"

namespace rink::im {
namespace {

using Kind = Expression::Kind;

/// A parameter, the scheme or stage that takes it, and its range.
struct Key {
  const char *owner, *key;
  double low, high;
  bool is_whole, is_needed, is_list;
};
constexpr double metres_max = 1e9;
constexpr std::array keys{Key{"cone", "half_angle", 0.0, 180.0, false, false, false},
                          Key{"dwell", "matches", 1.0, 100'000.0, true, true, false},
                          Key{"grid", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"hex", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"hierarchical", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"hybrid", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"hysteresis", "margin", 0.0, metres_max, false, true, false},
                          Key{"priority", "budget", 1.0, metres_max, true, false, false},
                          Key{"strips", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"swept", "disc", 0.0, 1.0, true, false, false},
                          Key{"swept", "drag", 0.0, 1e6, false, false, false},
                          Key{"swept", "horizon", 0.0, 1e6, false, true, false},
                          Key{"tiers", "at", 1e-6, 1.0, false, true, true}};
constexpr std::array stages{"dwell", "hysteresis", "priority", "swept", "tiers"};

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// The number with six decimals at most if these are exact.
std::string shown(double number) {
  std::string text = std::to_string(number);
  if (std::stod(text) != number) {
    std::array<char, 32> all;
    char* const end = all.data() + all.size();
    return {all.data(), std::to_chars(all.data(), end, number, std::chars_format::general, 9).ptr};
  }
  text.erase(text.find_last_not_of('0') + 1);
  return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
}

std::string judge_parameter(const Expression& owner, std::size_t i) {
  const Expression::Parameter& own = owner.parameters[i];
  std::vector<std::string> known;
  for (const Key& key : keys) {
    if (owner.name != key.owner) continue;
    known.emplace_back(key.key);
    if (own.key != key.key) continue;
    if (!(own.value >= key.low && own.value <= key.high) ||
        (key.is_whole && own.value != std::floor(own.value)))
      return owner.name + ": " + own.key + " = " + shown(own.value) + " is not " +
             (key.is_whole ? "a whole number" : "a number") + " from " + shown(key.low) + " to " +
             shown(key.high);
    for (std::size_t k = 0; k < i; ++k)
      if (owner.parameters[k].key == own.key &&
          !(key.is_list && owner.parameters[k].value < own.value))
        return owner.name + ": " + own.key + (key.is_list ? " must ascend" : " is given twice");
    return {};
  }
  return owner.name + " has no parameter " + own.key +
         (known.empty() ? ", nor any other" : "; it has " + listed(known));
}

std::string judge_parameters(const Expression& owner) {
  for (std::size_t i = 0; i < owner.parameters.size(); ++i)
    if (std::string complaint = judge_parameter(owner, i); !complaint.empty()) return complaint;
  for (const Key& key : keys)
    if (owner.name == key.owner && key.is_needed &&
        std::isnan(owner.parameter(key.key, std::numeric_limits<double>::quiet_NaN())))
      return owner.name + " needs " + key.key + "=NUMBER";
  if (owner.name == "tiers" && owner.parameters.size() >= PairStates::filter_max)
    return "tiers: more than 15 of them";
  return {};
}

/// A part that a combination takes as one operand.
bool is_operand(const Expression& expression) {
  return expression.kind == Kind::scheme || expression.kind == Kind::stage;
}

std::size_t operand_count(const Expression& expression) {
  if (is_operand(expression)) return 1;
  std::size_t count = 0;
  for (const Expression& operand : expression.operands) count += operand_count(operand);
  return count;
}

/// True if its decision about a pair depends on their places.
bool looks_at_places(const Expression& expression) {
  if (expression.kind == Kind::scheme)
    return expression.name != "always" && expression.name != "none" && expression.name != "owner" &&
           expression.name != "team";
  return std::any_of(expression.operands.begin(), expression.operands.end(), looks_at_places);
}

/// For a swept pair an operand is true if it is true anywhere on the way. Under a `not`,
/// `is_negated`, it would have to be true everywhere on the way, which is not known, so it is taken
/// as false.
void flatten(const Expression& expression, const FilterSettings& settings, bool is_negated,
             std::vector<std::unique_ptr<Filter>>& operands, std::vector<Step>& steps) {
  assert(expression.operands.size() == (expression.kind == Kind::negation ? 1u
                                        : expression.kind == Kind::scheme ? 0u
                                        : expression.kind == Kind::stage  ? 1u
                                                                          : 2u));
  if (is_operand(expression)) {
    steps.push_back(static_cast<Step>(operands.size()));
    if (is_negated && looks_at_places(expression))
      steps.insert(steps.end(), {Step::is_still, Step::conjunction});
    operands.push_back(build_filter(expression, settings));
    return;
  }
  for (const Expression& operand : expression.operands)
    flatten(operand, settings, is_negated != (expression.kind == Kind::negation), operands, steps);
  steps.push_back(expression.kind == Kind::negation      ? Step::negation
                  : expression.kind == Kind::conjunction ? Step::conjunction
                                                         : Step::alternative);
}

std::unique_ptr<Filter> build_combination(const Expression& expression,
                                          const FilterSettings& settings) {
  std::vector<std::unique_ptr<Filter>> operands;
  std::vector<Step> steps;
  flatten(expression, settings, false, operands, steps);
  assert(operands.size() < PairStates::filter_max);  // `none` may join them
  if (follow(steps, 0, true)) {
    // The expression is true where no operand is, so it needs `none`, which lets every pair
    // through.
    steps.push_back(static_cast<Step>(operands.size()));
    steps.push_back(Step::conjunction);
    operands.push_back(make_scheme("none", settings));
  }
  return make_combination(std::move(operands), std::move(steps));
}

/// The first stage `swept` in `expression`, or nothing.
const Expression* swept_in(const Expression& expression) {
  if (expression.kind == Kind::stage && expression.name == "swept") return &expression;
  for (const Expression& operand : expression.operands)
    if (const Expression* const found = swept_in(operand)) return found;
  return nullptr;
}

std::unique_ptr<Filter> build_stage(const Expression& stage, const FilterSettings& settings) {
  assert(stage.kind == Kind::stage && stage.operands.size() == 1);
  const Expression& inner = stage.operands.front();
  const auto build_inner = [&] { return build_filter(inner, settings); };
  if (stage.name == "hysteresis") {
    auto enter = build_inner();
    return make_hysteresis(std::move(enter), build_inner(), stage.parameter("margin", 0.0));
  }
  if (stage.name == "dwell")
    return make_dwell(build_inner(), static_cast<std::uint32_t>(stage.parameter("matches", 1.0)));
  if (stage.name == "swept")
    return make_swept(build_inner(), stage.parameter("horizon", 0.0),
                      stage.parameter("drag", settings.drag), stage.parameter("disc", 0.0) != 0.0);
  if (stage.name == "priority")
    return make_priority(build_inner(), static_cast<std::size_t>(stage.parameter("budget", 0.0)));
  assert(stage.name == "tiers");
  // Rings measure present places of flights if the inner filter uses flights.
  const Expression* const swept = swept_in(inner);
  const auto make_ring = [&] {
    auto ring = make_scheme("aura", settings);
    return swept ? make_swept(std::move(ring), 0.0, swept->parameter("drag", settings.drag), false)
                 : std::move(ring);
  };
  std::vector<std::unique_ptr<Filter>> rings;
  std::vector<double> fractions;
  for (const auto& at : stage.parameters)
    rings.push_back(make_ring()), fractions.push_back(at.value);
  return make_tiers(build_inner(), std::move(rings), std::move(fractions));
}

/// True if `is_one` holds for a scheme in the expression `text`.
template <class IsOne>
bool has_scheme(const std::string& text, const IsOne& is_one) {
  const auto search = [&is_one](const auto& self, const Expression& expression) -> bool {
    if (expression.kind == Kind::scheme && is_one(expression)) return true;
    return std::any_of(expression.operands.begin(), expression.operands.end(),
                       [&](const Expression& operand) { return self(self, operand); });
  };
  Expression expression;
  return read_expression(text, expression).empty() && search(search, expression);
}

std::string judge_settings(const FilterSettings& settings) {
  if (const auto rejection = check_world(settings.world)) return describe(*rejection);
  if (!(settings.cell_size >= 0.0) || !std::isfinite(settings.cell_size))
    return describe({Fault::bad_cell_size, Subject::cells});
  if (!(settings.half_angle_deg >= 0.0 && settings.half_angle_deg <= 180.0))
    return "the half angle of a view is not a number from 0 to 180";
  if (!(settings.drag >= 0.0) || !std::isfinite(settings.drag))
    return "the drag of flights is not a finite number from 0";
  for (std::size_t i = 0; i < settings.posts.size(); ++i) {
    const Disc& post = settings.posts[i];
    if (!std::isfinite(post.x) || !std::isfinite(post.y) || !std::isfinite(post.radius))
      return "post " + std::to_string(i) + " is not finite: a number is infinite or not a number";
    if (post.radius < 0.0) return "post " + std::to_string(i) + " has a negative radius";
  }
  return {};
}

/// The fault of `expression` itself, whose operands are valid.
std::string judge_own(const Expression& expression) {
  const auto names = expression.kind == Kind::stage ? stage_names() : filter_names();
  if (is_operand(expression)) {
    if (std::find(names.begin(), names.end(), expression.name) == names.end())
      return std::string("no ") + (expression.kind == Kind::stage ? "stage" : "scheme") +
             " is called '" + expression.name + "'; there are " + listed(names);
    if (std::string complaint = judge_parameters(expression); !complaint.empty()) return complaint;
  } else if (operand_count(expression) >= PairStates::filter_max) {
    return "more than 15 schemes in one combination";
  }
  for (const Expression& operand : expression.operands) {
    const bool is_last =
        operand.kind == Kind::stage && (operand.name == "tiers" || operand.name == "priority");
    const bool is_tiers_in_priority = expression.name == "priority" && operand.name == "tiers";
    if (is_last && !is_tiers_in_priority)
      return "after " + operand.name + " nothing may follow" +
             (operand.name == "tiers" ? " but priority" : "") +
             ": it decides more than whether a pair is relevant";
  }
  return {};
}

/// The innermost stage that is first in the text, or nothing.
const Expression* stage_in(const Expression& expression) {
  for (const Expression& operand : expression.operands)
    if (const Expression* const found = stage_in(operand)) return found;
  return expression.kind == Kind::stage ? &expression : nullptr;
}

std::string why_not_momentary(const Expression& stage) {
  const bool depends_on_past = stage.name == "hysteresis" || stage.name == "dwell";
  return stage.name +
         (depends_on_past ? " depends on what was relevant before"
          : stage.name == "swept"
              ? " depends on predicted flights"
              : " decides how often an entity is updated, not whether it is relevant") +
         ": only schemes decide relevance at one instant";
}

}  // namespace

std::string judge_expression(const Expression& expression, Expression::Place* place) {
  for (const Expression& operand : expression.operands)
    if (std::string complaint = judge_expression(operand, place); !complaint.empty())
      return complaint;
  if (place) *place = expression.place;
  return judge_own(expression);
}

std::unique_ptr<Filter> build_filter(const Expression& expression, const FilterSettings& settings) {
  assert(judge_own(expression).empty() && judge_settings(settings).empty());
  if (expression.kind == Kind::stage) return build_stage(expression, settings);
  if (expression.kind != Kind::scheme) return build_combination(expression, settings);
  FilterSettings own = settings;
  own.cell_size = expression.parameter("cell_size", settings.cell_size);
  own.half_angle_deg = expression.parameter("half_angle", settings.half_angle_deg);
  auto scheme = make_scheme(expression.name, own);
  assert(scheme != nullptr);  // judged names are registered
  return scheme;
}

std::string usage_of(const std::string& name) {
  std::string parameters;
  for (const Key& key : keys) {
    if (name != key.owner) continue;
    const std::string one = std::string(key.key) + "=" + shown(key.low) + ".." + shown(key.high) +
                            (key.is_list ? " ..." : "");
    parameters += (parameters.empty() ? "" : " ") + (key.is_needed ? one : "[" + one + "]");
  }
  return parameters.empty() ? name : name + "(" + parameters + ")";
}

std::vector<std::string> stage_names() { return {stages.begin(), stages.end()}; }

std::optional<std::string> complaint_about(const std::string& text,
                                           const FilterSettings& settings) {
  Expression expression;
  std::string complaint = read_expression(text, expression);
  if (complaint.empty()) complaint = judge_expression(expression);
  if (complaint.empty()) complaint = judge_settings(settings);
  return complaint.empty() ? std::nullopt : std::optional(complaint);
}

std::optional<ExpressionFault> fault_in(const std::string& text) {
  Expression expression;
  Expression::Place place;
  std::string complaint = read_expression(text, expression, &place);
  if (complaint.empty()) complaint = judge_expression(expression, &place);
  return complaint.empty() ? std::nullopt
                           : std::optional(ExpressionFault{complaint, place.character + 1});
}

std::optional<ExpressionFault> fault_in_momentary(const std::string& text) {
  if (auto fault = fault_in(text)) return fault;
  Expression expression;
  read_expression(text, expression);
  const Expression* const stage = stage_in(expression);
  return stage
             ? std::optional(ExpressionFault{why_not_momentary(*stage), stage->place.character + 1})
             : std::nullopt;
}

std::unique_ptr<Filter> make_filter(const std::string& text, const FilterSettings& settings) {
  if (complaint_about(text, settings)) return nullptr;
  Expression expression;
  read_expression(text, expression);
  return build_filter(expression, settings);
}

bool are_equivalent(const std::string& text, const std::string& other) {
  Expression one, another;
  return read_expression(text, one).empty() && read_expression(other, another).empty() &&
         one == another;
}

bool takes_cell_size(const std::string& text) {
  return has_scheme(text, [](const Expression& scheme) {
    const bool has_cells = std::any_of(keys.begin(), keys.end(), [&](const Key& key) {
      return scheme.name == key.owner && std::string_view(key.key) == "cell_size";
    });
    return has_cells &&
           std::isnan(scheme.parameter("cell_size", std::numeric_limits<double>::quiet_NaN()));
  });
}

bool names_scheme(const std::string& text, const std::string& name) {
  return has_scheme(text, [&name](const Expression& scheme) { return scheme.name == name; });
}

std::string file_name_of(const std::string& expression) {
  std::string name;
  for (const char c : expression) name += c == ' ' ? '_' : c == '(' ? '[' : c == ')' ? ']' : c;
  constexpr std::size_t size_max = 100;  // a file's name has 255, and more belongs to it
  if (name.size() <= size_max) return name;
  return name.substr(0, size_max - 17) + "-" + hexadecimal(hash_of(name));
}

}  // namespace rink::im
