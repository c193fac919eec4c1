// Every value is checked for type and range here, at the edge.
#include "game/model/scene_table.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <numeric>
#include <sstream>

#include "game/model/listed.h"

namespace rink::game {
namespace {

std::string text_of(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// As short as reads back to the same bits, and as TOML writes it.
std::string exact_text_of(double number) {
  std::array<char, 32> digits;
  const std::string text(digits.data(),
                         std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
  return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
}

std::string whole_text_of(const toml::node& node) {
  if (const toml::value<double>* number = node.as_floating_point())
    return exact_text_of(number->get());
  if (const toml::array* list = node.as_array()) return "[" + listed(*list, whole_text_of) + "]";
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

std::string text_of(const toml::node& node) {
  std::string all = whole_text_of(node);
  std::replace(all.begin(), all.end(), '\n', ' ');
  return all.size() > 60 ? all.substr(0, 57) + "..." : all;
}

/// Letters to insert, delete or change to make one word of the other (Levenshtein).
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, change}));
    }
  }
  assert(row.back() <= std::max(a.size(), b.size()) &&
         "no more than to change or add every letter");
  return row.back();
}

std::string at(const std::string& file, const toml::source_region& source) {
  return file + ":" + std::to_string(source.begin.line) + ": ";
}

}  // namespace

std::string Range::text() const {
  assert(least <= most);
  const std::string from = (is_open ? "above " : "from ") + text_of(least);
  if (most < std::numeric_limits<double>::max()) return from + " to " + text_of(most);
  return is_open ? from : from + " up";
}

const toml::node* SceneTable::find(const char* key) {
  asked_.insert(key);
  return table_.get(key);
}

void SceneTable::require(bool was_there, const char* key, const std::string& expected) const {
  if (!was_there)
    throw SceneError(at(file_, table_.source()) + name_ + " lacks the key " + key + ": expected " +
                     expected);
}

void SceneTable::refuse(const char* key, const std::string& expected) const {
  const toml::node* node = table_.get(key);
  assert(node != nullptr && "a key that is missing is refused by refuse_all");
  throw SceneError(at(file_, node->source()) + name_ + "." + key + " is " + text_of(*node) +
                   ": expected " + expected);
}

void SceneTable::refuse_all(const std::string& why) const {
  throw SceneError(at(file_, table_.source()) + name_ + ": " + why);
}

std::optional<double> SceneTable::number_of(const toml::node& node, const Range& range) const {
  if (!node.is_number()) return std::nullopt;
  const double number = *node.value<double>();
  return std::isfinite(number) && range.holds(number) ? std::optional(number) : std::nullopt;
}

bool SceneTable::number(const char* key, double& into, const Range& range) {
  const toml::node* node = find(key);
  if (!node) return false;
  const std::optional<double> number = number_of(*node, range);
  if (!number) refuse(key, "a number " + range.text());
  into = *number;
  return true;
}

bool SceneTable::whole(const char* key, std::uint64_t& into, std::uint64_t least,
                       std::uint64_t most) {
  assert(least <= most);
  const toml::node* node = find(key);
  if (!node) return false;
  const std::optional<std::int64_t> number =
      node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (!number || *number < 0 || static_cast<std::uint64_t>(*number) < least ||
      static_cast<std::uint64_t>(*number) > most)
    refuse(key, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  into = static_cast<std::uint64_t>(*number);
  return true;
}

bool SceneTable::truth(const char* key, bool& into) {
  const toml::node* node = find(key);
  if (!node) return false;
  if (!node->is_boolean()) refuse(key, "true or false");
  into = *node->value<bool>();
  return true;
}

bool SceneTable::text(const char* key, std::string& into) {
  const toml::node* node = find(key);
  if (!node) return false;
  if (!node->is_string() || node->as_string()->get().empty())
    refuse(key, "a text in quotation marks");
  into = node->as_string()->get();
  return true;
}

bool SceneTable::texts(const char* key, std::vector<std::string>& into) {
  const toml::node* node = find(key);
  if (!node) return false;
  const toml::array* list = node->as_array();
  const bool is_list = list && !list->empty() &&
                       std::all_of(list->begin(), list->end(), [](const toml::node& entry) {
                         return entry.is_string() && !entry.as_string()->get().empty();
                       });
  if (!is_list) refuse(key, "a list of texts");
  into.clear();
  for (const toml::node& entry : *list) into.push_back(entry.as_string()->get());
  return true;
}

bool SceneTable::vector(const char* key, Vector2& into, const Range& range) {
  const toml::node* node = find(key);
  if (!node) return false;
  const toml::array* list = node->as_array();
  const bool is_pair = list && list->size() == 2 && number_of(*list->get(0), range) &&
                       number_of(*list->get(1), range);
  if (!is_pair) refuse(key, "two numbers [x, y], each " + range.text());
  into = {*number_of(*list->get(0), range), *number_of(*list->get(1), range)};
  return true;
}

bool SceneTable::span(const char* key, double& low, double& high, const Range& range) {
  const toml::node* node = find(key);
  if (!node) return false;
  if (!node->is_array()) return number(key, low, range), high = low, true;
  Vector2 pair;
  vector(key, pair, range);
  if (pair.x() > pair.y()) refuse(key, "a number, or the least and the greatest in this order");
  low = pair.x();
  high = pair.y();
  assert(range.holds(low) && range.holds(high) && low <= high);
  return true;
}

std::optional<SceneTable> SceneTable::table(const char* key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) refuse(key, std::string("a table, written [") + key + "]");
  return SceneTable(*node->as_table(), file_, key);
}

std::vector<SceneTable> SceneTable::tables(const char* key) {
  std::vector<SceneTable> all;
  const toml::node* node = find(key);
  if (!node) return all;
  const toml::array* list = node->as_array();
  if (!list || !std::all_of(list->begin(), list->end(),
                            [](const toml::node& entry) { return entry.is_table(); }))
    refuse(key, std::string("tables, each written [[") + key + "]]");
  for (const toml::node& entry : *list) all.emplace_back(*entry.as_table(), file_, key);
  return all;
}

void SceneTable::finish() const {
  for (const auto& [key, node] : table_) {
    if (asked_.contains(key.str())) continue;
    const auto nearest = std::min_element(asked_.begin(), asked_.end(),
                                          [word = key.str()](const auto& a, const auto& b) {
                                            return edits(a, word) < edits(b, word);
                                          });
    const bool is_near =
        nearest != asked_.end() &&
        edits(*nearest, key.str()) <= std::max<std::size_t>(2, key.str().size() / 3);
    throw SceneError(at(file_, key.source()) + name_ + " has the unknown key " +
                     std::string(key.str()) + (is_near ? ": did you mean " + *nearest + "?" : ":") +
                     " Known are " + listed(asked_));
  }
}

}  // namespace rink::game
