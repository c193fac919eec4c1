// Takes the keys of an experiment's tables one by one, so that every error names file, line, key
// and what is allowed.
#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "game/model/listed.h"
#include "loadgen/experiment/experiment.h"
#include "loadgen/experiment/parameter.h"
#include "rti/schemes.h"

namespace rink::loadgen {

/// A value as the user wrote it, for messages.
inline std::string written(const toml::node& node) {
  std::ostringstream text;
  node.visit([&text](const auto& value) { text << value; });
  return text.str();
}

/// Takes known keys out of a table one by one; what is left in the end is unknown.
class ExperimentReader {
 public:
  /// `prefix` precedes keys in errors: the name of a table and a dot.
  ExperimentReader(const toml::table& table, std::string file, std::string prefix = "")
      : table_(table), file_(std::move(file)), prefix_(std::move(prefix)) {}

  /// Keys that the table lacks are taken from `other`, which outlives this.
  void fall_back_on(const toml::table& other) { others_ = &other; }

  std::string required_text(const char* key) {
    const toml::node* node = take(key);
    if (!node) throw ExperimentError(file_ + ": " + key + " is missing: a text is required");
    const auto text = node->value_exact<std::string>();
    if (!text || text->empty()) refuse(key, *node, "a text that is not empty");
    return *text;
  }

  void choose(const char* key, std::vector<std::string>& into,
              const std::vector<std::string>& allowed) {
    read_list(key, into, "one or more of " + game::listed(allowed),
              [&allowed](const toml::node& node) -> std::optional<std::string> {
                auto word = node.value_exact<std::string>();
                if (word && std::find(allowed.begin(), allowed.end(), *word) == allowed.end())
                  word.reset();
                return word;
              });
  }

  /// Texts for which `complaint` returns nothing; its text replaces the list of allowed values in
  /// the error. No two of them `are_alike`.
  void judged(const char* key, std::vector<std::string>& into,
              const std::function<std::optional<std::string>(const std::string&)>& complaint,
              const std::function<bool(const std::string&, const std::string&)>& are_alike) {
    std::string allowed = "the name of a scheme, or an expression of several (docs/im.md)";
    read_list(key, into, allowed, [&](const toml::node& node) -> std::optional<std::string> {
      auto text = node.value_exact<std::string>();
      const auto wrong = text ? complaint(*text) : std::nullopt;
      if (wrong) allowed = "a scheme: " + *wrong, text.reset();
      return text;
    });
    for (auto one = into.begin(); one != into.end(); ++one)
      for (auto other = into.begin(); other != one; ++other)
        if (are_alike(*one, *other))
          throw ExperimentError(file_ + ": " + prefix_ + key + ": '" + *other + "' and '" + *one +
                                "' mean the same: expected each once");
  }

  template <class Whole>
  void whole_numbers(const char* key, std::vector<Whole>& into, std::int64_t least,
                     std::int64_t most) {
    const std::string allowed =
        "whole numbers from " + std::to_string(least) + " to " + std::to_string(most);
    read_list(key, into, allowed, [least, most](const toml::node& node) -> std::optional<Whole> {
      const auto number = node.value_exact<std::int64_t>();
      if (!number || *number < least || *number > most) return std::nullopt;
      return static_cast<Whole>(*number);
    });
  }

  void numbers(const char* key, std::vector<double>& into, const std::string& allowed,
               const std::function<bool(double)>& is_allowed, bool is_whole = false) {
    read_list(key, into, allowed,
              [&is_allowed, is_whole](const toml::node& node) -> std::optional<double> {
                const auto value = node.is_number() && (!is_whole || node.is_integer())
                                       ? node.value<double>()
                                       : std::nullopt;
                if (!value || !std::isfinite(*value) || !is_allowed(*value)) return std::nullopt;
                return value;
              });
  }

  /// true, false or both, as 1 and 0.
  void switches(const char* key, std::vector<double>& into) {
    read_list(key, into, "true, false or both",
              [](const toml::node& node) -> std::optional<double> {
                const auto value = node.value_exact<bool>();
                return value ? std::optional(*value ? 1.0 : 0.0) : std::nullopt;
              });
  }

  /// A text that may be missing; `is_allowed` checks it.
  void text(const char* key, std::string& into, const std::string& allowed,
            const std::function<bool(const std::string&)>& is_allowed) {
    const toml::node* node = take(key);
    if (!node) return;
    const auto value = node->value_exact<std::string>();
    if (!value || !is_allowed(*value)) refuse(key, *node, allowed);
    into = *value;
  }

  /// An expression that decides relevance at an instant; it may be missing. Throws RelevanceError,
  /// which names the character of the fault.
  void momentary(const char* key, std::string& into) {
    const toml::node* node = take(key);
    if (!node) return;
    const auto text = node->value_exact<std::string>();
    const auto fault = text ? im::fault_in_momentary(*text) : im::ExpressionFault{"not a text", 1};
    if (fault)
      throw RelevanceError(place(node->source().begin.line) + prefix_ + key + " = " +
                           written(*node) + ": no relevance: at character " +
                           std::to_string(fault->character) + ": " + fault->what);
    into = *text;
  }

  void number(const char* key, double& into, const std::string& allowed,
              const std::function<bool(double)>& is_allowed) {
    const toml::node* node = take(key);
    if (!node) return;
    const auto value = node->is_number() ? node->value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || !is_allowed(*value)) refuse(key, *node, allowed);
    into = *value;
  }

  template <class Choice>
  void choice(const char* key, Choice& into,
              const std::vector<std::pair<std::string, Choice>>& allowed) {
    const toml::node* node = take(key);
    if (!node) return;
    const auto word = node->value_exact<std::string>();
    std::vector<std::string> words;
    for (const auto& [name, meaning] : allowed) {
      words.push_back(name);
      if (word && *word == name) return void(into = meaning);
    }
    refuse(key, *node, "one of " + game::listed(words));
  }

  /// The whole number of `key`, if that exists.
  std::optional<std::int64_t> whole_number(const char* key, std::int64_t least, std::int64_t most) {
    const toml::node* node = take(key);
    if (!node) return std::nullopt;
    const auto value = node->value_exact<std::int64_t>();
    if (!value || *value < least || *value > most)
      refuse(key, *node,
             "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return value;
  }

  /// The keys of a table below this one with their values as texts, in the order of the keys; none
  /// if there is no such table.
  std::vector<std::pair<std::string, std::string>> texts_of(const char* key) {
    const toml::node* node = take(key);
    std::vector<std::pair<std::string, std::string>> texts;
    if (!node) return texts;
    if (!node->is_table())
      refuse(key, *node,
             "a table of keys and values, such as { scheme = 'none', view_margin = 0 }");
    for (const auto& [name, value] : *node->as_table()) {
      const auto text = value.value_exact<std::string>();
      const auto is_on = value.value_exact<bool>();
      if (!text && !is_on && !value.is_number())
        refuse(key, *node, "a text, a number, true or false for each of its keys");
      const auto whole = value.value_exact<std::int64_t>();  // the largest are no doubles
      texts.emplace_back(name.str(), text    ? *text
                                     : is_on ? (*is_on ? "1" : "0")
                                     : whole ? std::to_string(*whole)
                                             : shortest(*value.value_exact<double>()));
    }
    return texts;
  }

  /// A table below this one, to be read key by key; nothing if there is none.
  std::optional<ExperimentReader> table(const char* key) {
    const toml::node* node = take(key);
    if (!node) return std::nullopt;
    if (!node->is_table()) refuse(key, *node, "a table");
    return ExperimentReader(*node->as_table(), file_, prefix_ + key + ".");
  }
  /// A reader for each table of a list; none if there is no list.
  std::vector<ExperimentReader> tables(const char* key) {
    const toml::node* node = take(key);
    std::vector<ExperimentReader> readers;
    if (!node) return readers;
    if (!node->is_array_of_tables()) refuse(key, *node, "a list of tables");
    for (const toml::node& entry : *node->as_array())
      readers.emplace_back(*entry.as_table(), file_, prefix_ + key + ".");
    return readers;
  }
  bool has(const char* key) const {
    return table_.contains(key) || (others_ != nullptr && others_->contains(key));
  }
  /// Throws an error about the table as a whole.
  [[noreturn]] void refuse_all(const std::string& why) const {
    throw ExperimentError(place(table_.source().begin.line) +
                          prefix_.substr(0, prefix_.size() - !prefix_.empty()) + ": " + why);
  }

  /// Throws an error about `key` if this table itself has it.
  void refuse_idle(const char* key, const std::string& why) const {
    if (const toml::node* node = table_.get(key))
      throw ExperimentError(place(node->source().begin.line) + prefix_ + key + " = " +
                            written(*node) + " changes nothing: " + why);
  }

  void refuse_the_rest() const {
    for (const auto& [key, node] : table_) {
      if (taken_.contains(std::string(key.str()))) continue;
      const std::vector<std::string> known(taken_.begin(), taken_.end());
      throw ExperimentError(place(key.source().begin.line) + "unknown key " + prefix_ +
                            std::string(key.str()) + ": allowed are " + game::listed(known));
    }
  }

 private:
  std::string place(std::uint32_t line) const { return file_ + ":" + std::to_string(line) + ": "; }

  [[noreturn]] void refuse(const char* key, const toml::node& node,
                           const std::string& allowed) const {
    throw ExperimentError(place(node.source().begin.line) + prefix_ + key + " = " + written(node) +
                          ": allowed is " + allowed);
  }

  const toml::node* take(const char* key) {
    taken_.insert(key);
    const toml::node* own = table_.get(key);
    return own == nullptr && others_ != nullptr ? others_->get(key) : own;
  }

  /// A list or a single value; each value once.
  template <class Value, class Read>
  void read_list(const char* key, std::vector<Value>& into, const std::string& allowed,
                 const Read& read) {
    const toml::node* node = take(key);
    if (!node) return;
    into.clear();
    const auto add = [&](const toml::node& entry) {
      const std::optional<Value> value = read(entry);
      if (!value) refuse(key, entry, allowed);
      if (std::find(into.begin(), into.end(), *value) != into.end())
        refuse(key, entry, "each value once");
      into.push_back(*value);
    };
    if (const toml::array* list = node->as_array()) {
      for (const toml::node& entry : *list) add(entry);
      if (into.empty()) refuse(key, *node, allowed);
    } else {
      add(*node);
    }
  }

  const toml::table& table_;
  const toml::table* others_ = nullptr;
  std::string file_, prefix_;
  std::set<std::string> taken_;
};

}  // namespace rink::loadgen
