// Builds the filters that expressions describe.
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "im/basics/fnv_hash.h"
#include "im/basics/hexadecimal.h"
#include "im/composition/combination.h"
#include "im/composition/expression.h"
#include "im/composition/expression_queries.h"
#include "im/composition/pair_states.h"
#include "im/composition/schemes.h"
#include "im/pairs/pair_filter.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

using Kind = Expression::Kind;

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

std::unique_ptr<PairFunction> build_function(const Expression& owner,
                                             const FilterSettings& settings) {
  if (owner.is_plugin) return make_plugin_function(*plugin_of(owner, settings));
  ConditionFault fault;
  auto function = compile_condition(owner.function, wanted_of(owner), fault);
  assert(function != nullptr);  // judged texts compile
  return function;
}

/// Of what a stage may hold back.
constexpr double unbounded = std::numeric_limits<double>::max();

std::vector<ConsistencyZone> zones_of(const Expression& stage) {
  const std::vector<double> at = stage.parameters_called("at"),
                            matches = stage.parameters_called("matches"),
                            updates = stage.parameters_called("updates"),
                            distance = stage.parameters_called("distance");
  const auto bound = [](const std::vector<double>& of, std::size_t zone) {
    return of.empty() ? unbounded : of[zone];
  };
  std::vector<ConsistencyZone> zones;
  zones.reserve(at.size());
  for (std::size_t zone = 0; zone < at.size(); ++zone)
    zones.push_back({at[zone], bound(matches, zone), bound(updates, zone), bound(distance, zone)});
  return zones;
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
  if (stage.name == "psense") return make_psense(build_inner(), stage.parameter("vision", 1.0));
  if (stage.name == "donnybrook") {
    auto first = build_inner(), second = build_inner();
    return make_donnybrook(std::move(first), std::move(second), make_scheme("owner", settings),
                           static_cast<std::uint32_t>(stage.parameter("k", 5.0)),
                           static_cast<unsigned>(stage.parameter("guidance", 5.0)));
  }
  if (stage.name == "vfc") return make_vfc(build_inner(), zones_of(stage));
  if (stage.name == "dyconits")
    return make_dyconits(build_inner(), settings.world,
                         {stage.parameter("cell_size", 1.0), stage.parameter("matches", unbounded),
                          stage.parameter("error", unbounded)});
  if (stage.name == "von") return make_von(build_inner(), stage.parameter("area", 1.0));
  if (is_rank(stage))
    return make_rank(build_inner(),
                     stage.name == "top" ? build_function(stage, settings) : make_nearness(),
                     static_cast<std::uint32_t>(stage.parameter("k", 1.0)),
                     stage.name == "top" ? "top" : "nearest");
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

}  // namespace

std::unique_ptr<Filter> build_filter(const Expression& expression, const FilterSettings& settings) {
  assert(judge_expression(expression).empty());
  if (expression.kind == Kind::stage) return build_stage(expression, settings);
  if (expression.kind != Kind::scheme) return build_combination(expression, settings);
  if (is_condition(expression.name))
    return make_pair_filter(settings, build_function(expression, settings),
                            expression.name == "when" ? PairScope::overlapping : PairScope::all);
  FilterSettings own = settings;
  own.cell_size = expression.parameter("cell_size", settings.cell_size);
  own.half_angle_deg = expression.parameter("half_angle", settings.half_angle_deg);
  own.nimbus_radius = expression.parameter("radius", settings.nimbus_radius);
  own.awareness = expression.parameter("awareness", settings.awareness);
  own.zone_capacity =
      static_cast<std::uint32_t>(expression.parameter("capacity", settings.zone_capacity));
  own.tile_steps = static_cast<std::uint32_t>(expression.parameter("steps", settings.tile_steps));
  auto scheme = make_scheme(expression.name, own);
  assert(scheme != nullptr);  // judged names are registered
  return scheme;
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

bool names_scheme(const std::string& text, const std::string& name) {
  return has_scheme(text, [&name](const Expression& scheme) { return scheme.name == name; });
}

std::string file_name_of(const std::string& expression) {
  std::string name;
  constexpr std::string_view of_shells = "\"'<>*/|&!,%";
  for (const char c : expression)
    if (of_shells.find(c) != std::string_view::npos)
      name += '%' + hexadecimal(static_cast<std::uint64_t>(c)).substr(14);
    else name += c == ' ' ? '_' : c == '(' ? '[' : c == ')' ? ']' : c;
  constexpr std::size_t size_max = 100;  // a file's name has 255, and more belongs to it
  if (name.size() <= size_max) return name;
  return name.substr(0, size_max - 17) + "-" + hexadecimal(hash_of(name));
}

}  // namespace rink::im
