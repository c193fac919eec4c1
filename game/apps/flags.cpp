// CLI11, once for all commands.
#include "game/apps/flags.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <concepts>
#include <cstdio>
#include <limits>
#include <utility>

namespace rink::game {

Check::Check(std::function<std::string(const std::string&)> objection,
             const std::string& description)
    : validator_(std::make_shared<const CLI::Validator>(
          [objection = std::move(objection)](std::string& text) { return objection(text); },
          description)) {}

Check::Check(const CLI::Validator& validator)
    : validator_(std::make_shared<const CLI::Validator>(validator)) {}

std::string Check::objection(const std::string& text) const { return (*validator_)(text); }

std::optional<double> number_in(const std::string& text) {
  double value = 0.0;
  return CLI::detail::lexical_cast(text, value) ? std::optional(value) : std::nullopt;
}

/// CLI11's own checks let NaN pass and print the bounds that they don't have with 309 digits.
Check number_from(double low, double high) {
  char range[80];
  std::snprintf(range, sizeof range, "from %g to %g", low, high);
  return {[low, high, range = std::string(range)](const std::string& text) -> std::string {
            const std::optional<double> value = number_in(text);
            if (value && *value >= low && *value <= high) return {};
            return text + " is not a number " + range;
          },
          range};
}

Check zero_or_number_from(double low, double high) {
  const Check from = number_from(low, high);
  return {[from](const std::string& text) -> std::string {
            const std::string objection = from.objection(text);
            return objection.empty() || number_in(text) == 0.0 ? "" : objection + ", nor 0";
          },
          "0 or " + from.validator().get_description()};
}

/// CLI11 itself takes -1 for 2^64 - 1, and says that 1e3 is not from 1 to a million.
Check whole_number_from(std::uint64_t low, std::uint64_t high) {
  const std::string range = "from " + std::to_string(low) + " to " + std::to_string(high);
  return {
      [low, high, range](const std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_whole = error == std::errc() && end == text.data() + text.size();
        return is_whole && value >= low && value <= high ? ""
                                                         : text + " is not a whole number " + range;
      },
      range};
}

Check whole_number_up_to(std::uint64_t most) {
  return {
      [from = whole_number_from(0, most)](const std::string& text) { return from.objection(text); },
      ""};
}

Check not_empty() {
  return {[](const std::string& text) -> std::string {
            return text.empty() ? "must not be empty" : "";
          },
          ""};
}

Check one_of(const std::vector<std::string>& names) { return Check(CLI::IsMember(names)); }
Check existing_file() { return Check(CLI::ExistingFile); }
Check existing_folder() { return Check(CLI::ExistingDirectory); }

Flag& Flag::check(const Check& check) { return option_->check(check.validator()), *this; }
Flag& Flag::shows_default() { return option_->capture_default_str(), *this; }
Flag& Flag::is_required() { return option_->required(), *this; }
Flag& Flag::needs(const Flag& other) { return option_->needs(other.option_), *this; }
Flag& Flag::excludes(const Flag& other) { return option_->excludes(other.option_), *this; }
Flag& Flag::group(const std::string& title) { return option_->group(title), *this; }
Flag& Flag::value_name(const std::string& name) { return option_->type_name(name), *this; }
Flag& Flag::delimiter(char delimiter) { return option_->delimiter(delimiter), *this; }
Flag& Flag::repeats() { return option_->take_all()->allow_extra_args(false), *this; }

Flags::Flags(const std::string& description, const std::string& name)
    : app_(std::make_unique<CLI::App>(description, name)) {}
Flags::~Flags() = default;

void Flags::name(const std::string& name) { app_->name(name); }
void Flags::description(const std::string& text) { app_->description(text); }
void Flags::footer(const std::string& text) { app_->footer(text); }
void Flags::version(const std::string& line) { app_->set_version_flag("--version", line); }

template <class Value>
void Flags::check_type(const Flag& flag) {
  if constexpr (std::same_as<Value, double>)
    of_types_.emplace_back(flag, Check([](const std::string& text) {
                             return number_in(text) ? "" : text + " is not a number";
                           }));
  else if constexpr (std::unsigned_integral<Value>)
    of_types_.emplace_back(flag, whole_number_up_to(std::numeric_limits<Value>::max()));
  else if constexpr (requires(Value value) { value.value(); })
    check_type<typename Value::value_type>(flag);
}

template <FlagValue Value>
Flag Flags::option(const std::string& flag, Value& value, const std::string& meaning) {
  const Flag made(app_->add_option(flag, value, meaning));
  check_type<Value>(made);
  return made;
}
template Flag Flags::option(const std::string&, std::string&, const std::string&);
template Flag Flags::option(const std::string&, std::vector<std::string>&, const std::string&);
template Flag Flags::option(const std::string&, double&, const std::string&);
template Flag Flags::option(const std::string&, std::uint16_t&, const std::string&);
template Flag Flags::option(const std::string&, std::uint32_t&, const std::string&);
template Flag Flags::option(const std::string&, std::uint64_t&, const std::string&);
template Flag Flags::option(const std::string&, std::optional<std::uint32_t>&, const std::string&);
template Flag Flags::option(const std::string&, std::optional<std::uint64_t>&, const std::string&);

Flag Flags::option(const std::string& flag, const std::function<void(const std::string&)>& take,
                   const std::string& meaning) {
  const std::function<void(const std::string&)> explained = [take](const std::string& text) {
    try {
      take(text);
    } catch (const FlagError& error) {
      throw CLI::ValidationError(error.what());
    }
  };
  return Flag(app_->add_option_function<std::string>(flag, explained, meaning));
}

Flag Flags::flag(const std::string& flag, bool& value, const std::string& meaning) {
  return Flag(app_->add_flag(flag, value, meaning));
}

Flag Flags::find(const std::string& flag) const { return Flag(app_->get_option(flag)); }

std::optional<int> Flags::parse(int count, const char* const* words, int bad_flags) {
  for (auto& [flag, check] : of_types_) flag.check(check);
  of_types_.clear();
  try {
    app_->parse(count, words);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app_->exit(error) == 0 ? 0 : bad_flags;
  }
}

void Flags::explain(const FlagError& error) const {
  app_->exit(CLI::ValidationError(error.what()));
}

bool Flags::is_given(const std::string& flag) const { return app_->count(flag) > 0; }
std::set<std::string> Flags::given() const {
  std::set<std::string> names;
  for (const CLI::Option* option : std::as_const(*app_).get_options())
    if (option->count() > 0)
      for (const std::string& name : option->get_lnames()) names.insert("--" + name);
  return names;
}

}  // namespace rink::game
