// Recursive descent, a function per level of precedence.
#include "loadgen/measure/assertion_syntax.h"

#include <array>
#include <cassert>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "loadgen/experiment/experiment.h"

namespace rink::loadgen {
namespace {

using Node = AssertionNode;
using Tree = std::unique_ptr<const Node>;

constexpr int depth_max = 100;            // so that no text overflows the stack,
constexpr std::size_t length_max = 4000;  // neither by its parentheses nor by a chain of operators

class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  Tree whole() {
    if (text_.size() > length_max)
      throw ExperimentError("--assert '" + text_.substr(0, 60) + "...': longer than " +
                            std::to_string(length_max) + " characters");
    Tree tree = either();
    skip_spaces();
    if (at_ < text_.size()) complain("an operator or the end");
    assert(depth_ == 0 && "every level that was entered was left");
    if (!tree->is_true_or_false()) complain("a comparison, for a number alone demands nothing");
    return tree;
  }

 private:
  [[noreturn]] void complain(const std::string& expected) const {
    throw ExperimentError("--assert '" + text_ + "': column " + std::to_string(at_ + 1) +
                          ": expected " + expected);
  }
  void skip_spaces() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  static bool is_word(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) || letter == '_';
  }

  bool accept(std::string_view sign) {
    skip_spaces();
    if (text_.compare(at_, sign.size(), sign) != 0) return false;
    const std::size_t end = at_ + sign.size();
    if (is_word(sign.back()) && end < text_.size() && is_word(text_[end])) return false;
    at_ = end;
    return true;
  }
  void expect(std::string_view sign) {
    if (!accept(sign)) complain(std::string(sign));
  }

  Tree joined(Node::Kind kind, Tree left, Tree right) const {
    const bool wants_truth = kind >= Node::Kind::both;
    assert(left && "a parser that finds nothing complains");
    for (const Tree* part : {&left, &right}) {
      if (*part && (*part)->is_true_or_false() != wants_truth)
        complain(wants_truth ? "comparisons on both sides of and, or, and behind not"
                             : "numbers on both sides of the operator");
    }
    auto node = std::make_unique<Node>();
    node->kind = kind;
    node->left = std::move(left);
    node->right = std::move(right);
    return node;
  }

  Tree either() {
    Tree left = both();
    while (accept("or")) left = joined(Node::Kind::either, std::move(left), both());
    return left;
  }
  Tree both() {
    Tree left = negation();
    while (accept("and")) left = joined(Node::Kind::both, std::move(left), negation());
    return left;
  }
  Tree negation() {
    if (!accept("not")) return comparison();
    const Deeper deeper(*this);
    return joined(Node::Kind::negation, negation(), nullptr);
  }
  Tree comparison() {
    static constexpr std::array<std::pair<const char*, Node::Kind>, 6> signs{
        {{"<=", Node::Kind::less_or_equal},
         {">=", Node::Kind::greater_or_equal},
         {"==", Node::Kind::equal},
         {"!=", Node::Kind::unequal},
         {"<", Node::Kind::less},
         {">", Node::Kind::greater}}};
    Tree left = sum();
    for (const auto& [sign, kind] : signs) {
      if (accept(sign)) return joined(kind, std::move(left), sum());
    }
    return left;
  }
  Tree sum() {
    Tree left = product();
    for (;;) {
      if (accept("+")) left = joined(Node::Kind::sum, std::move(left), product());
      else if (accept("-")) left = joined(Node::Kind::difference, std::move(left), product());
      else return left;
    }
  }
  Tree product() {
    Tree left = factor();
    for (;;) {
      if (accept("*")) left = joined(Node::Kind::product, std::move(left), factor());
      else if (accept("/")) left = joined(Node::Kind::quotient, std::move(left), factor());
      else return left;
    }
  }
  Tree factor() {
    const Deeper deeper(*this);
    if (accept("-")) return joined(Node::Kind::negative, factor(), nullptr);
    if (accept("(")) {
      Tree inner = either();
      expect(")");
      return inner;
    }
    skip_spaces();
    if (at_ < text_.size() &&
        (std::isdigit(static_cast<unsigned char>(text_[at_])) || text_[at_] == '.'))
      return number();
    return figure();
  }
  Tree number() {
    auto node = std::make_unique<Node>();
    const auto [end, error] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), node->number);
    if (error != std::errc() || !std::isfinite(node->number)) complain("a number");
    at_ = static_cast<std::size_t>(end - text_.data());
    assert(at_ <= text_.size());
    return node;
  }
  std::string word(const char* expected) {
    skip_spaces();
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    if (at_ == begin) complain(expected);
    return text_.substr(begin, at_ - begin);
  }
  /// Up to the comma or bracket that ends it, for schemes are composed of several words and
  /// parentheses.
  std::string value() {
    skip_spaces();
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != ']' && text_[at_] != '[') ++at_;
    std::size_t end = at_;
    while (end > begin && text_[end - 1] == ' ') --end;
    if (end == begin) complain("a value");
    return text_.substr(begin, end - begin);
  }
  Tree figure() {
    auto node = std::make_unique<Node>();
    node->kind = Node::Kind::figure;
    skip_spaces();
    const std::size_t begin = at_;
    node->name = word("a number, a figure or (");
    if (accept("[")) {
      do {
        std::string key = word("a key such as scheme");
        expect("=");
        node->selection.emplace_back(std::move(key), value());
      } while (accept(","));
      expect("]");
    }
    node->text = text_.substr(begin, at_ - begin);
    return node;
  }

  /// Counts how deep the parentheses nest while it lives.
  struct Deeper {
    explicit Deeper(Parser& parser) : depth(parser.depth_) {
      if (++depth > depth_max)
        parser.complain("at most " + std::to_string(depth_max) + " levels of parentheses");
    }
    ~Deeper() { --depth; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    int& depth;
  };

  const std::string& text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::unique_ptr<const AssertionNode> parse_assertion(const std::string& text) {
  return Parser(text).whole();
}

}  // namespace rink::loadgen
