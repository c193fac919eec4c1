// A stream that reads messages and notes how many bits each of their fields takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "rti/ledger/byte_ledger.h"
#include "rti/wire/stream.h"

namespace rink::rti {

/// Adds the fields of one message after the other to a ledger, those of a whole one at once.
class FormFields {
 public:
  FormFields(ByteLedger& ledger, LedgerDirection direction, LedgerChannel channel)
      : ledger_(ledger), of_{direction, channel, {}, {}, {}} {}

  void begin(std::string_view form) {
    of_.form = form;
    fields_.clear();
  }
  void add(std::string_view field, std::uint64_t bits, std::string_view subject = {}) {
    of_.subject = subject, of_.field = field;
    if (bits != 0) fields_.emplace_back(of_, bits);
  }
  /// The message is whole; without this call its fields are forgotten.
  void commit() {
    for (const auto& [field, bits] : fields_) ledger_.add(field, bits);
    fields_.clear();
  }
  /// A form of one field.
  void add_alone(std::string_view form, std::string_view field, std::uint64_t bits) {
    begin(form);
    add(field, bits);
    commit();
  }

 private:
  ByteLedger& ledger_;
  LedgerField of_;
  std::vector<std::pair<LedgerField, std::uint64_t>> fields_;
};

/// Gives what it takes from a reader to the fields of a message, one name after the other.
class FieldReader {
 public:
  static constexpr bool is_reading = true;
  FieldReader(Reader& reader, FormFields& fields, std::span<const std::string_view> names)
      : reader_(reader), fields_(fields), names_(names) {}

  template <class Number>
  bool number(Number& value) {
    const bool may_go_on = sizeof(Number) == 4 && is_set(name());
    return take([&] { return reader_.number(value); },
                [&] { return may_go_on && has_top_bit(value); });
  }
  template <class Number>
  bool varint(Number& value) {
    const bool may_go_on = sizeof(Number) == 8 && is_set(name());
    return take([&] { return reader_.varint(value); },
                [&] { return may_go_on && has_top_bit(value); });
  }
  bool part(std::uint64_t& value, std::size_t size) {
    return take([&] { return reader_.part(value, size); });
  }
  template <class Number>
  bool range(Number& value, std::uint64_t max) {
    return take([&] { return reader_.range(value, max); });
  }
  bool finite(double& value) {
    return take([&] { return reader_.finite(value); });
  }
  template <class Length>
  bool bytes(Bytes& value, std::size_t max) {
    return take([&] { return reader_.template bytes<Length>(value, max); });
  }
  bool text(std::string_view& value, std::size_t max) {
    return take([&] { return reader_.text(value, max); });
  }
  bool rest(Bytes& value, std::size_t size) {
    return take([&] { return reader_.rest(value, size); });
  }
  static bool check(bool is_sound) { return is_sound; }

 private:
  std::string_view name() const {
    if (at_ < names_.size() && !names_[at_].empty()) return names_[at_];
    std::string_view last = "rest";
    for (const std::string_view each : names_)
      if (!each.empty()) last = each;
    return last;
  }
  static bool is_set(std::string_view name) {
    return name == "attributes" || name == "repeated" || name == "recalled" || name == "heard" ||
           name == "active" || name == "which";
  }
  template <class Number>
  static bool has_top_bit(const Number& value) {
    if constexpr (std::is_integral_v<Number>)
      return static_cast<std::uint64_t>(value) >> (8 * sizeof(Number) - 1) != 0;
    return false;
  }
  /// `goes_on`: a set of many attributes has a second part.
  template <class Take, class GoesOn>
  bool take(Take take_part, GoesOn goes_on) {
    const std::size_t before = reader_.left();
    const bool is_sound = take_part();
    fields_.add(name(), 8 * (before - reader_.left()));
    if (!is_sound || !goes_on()) ++at_;
    return is_sound;
  }
  template <class Take>
  bool take(Take take_part) {
    return take(take_part, [] { return false; });
  }

  Reader& reader_;
  FormFields& fields_;
  std::span<const std::string_view> names_;
  std::size_t at_ = 0;
};

}  // namespace rink::rti
