// One table of a scene file, read key by key, with errors that name file, line, key, value and what
// was expected.
#pragma once

#include <toml++/toml.h>

#include <initializer_list>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "game/model/listed.h"
#include "game/model/scene.h"

namespace rink::game {

/// The numbers from `least` to `most`, or those above `least` only.
struct Range {
  double least = 0.0;
  double most = std::numeric_limits<double>::max();
  bool is_open = false;  ///< `least` itself is not allowed

  bool holds(double number) const {
    return number <= most && (is_open ? number > least : number >= least);
  }
  std::string text() const;
};

inline constexpr Range from_zero{0.0};
inline constexpr Range part_of_one{0.0, 1.0};

/// The ranges of a scene's numbers, far beyond any rink: within them nothing overflows, a clock in
/// doubles still separates impacts, and bodies are larger than the gap at which pressed ones count
/// as touching, 2e-6 m (docs/scenes.md, "Limits"). A puck at 1e300 m/s would never get to the end
/// of a second.
namespace limit {
inline constexpr double field_max = 1e9, speed_max = 1e6, thrust_max = 1e4, rate_max = 1e4,
                        spin_max = 1e9, time_max = 1e9;
inline constexpr Range field{1e-3, field_max};           ///< its sides [m]
inline constexpr Range position{-field_max, field_max};  ///< m; a later check finds whether it lies
                                                         ///< on the field
inline constexpr Range size{1e-5, field_max};            ///< radii and half extents [m]
inline constexpr Range mass{1e-6, 1e14};                 ///< kg
inline constexpr Range velocity{-speed_max, speed_max}, speed{0.0, speed_max};  ///< m/s
inline constexpr Range thrust{0.0, thrust_max};    ///< and friction with the table [m/s^2]
inline constexpr Range drag{0.0, rate_max};        ///< 1/s
inline constexpr Range friction{0.0, 1e6};         ///< of surfaces, Coulomb's coefficient
inline constexpr Range spin{-spin_max, spin_max};  ///< rad/s
inline constexpr Range ticks{0.0, 1000.0};         ///< 1/s
inline constexpr Range time{0.0, time_max}, delay{1e-9, time_max};  ///< s
}  // namespace limit

/// A key that is absent leaves the value as it is; the functions that are called `require_` refuse
/// that. Every function throws SceneError. Call `finish` at the end: it refuses keys that were not
/// read.
class SceneTable {
 public:
  /// `name` is the table's name in errors. `table` and `file` must outlive this.
  SceneTable(const toml::table& table, const std::string& file, std::string name)
      : table_(table), file_(file), name_(std::move(name)) {}

  bool has(const char* key) const { return table_.contains(key); }
  std::size_t line() const { return table_.source().begin.line; }

  bool number(const char* key, double& into, const Range& range);
  bool whole(const char* key, std::uint64_t& into, std::uint64_t least, std::uint64_t most);
  bool truth(const char* key, bool& into);
  bool text(const char* key, std::string& into);
  bool vector(const char* key, Vector2& into, const Range& range);
  /// One number, or two in ascending order: a span of values.
  bool span(const char* key, double& low, double& high, const Range& range);
  bool texts(const char* key, std::vector<std::string>& into);

  template <class Value>
  bool choice(const char* key, Value& into,
              std::initializer_list<std::pair<std::string_view, Value>> choices) {
    std::string word;
    if (!text(key, word)) return false;
    for (const auto& [name, value] : choices)
      if (name == word) return into = value, true;
    refuse(key, "one of " + listed(choices, [](const auto& each) { return each.first; }));
  }

  void require_number(const char* key, double& into, const Range& range) {
    require(number(key, into, range), key, "a number " + range.text());
  }
  void require_vector(const char* key, Vector2& into, const Range& range) {
    require(vector(key, into, range), key, "two numbers [x, y]");
  }
  void require_text(const char* key, std::string& into) { require(text(key, into), key, "a text"); }

  /// The table at `key`, if there is one.
  std::optional<SceneTable> table(const char* key);
  /// The tables written [[key]], in order of the file.
  std::vector<SceneTable> tables(const char* key);

  [[noreturn]] void refuse(const char* key, const std::string& expected) const;
  /// Throws an error about the table as a whole.
  [[noreturn]] void refuse_all(const std::string& why) const;
  void finish() const;

 private:
  const toml::node* find(const char* key);
  void require(bool was_there, const char* key, const std::string& expected) const;
  std::optional<double> number_of(const toml::node& node, const Range& range) const;

  const toml::table& table_;
  const std::string& file_;
  std::string name_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace rink::game
