// Reads expressions by recursive descent.
#include "im/composition/expression.h"

#include <cassert>
#include <charconv>
#include <cmath>
#include <utility>

#include "im/basics/letters.h"

namespace rink::im {
namespace {

/// More parentheses than any sensible expression has; the limit protects the stack against
/// untrusted text.
constexpr int depth_max = 32;
/// The limit of stages, each of which may double the filters before it, and of the text, which is
/// read by recursion.
constexpr int stages_max = 8;
constexpr std::size_t expression_size_max = 4000;

bool is_quote(char c) { return c == '"' || c == '\''; }

class Reader {
 public:
  explicit Reader(std::string_view text) : begin_(text.data()), rest_(text) { next(); }

  std::string read(Expression& expression) {
    expression = whole();
    assert(!complaint_.empty() || depth_ == -1);  // each level has ended
    if (complaint_.empty() && !token_.empty()) complain("expected 'and', 'or', 'with' or the end");
    return complaint_;
  }
  /// The place of the fault.
  Expression::Place place() const { return complained_at_; }

 private:
  /// A word, a number or a sign; empty at the end.
  void next() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
    std::size_t length = rest_.empty() ? 0 : 1;
    const auto is_part = [this](char c) {
      return is_letter(rest_.front())
                 ? is_letter(c) || is_digit(c)
                 : is_number_ && (is_digit(c) || c == '.' || c == 'e' || c == '-' || c == '+');
    };
    if (length > 0 && is_quote(rest_.front())) {
      const std::size_t end = rest_.find(rest_.front(), 1);
      length = end == std::string_view::npos ? 1 : end + 1;  // one alone stands for nothing
      token_ = rest_.substr(0, length);
      return rest_.remove_prefix(length);
    }
    is_number_ = length > 0 && (is_digit(rest_.front()) || rest_.front() == '-' ||
                                rest_.front() == '.' || rest_.front() == '+');
    while (length > 0 && length < rest_.size() && is_part(rest_[length])) ++length;
    assert(length <= rest_.size());
    token_ = rest_.substr(0, length);
    rest_.remove_prefix(length);
  }
  bool take(std::string_view token) {
    if (!complaint_.empty() || token_ != token) return false;
    next();
    return true;
  }
  void complain(const std::string& what) {
    if (!complaint_.empty()) return;
    complaint_ = what + (token_.empty() ? " where it ends" : " at '" + std::string(token_) + "'");
    complained_at_ = here();
  }

  Expression::Place here() const {
    assert(token_.data() >= begin_);
    return {static_cast<std::size_t>(token_.data() - begin_)};
  }

  Expression whole() {
    if (++depth_ > depth_max)
      return complain("more than 32 levels of parentheses and 'not'"), Expression{};
    Expression result = joined(Expression::Kind::alternative);
    while (take("with")) {
      if (++stages_ > stages_max)
        return complain("more than " + std::to_string(stages_max) + " stages"), Expression{};
      Expression stage = named(Expression::Kind::stage, "expected the name of a stage");
      stage.operands.push_back(std::move(result));
      result = std::move(stage);
    }
    --depth_;
    return result;
  }
  Expression joined(Expression::Kind kind) {
    const bool is_or = kind == Expression::Kind::alternative;
    const auto operand = [&] { return is_or ? joined(Expression::Kind::conjunction) : term(); };
    Expression result = operand();
    while (take(is_or ? "or" : "and")) {
      Expression both{
          .kind = kind, .name = {}, .parameters = {}, .operands = {}, .place = result.place};
      both.operands.push_back(std::move(result));
      both.operands.push_back(operand());
      result = std::move(both);
    }
    return result;
  }
  Expression term() {
    if (take("not")) {
      if (++depth_ > depth_max)
        return complain("more than 32 levels of parentheses and 'not'"), Expression{};
      Expression negation{.kind = Expression::Kind::negation,
                          .name = {},
                          .parameters = {},
                          .operands = {},
                          .place = here()};
      negation.operands.push_back(term());
      --depth_;
      return negation;
    }
    if (!take("("))
      return named(Expression::Kind::scheme, "expected the name of a scheme, 'not' or '('");
    Expression inner = whole();
    if (!take(")")) complain("expected ')'");
    return inner;
  }
  Expression named(Expression::Kind kind, const char* expected) {
    Expression result{.kind = kind,
                      .name = std::string(token_),
                      .parameters = {},
                      .operands = {},
                      .place = here()};
    if (token_.empty() || !is_letter(token_.front()) || token_ == "and" || token_ == "or" ||
        token_ == "not" || token_ == "with")
      complain(expected);
    next();
    if (kind == Expression::Kind::scheme && is_condition(result.name)) {
      function_of(result);
      return result;
    }
    if (take("("))
      while (complaint_.empty() && !take(")")) result.parameters.push_back(parameter());
    if (kind == Expression::Kind::stage && take("by")) function_of(result);
    return result;
  }
  void function_of(Expression& owner) {
    owner.function_place = here();
    owner.is_plugin = !token_.empty() && is_letter(token_.front());
    if (!owner.is_plugin && token_.size() < 2) {
      if (!token_.empty() && is_quote(token_.front()))
        return complain("expected the quotation mark that ends what begins");
      return complain("expected a text in quotation marks, or the name of a plugin,");
    }
    if (!owner.is_plugin && !is_quote(token_.front()))
      return complain("expected a text in quotation marks, or the name of a plugin,");
    owner.function = owner.is_plugin ? token_ : token_.substr(1, token_.size() - 2);
    if (!owner.is_plugin) ++owner.function_place.character;
    next();
  }
  Expression::Parameter parameter() {
    Expression::Parameter result{std::string(token_), 0.0};
    if (token_.empty() || !is_letter(token_.front())) complain("expected 'key=number' or ')'");
    next();
    if (!take("=")) complain("expected '=' after '" + result.key + "'");
    const char* const end = token_.data() + token_.size();
    const auto [stop, fault] = std::from_chars(token_.data(), end, result.value);
    if (token_.empty() || fault != std::errc() || stop != end || !std::isfinite(result.value))
      complain("expected a number after '" + result.key + "='");
    next();
    return result;
  }

  const char* begin_;
  std::string_view rest_, token_;
  bool is_number_ = false;
  int depth_ = -1, stages_ = 0;  // the whole is no level
  std::string complaint_;
  Expression::Place complained_at_;
};

}  // namespace

bool is_condition(std::string_view name) { return name == "when" || name == "anywhere"; }

double Expression::parameter(std::string_view key, double otherwise) const {
  for (const Parameter& each : parameters)
    if (each.key == key) return each.value;
  return otherwise;
}

std::vector<double> Expression::parameters_called(std::string_view key) const {
  std::vector<double> values;
  values.reserve(parameters.size());
  for (const Parameter& each : parameters)
    if (each.key == key) values.push_back(each.value);
  return values;
}

std::string read_expression(std::string_view text, Expression& expression,
                            Expression::Place* place) {
  if (text.size() > expression_size_max) {
    if (place) *place = {expression_size_max};
    return "longer than " + std::to_string(expression_size_max) + " characters";
  }
  Reader reader(text);
  std::string complaint = reader.read(expression);
  if (place) *place = reader.place();
  return complaint;
}

}  // namespace rink::im
