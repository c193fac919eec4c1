// The flags of a command: the name, meaning and range of each, and the refusal of a wrong one.
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

// CLI11 stays behind flags.cpp: its headers take the compiler longer than all else that a command
// includes.
namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace rink::game {

/// A condition on a flag's value.
class Check {
 public:
  /// `objection` returns the fault of a text, or nothing; `description` stands for the value in the
  /// help.
  template <class Objection>
  requires std::convertible_to<std::invoke_result_t<Objection, const std::string&>, std::string>
  Check(Objection objection, const std::string& description = "")
      : Check(std::function<std::string(const std::string&)>(std::move(objection)), description) {}
  Check(std::function<std::string(const std::string&)> objection, const std::string& description);
  explicit Check(const CLI::Validator& validator);

  /// The fault of `text`; empty if there is none.
  std::string objection(const std::string& text) const;
  const CLI::Validator& validator() const { return *validator_; }

 private:
  std::shared_ptr<const CLI::Validator> validator_;
};

/// The number that `text` is, as a flag of type double reads it.
std::optional<double> number_in(const std::string& text);

/// A number from `low` to `high`, which NaN is not.
Check number_from(double low, double high);
/// 0, which leaves the choice to the program, or a number from `low` to `high`.
Check zero_or_number_from(double low, double high);
/// A whole number from `low` to `high`.
Check whole_number_from(std::uint64_t low, std::uint64_t high);
/// A whole number from 0 to `most`.
Check whole_number_up_to(std::uint64_t most);
Check not_empty();
Check one_of(const std::vector<std::string>& names);
Check existing_file();
Check existing_folder();

/// Further properties of one flag. A handle: the flag itself belongs to its `Flags`.
class Flag {
 public:
  Flag& check(const Check& check);
  /// Makes the help show the default value.
  Flag& shows_default();
  Flag& is_required();
  Flag& needs(const Flag& other);
  Flag& excludes(const Flag& other);
  /// Sets its title in the help.
  Flag& group(const std::string& title);
  /// Sets the name that the help gives to the value, e.g. HOST:PORT.
  Flag& value_name(const std::string& name);
  /// Allows several values in one argument, with `delimiter` between them.
  Flag& delimiter(char delimiter);
  /// Allows the flag repeatedly, each time with one value.
  Flag& repeats();

 private:
  friend class Flags;
  explicit Flag(CLI::Option* option) : option_(option) {}
  CLI::Option* option_;
};

/// A wrong flag; what() names it and what is expected.
class FlagError : public std::runtime_error {
 public:
  FlagError(const std::string& flag, const std::string& objection)
      : std::runtime_error(flag.empty() ? objection : flag + ": " + objection) {}
};

template <class T>
concept FlagValue = std::same_as<T, std::string> || std::same_as<T, std::vector<std::string>> ||
    std::same_as<T, double> || std::same_as<T, std::uint16_t> || std::same_as<T, std::uint32_t> ||
    std::same_as<T, std::uint64_t> || std::same_as<T, std::optional<std::uint32_t>> ||
    std::same_as<T, std::optional<std::uint64_t>>;

/// All flags of a command. Their values must outlive it.
class Flags {
 public:
  /// `name` is the command's name in the help; empty: the name of its program.
  explicit Flags(const std::string& description = "", const std::string& name = "");
  ~Flags();
  Flags(Flags&&) = delete;

  void name(const std::string& name);
  void description(const std::string& text);
  /// Sets the text after the flags in the help.
  void footer(const std::string& text);
  /// Sets the text that --version prints.
  void version(const std::string& line);

  /// A value `flag`, or the next word of the command line if `flag` does not begin with a dash.
  template <FlagValue Value>
  Flag option(const std::string& flag, Value& value, const std::string& meaning);
  /// A value that `take` reads; a FlagError of `take` is explained to the user.
  Flag option(const std::string& flag, const std::function<void(const std::string&)>& take,
              const std::string& meaning);
  /// A value that is true if `flag` is given; "!--no-x" makes it false, "--x,!--no-x" either.
  Flag flag(const std::string& flag, bool& value, const std::string& meaning);
  /// A flag that was added before.
  Flag find(const std::string& flag) const;

  /// Reads the command line; the status with which to end if nothing is to be done: 0 after
  /// --help and --version, which are printed, `bad_flags` after the explanation of a wrong flag.
  std::optional<int> parse(int count, const char* const* words, int bad_flags);
  /// Explains a wrong flag that was found after `parse`, as `parse` does.
  void explain(const FlagError& error) const;
  bool is_given(const std::string& flag) const;
  /// By all their long names, with dashes.
  std::set<std::string> given() const;

 private:
  /// Of what a value of that type takes: asked after all other checks, since these say more.
  template <class Value>
  void check_type(const Flag& flag);

  std::unique_ptr<CLI::App> app_;
  std::vector<std::pair<Flag, Check>> of_types_;
};

}  // namespace rink::game
