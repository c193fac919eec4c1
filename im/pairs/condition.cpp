// Reads by recursive descent, checks types on the way, and writes the program as it goes.
#include "im/pairs/condition.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "im/basics/letters.h"
#include "im/pairs/attributes.h"
#include "im/pairs/program.h"

namespace rink::im {
namespace {

constexpr int nesting_max = 32;
constexpr std::size_t text_size_max = 1000;
constexpr double nobodys = RINK_NONE;

template <class Function>
void apply(const double* a, const double* b, double* out, std::size_t count) {
  const Function function{};
  for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<double>(function(a[i], b[i]));
}

#define RINK_OPERATION(name, result)                                                     \
  struct name {                                                                          \
    auto operator()(double a, double b) const { return static_cast<void>(b), (result); } \
  }
RINK_OPERATION(Add, a + b);
RINK_OPERATION(Subtract, a - b);
RINK_OPERATION(Multiply, a* b);
RINK_OPERATION(Divide, a / b);
RINK_OPERATION(Less, a < b);
RINK_OPERATION(LessOrEqual, a <= b);
RINK_OPERATION(Equal, a == b);
RINK_OPERATION(Unequal, a != b);
RINK_OPERATION(Same, (a == b) & (a != nobodys));
RINK_OPERATION(NotSame, (a != b) | (a == nobodys));
RINK_OPERATION(And, a* b);
RINK_OPERATION(Or, a > b ? a : b);
RINK_OPERATION(Not, 1.0 - a);
RINK_OPERATION(Negate, -a);
RINK_OPERATION(Absolute, std::abs(a));
RINK_OPERATION(Root, std::sqrt(a));
RINK_OPERATION(Smaller, b < a ? b : a);
RINK_OPERATION(Larger, a < b ? b : a);
#undef RINK_OPERATION

struct NamedFunction {
  const char* name;
  Program::Operation operation;
  bool takes_two;
};
constexpr std::array functions{
    NamedFunction{"abs", apply<Absolute>, false}, NamedFunction{"max", apply<Larger>, true},
    NamedFunction{"min", apply<Smaller>, true}, NamedFunction{"sqrt", apply<Root>, false}};

/// What a part of the text stands for.
struct Value {
  ValueType type = ValueType::number;
  Program::Column column = 0;
  const NamedAttribute* attribute = nullptr;  ///< it is this one's, of the entity, and no more
  bool is_mine = false;                       ///< the word `mine`, which has no column yet
  bool is_constant = false;
  bool is_none = false;  ///< a team or an owner, as the other side is
  std::size_t place = 0;
};

class Compiler {
 public:
  explicit Compiler(std::string_view text) : text_(text) { next(); }

  std::unique_ptr<PairFunction> compile(Wanted wanted, ConditionFault& fault) {
    const Value whole = alternative();
    if (!token_.empty()) complain("expected an operator, 'and', 'or' or the end", here());
    if (wanted == Wanted::condition) expect(whole, ValueType::truth, "a condition is");
    else expect(whole, ValueType::number, "a score is");
    if (!fault_.what.empty()) return fault = fault_, nullptr;
    program_->answer_with(whole.column);
    return std::move(program_);
  }

 private:
  void next() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    begin_ = at_;
    if (at_ == text_.size()) return void(token_ = {});
    const char first = text_[at_++];
    const auto extend = [this](auto belongs) {
      while (at_ < text_.size() && belongs(text_[at_])) ++at_;
    };
    if (is_letter(first)) extend([](char c) { return is_letter(c) || is_digit(c) || c == '.'; });
    else if (is_digit(first) || first == '.')
      extend([this](char c) {
        const char before = text_[at_ - 1];
        return is_digit(c) || c == '.' || c == 'e' || ((c == '-' || c == '+') && before == 'e');
      });
    else if (first == '<' || first == '>' || first == '=' || first == '!')
      at_ += at_ < text_.size() && text_[at_] == '=' ? 1 : 0;
    token_ = text_.substr(begin_, at_ - begin_);
  }
  bool take(std::string_view token) {
    if (!fault_.what.empty() || token_ != token) return false;
    next();
    return true;
  }
  std::size_t here() const { return begin_; }
  std::string seen() const {
    return token_.empty() ? " where it ends" : " at '" + std::string(token_) + "'";
  }
  void complain_of(const std::string& what, std::size_t place) {
    if (fault_.what.empty()) fault_ = {what, place};
  }
  void complain(const std::string& what, std::size_t place) { complain_of(what + seen(), place); }
  bool is_faulty() {
    if (program_->is_full())
      complain_of("more than 256 names, numbers and intermediate results", here());
    return !fault_.what.empty();
  }
  bool enter() {
    if (++depth_ > nesting_max) complain_of("more than 32 levels of nesting", here());
    return !is_faulty();
  }

  void expect(const Value& value, ValueType type, const std::string& what) {
    if (!fault_.what.empty()) return;
    if (value.is_mine)
      complain_of("'mine' has a meaning only beside a comparison, as in 'team == mine'",
                  value.place);
    else if (value.type != type)
      complain_of(what + " " + text_of(type) + ", but this is " + text_of(value.type) +
                      (type == ValueType::truth ? ": compare it, as in 'distance < 4'" : ""),
                  value.place);
  }
  Value combined(Program::Operation operation, ValueType type, const Value& a, const Value& b) {
    if (is_faulty()) return {.type = type};
    return {.type = type,
            .column = program_->operation(operation, a.column, b.column),
            .place = a.place};
  }

  Value alternative() {
    Value result = conjunction();
    while (take("or")) {
      const Value other = conjunction();
      expect(result, ValueType::truth, "'or' joins what is");
      expect(other, ValueType::truth, "'or' joins what is");
      result = combined(apply<Or>, ValueType::truth, result, other);
    }
    return result;
  }
  Value conjunction() {
    Value result = negation();
    while (take("and")) {
      const Value other = negation();
      expect(result, ValueType::truth, "'and' joins what is");
      expect(other, ValueType::truth, "'and' joins what is");
      result = combined(apply<And>, ValueType::truth, result, other);
    }
    return result;
  }
  Value negation() {
    const std::size_t place = here();
    if (!take("not")) return comparison();
    if (!enter()) return {};
    Value result = negation();
    --depth_;
    expect(result, ValueType::truth, "'not' turns what is");
    result = combined(apply<Not>, ValueType::truth, result, result);
    result.place = place;
    return result;
  }
  Value comparison() {
    Value left = sum();
    const std::string sign(token_);
    const bool orders = sign == "<" || sign == "<=" || sign == ">" || sign == ">=",
               equates = sign == "==" || sign == "!=";
    if (sign == "=" || sign == "!")
      complain_of("expected '" + sign + "=', not '" + sign + "'", here());
    if ((!orders && !equates) || !take(sign)) return left;
    Value right = sum();
    resolve_mine(left, right), resolve_mine(right, left);
    if (is_faulty()) return {};
    if (orders) {
      expect(left, ValueType::number, "'" + sign + "' compares what is");
      expect(right, ValueType::number, "'" + sign + "' compares what is");
      if (sign.front() == '>') std::swap(left.column, right.column);
      return combined(sign.size() == 1 ? apply<Less> : apply<LessOrEqual>, ValueType::truth, left,
                      right);
    }
    if (left.is_none && right.type == ValueType::owner) left.type = ValueType::owner;
    if (right.is_none && left.type == ValueType::owner) right.type = ValueType::owner;
    expect(right, left.type, "'" + sign + "' compares it with what is");
    // Nobody's team is no team that two could share, though it can be asked for.
    const bool is_shared = (left.type == ValueType::team || left.type == ValueType::owner) &&
                           !left.is_constant && !right.is_constant;
    return combined(sign == "==" ? (is_shared ? apply<Same> : apply<Equal>)
                                 : (is_shared ? apply<NotSame> : apply<Unequal>),
                    ValueType::truth, left, right);
  }
  /// `mine` is the subscriber's value of the attribute on the other side.
  void resolve_mine(Value& value, const Value& other) {
    if (is_faulty()) return;
    if (value.is_mine) {
      if (other.attribute == nullptr || other.attribute->mine == nullptr)
        return complain_of(
            "'mine' needs an attribute of the entity on the other side, as in 'team == mine'",
            value.place);
      value = {.type = other.type,
               .column = program_->attribute(other.attribute->mine, other.attribute->uses),
               .place = value.place};
    }
  }
  Value sum() {
    return joined("+", "-", [this] { return product(); });
  }
  Value product() {
    return joined("*", "/", [this] { return factor(); });
  }
  template <class Operand>
  Value joined(const char* first, const char* second, const Operand& operand) {
    Value result = operand();
    while (token_ == first || token_ == second) {
      const std::string sign(token_);
      if (!take(sign)) break;
      const Value other = operand();
      for (const Value& each : {result, other})
        expect(each, ValueType::number, "'" + sign + "' takes what is");
      result = combined(sign == "+"   ? apply<Add>
                        : sign == "-" ? apply<Subtract>
                        : sign == "*" ? apply<Multiply>
                                      : apply<Divide>,
                        ValueType::number, result, other);
    }
    return result;
  }
  Value factor() {
    const std::size_t place = here();
    if (!take("-")) return primary();
    if (!enter()) return {};
    Value result = factor();
    --depth_;
    expect(result, ValueType::number, "'-' takes what is");
    result = combined(apply<Negate>, ValueType::number, result, result);
    result.place = place;
    return result;
  }
  Value primary() {
    if (is_faulty()) return {};
    const std::size_t place = here();
    if (take("(")) {
      if (!enter()) return {};
      Value inner = alternative();
      if (!take(")")) complain("expected ')'", here());
      --depth_;
      inner.place = place;
      return inner;
    }
    if (!token_.empty() && (is_digit(token_.front()) || token_.front() == '.')) return number();
    if (token_.empty() || !is_letter(token_.front()) || token_ == "and" || token_ == "or" ||
        token_ == "not") {
      complain("expected a number, a name, '-', 'not' or '('", place);
      return {};
    }
    const std::string word(token_);
    next();
    return token_ == "(" ? call(word, place) : named(word, place);
  }
  Value number() {
    const std::size_t place = here();
    double value = 0.0;
    const char* const end = token_.data() + token_.size();
    const auto [stop, fault] = std::from_chars(token_.data(), end, value);
    if (fault != std::errc() || stop != end || !std::isfinite(value)) {
      complain("expected a finite number", place);
      return {};
    }
    next();
    return {.column = program_->constant(value), .is_constant = true, .place = place};
  }
  Value call(const std::string& word, std::size_t place) {
    const auto* const function = std::find_if(functions.begin(), functions.end(),
                                              [&](const auto& each) { return word == each.name; });
    if (function == functions.end()) {
      complain_of("no function is called '" + word + "'; there are abs, max, min, sqrt", place);
      return {};
    }
    next();
    if (!enter()) return {};
    const Value first = sum();
    Value second = first;
    if (function->takes_two) {
      if (!take(",")) complain("expected ',': " + word + " takes two numbers", here());
      second = sum();
    }
    if (!take(")")) complain("expected ')'", here());
    --depth_;
    for (const Value& each : {first, second})
      expect(each, ValueType::number, word + " takes what is");
    Value result = combined(function->operation, ValueType::number, first, second);
    result.place = place;
    return result;
  }
  Value named(const std::string& word, std::size_t place) {
    if (word == "mine") return {.is_mine = true, .place = place};
    if (word == "none")
      return {.type = ValueType::team,
              .column = program_->constant(nobodys),
              .is_constant = true,
              .is_none = true,
              .place = place};
    for (const NamedKind& each : named_kinds())
      if (word == each.name)
        return {.type = ValueType::kind,
                .column = program_->constant(static_cast<double>(each.kind)),
                .is_constant = true,
                .place = place};
    const bool is_own = word.starts_with("my.");
    std::string known;
    for (const NamedAttribute& each : named_attributes()) {
      if (is_own && each.mine == nullptr) continue;
      known += (known.empty() ? "" : ", ") + std::string(is_own ? "my." : "") + each.name;
      if ((is_own ? word.substr(3) : word) != each.name) continue;
      return {.type = each.type,
              .column = program_->attribute(is_own ? each.mine : each.its, each.uses),
              .attribute = is_own ? nullptr : &each,
              .place = place};
    }
    complain_of("nothing is called '" + word + "'; there are " + known +
                    (is_own ? "" : "; mine, my.NAME; none, puck, bat, post"),
                place);
    return {};
  }
  std::string_view text_, token_;
  std::size_t at_ = 0, begin_ = 0;
  int depth_ = 0;
  ConditionFault fault_;
  std::unique_ptr<Program> program_ = std::make_unique<Program>();
};

}  // namespace

std::unique_ptr<PairFunction> compile_condition(std::string_view text, Wanted wanted,
                                                ConditionFault& fault) {
  if (text.size() > text_size_max) {
    fault = {"longer than " + std::to_string(text_size_max) + " characters", text_size_max};
    return nullptr;
  }
  return Compiler(text).compile(wanted, fault);
}

}  // namespace rink::im
