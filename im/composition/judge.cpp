// Checks expressions and settings, and lists what expressions may name.
#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>

#include "im/composition/expression.h"
#include "im/composition/expression_queries.h"
#include "im/composition/pair_states.h"
#include "im/expression_fault.h"
#include "im/matching/rejection.h"
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
                          Key{"donnybrook", "guidance", 1.0, 6.0, true, false, false},
                          Key{"donnybrook", "k", 1.0, 1e6, true, false, false},
                          Key{"dwell", "matches", 1.0, 100'000.0, true, true, false},
                          Key{"dyconits", "cell_size", 1e-3, 1e6, false, true, false},
                          Key{"dyconits", "error", 0.0, metres_max, false, false, false},
                          Key{"dyconits", "matches", 0.0, 100'000.0, true, false, false},
                          Key{"grid", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"hex", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"hierarchical", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"hybrid", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"hysteresis", "margin", 0.0, metres_max, false, true, false},
                          Key{"nearest", "k", 1.0, 1e6, true, true, false},
                          Key{"nimbus", "awareness", 0.0, 1.0, false, false, false},
                          Key{"nimbus", "radius", 1e-3, metres_max, false, false, false},
                          Key{"priority", "budget", 1.0, metres_max, true, false, false},
                          Key{"psense", "vision", 1e-6, 1.0, false, false, false},
                          Key{"pvs", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"strips", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"swept", "disc", 0.0, 1.0, true, false, false},
                          Key{"swept", "drag", 0.0, 1e6, false, false, false},
                          Key{"swept", "horizon", 0.0, 1e6, false, true, false},
                          Key{"tiers", "at", 1e-6, 1.0, false, true, true},
                          Key{"tiles", "cell_size", 1e-3, 1e6, false, false, false},
                          Key{"tiles", "steps", 0.0, 64.0, true, false, false},
                          Key{"top", "k", 1.0, 1e6, true, true, false},
                          Key{"vfc", "at", 0.0, 1.0, false, true, true},
                          Key{"vfc", "distance", 0.0, metres_max, false, false, true},
                          Key{"vfc", "matches", 0.0, 100'000.0, true, false, true},
                          Key{"vfc", "updates", 0.0, 100'000.0, true, false, true},
                          Key{"von", "area", 0.0, 1.0, false, false, false},
                          Key{"zones", "capacity", 1.0, 1e6, true, false, false}};
constexpr std::array stages{"donnybrook", "dwell", "dyconits", "hysteresis", "nearest", "priority",
                            "psense",     "swept", "tiers",    "top",        "vfc",     "von"};

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

/// The fault of the bounds of a stage that holds updates back.
std::string judge_bounds(const Expression& owner) {
  if (!holds_updates(owner)) return {};
  const std::size_t zones = owner.parameters_called("at").size();
  bool has_bound = false;
  for (const char* const bound : {"distance", "error", "matches", "updates"}) {
    const std::size_t count = owner.parameters_called(bound).size();
    has_bound |= count > 0;
    if (owner.name == "vfc" && count > 0 && count != zones)
      return "vfc: " + std::to_string(count) + " of " + bound + " for " + std::to_string(zones) +
             " of at: each zone has its own, or none has any";
  }
  if (has_bound) return {};
  return owner.name + " needs a bound: " +
         (owner.name == "vfc" ? "matches, updates or distance" : "matches or error");
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
  return judge_bounds(owner);
}

std::size_t operand_count(const Expression& expression) {
  if (is_operand(expression)) return 1;
  std::size_t count = 0;
  for (const Expression& operand : expression.operands) count += operand_count(operand);
  return count;
}

std::string judge_settings(const FilterSettings& settings) {
  if (const auto rejection = check_world(settings.world)) return describe(*rejection);
  if (!(settings.cell_size >= 0.0) || !std::isfinite(settings.cell_size))
    return describe({Fault::bad_cell_size, Subject::cells});
  if (!(settings.half_angle_deg >= 0.0 && settings.half_angle_deg <= 180.0))
    return "the half angle of a view is not a number from 0 to 180";
  if (!(settings.nimbus_radius >= 0.0) || !std::isfinite(settings.nimbus_radius))
    return "the radius of nimbi is not a finite number from 0";
  if (!(settings.awareness >= 0.0 && settings.awareness <= 1.0))
    return "the awareness at which an entity matters is not a number from 0 to 1";
  if (settings.zone_capacity == 0) return "the capacity of a zone is not a number from 1";
  if (settings.tile_steps > 64) return "the steps between tiles are not a number from 0 to 64";
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

/// The fault of the text after `when`, `anywhere` or `by`.
std::string judge_function(const Expression& owner, Expression::Place* place) {
  if (owner.is_plugin) return {};
  ConditionFault fault;
  if (compile_condition(owner.function, wanted_of(owner), fault)) return {};
  if (place) place->character = owner.function_place.character + fault.character;
  return owner.name + ": character " + std::to_string(fault.character + 1) +
         " of its text: " + fault.what;
}

/// The first part that names a plugin which `settings` lack, or which is of the other kind.
std::string judge_plugins(const Expression& expression, const FilterSettings& settings) {
  for (const Expression& operand : expression.operands)
    if (std::string complaint = judge_plugins(operand, settings); !complaint.empty())
      return complaint;
  if (!expression.is_plugin) return {};
  const rink_plugin* const plugin = plugin_of(expression, settings);
  if (plugin == nullptr) {
    std::string loaded;
    for (const rink_plugin* each : settings.plugins)
      loaded += (loaded.empty() ? "" : ", ") + std::string(each->name);
    return expression.name + ": no plugin '" + expression.function + "' is loaded; " +
           (loaded.empty() ? "none is: name its file with --plugin" : "there are " + loaded);
  }
  const bool is_score = plugin->kind == RINK_SCORE;
  if (is_score == (wanted_of(expression) == Wanted::score)) return {};
  return expression.name + ": the plugin '" + expression.function + "' is a " +
         (is_score ? "score, which belongs after by" : "predicate, which belongs after when");
}

bool is_zones(const Expression& part) { return part.kind == Kind::scheme && part.name == "zones"; }

/// The fault of `expression` itself, whose operands are valid; `place` is set if it is not that of
/// the expression.
std::string judge_own(const Expression& expression, Expression::Place* place = nullptr) {
  if (expression.kind == Kind::scheme && is_condition(expression.name))
    return judge_function(expression, place);
  const auto names = expression.kind == Kind::stage ? stage_names() : filter_names();
  if (is_operand(expression)) {
    if (std::find(names.begin(), names.end(), expression.name) == names.end())
      return std::string("no ") + (expression.kind == Kind::stage ? "stage" : "scheme") +
             " is called '" + expression.name + "'; there are " + listed(names) +
             (expression.kind == Kind::stage ? "" : "; and when and anywhere with a condition");
    if (std::string complaint = judge_parameters(expression); !complaint.empty()) return complaint;
    const bool is_scored = expression.kind == Kind::stage && expression.name == "top";
    if (is_scored && expression.function.empty())
      return "top needs a score, as in top(k=5) by \"-distance\"";
    if (!is_scored && !expression.function.empty())
      return expression.name + " takes no score: only top does";
    if (is_scored)
      if (std::string complaint = judge_function(expression, place); !complaint.empty())
        return complaint;
    if (const Expression* const rank = first_part(expression, is_rank);
        rank && expression.name == "swept")
      return "swept cannot follow " + rank->name +
             ": which are first anywhere on the way is not known";
    if (expression.name == "swept" && first_part(expression, is_zones))
      return "swept cannot follow zones: which zones there will be on the way is not known";
    if (chooses(expression) && swept_in(expression))
      return expression.name +
             " cannot follow swept: of an entity in flight it would take where the flight began";
    if (holds_updates(expression) && swept_in(expression))
      return expression.name +
             " cannot follow swept: how far an entity in flight is from what was "
             "told is not known";
  } else if (operand_count(expression) >= PairStates::filter_max) {
    return "more than 15 schemes in one combination";
  }
  for (const Expression& operand : expression.operands) {
    const bool has_tiers =
        operand.kind == Kind::stage &&
        (operand.name == "tiers" || operand.name == "donnybrook" || holds_updates(operand));
    const bool is_last = has_tiers || (operand.kind == Kind::stage && operand.name == "priority");
    if (is_last && !(has_tiers && expression.name == "priority"))
      return "after " + operand.name + " nothing may follow" + (has_tiers ? " but priority" : "") +
             ": it decides more than whether a pair is relevant";
  }
  return {};
}

/// The innermost stage that is first in the text, or nothing. Those that rank decide at an instant.
const Expression* stage_in(const Expression& expression) {
  for (const Expression& operand : expression.operands)
    if (const Expression* const found = stage_in(operand)) return found;
  return expression.kind == Kind::stage && !is_rank(expression) ? &expression : nullptr;
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
  return judge_own(expression, place);
}

std::string usage_of(const std::string& name) {
  std::string parameters;
  for (const Key& key : keys) {
    if (name != key.owner) continue;
    const std::string one = std::string(key.key) + "=" + shown(key.low) + ".." + shown(key.high) +
                            (key.is_list ? " ..." : "");
    parameters += (parameters.empty() ? "" : " ") + (key.is_needed ? one : "[" + one + "]");
  }
  return parameters.empty()
             ? name
             : name + "(" + parameters + ")" + (name == "top" ? " by \"SCORE\"" : "");
}

std::vector<std::string> stage_names() { return {stages.begin(), stages.end()}; }

std::optional<std::string> complaint_about(const std::string& text,
                                           const FilterSettings& settings) {
  Expression expression;
  std::string complaint = read_expression(text, expression);
  if (complaint.empty()) complaint = judge_expression(expression);
  if (complaint.empty()) complaint = judge_plugins(expression, settings);
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

bool takes_cell_size(const std::string& text) {
  return has_scheme(text, [](const Expression& scheme) {
    const bool has_cells = std::any_of(keys.begin(), keys.end(), [&](const Key& key) {
      return scheme.name == key.owner && std::string_view(key.key) == "cell_size";
    });
    return has_cells &&
           std::isnan(scheme.parameter("cell_size", std::numeric_limits<double>::quiet_NaN()));
  });
}

}  // namespace rink::im
