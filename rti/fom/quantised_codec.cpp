// Rounds, packs and checks; what a field is in memory matters only here.
#include "rti/fom/quantised_codec.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace rink::rti {

namespace {

using Form = QuantisedField::Form;

template <class Number>
double load_as(const QuantisedField& field, Bytes at) {
  assert(at.size() == sizeof(Number));
  std::array<std::byte, sizeof(Number)> bytes;
  std::copy_n(at.begin(), sizeof(Number), bytes.begin());
  if (field.is_big_endian) std::ranges::reverse(bytes);
  return static_cast<double>(std::bit_cast<Number>(bytes));
}

double load(const QuantisedField& field, Bytes at) {
  switch (field.form) {
    case Form::float32:
      return load_as<float>(field, at);
    case Form::float64:
      return load_as<double>(field, at);
    case Form::integer16:
      return load_as<std::int16_t>(field, at);
    case Form::integer32:
      return load_as<std::int32_t>(field, at);
    case Form::octets:
      break;
  }
  return 0.0;
}

template <class Number>
void append_as(const QuantisedField& field, double number, std::vector<std::byte>& value) {
  auto bytes = std::bit_cast<std::array<std::byte, sizeof(Number)>>(static_cast<Number>(number));
  if (field.is_big_endian) std::ranges::reverse(bytes);
  value.insert(value.end(), bytes.begin(), bytes.end());
}

void append(const QuantisedField& field, double number, std::vector<std::byte>& value) {
  switch (field.form) {
    case Form::float32:
      return append_as<float>(field, number, value);
    case Form::float64:
      return append_as<double>(field, number, value);
    case Form::integer16:
      return append_as<std::int16_t>(field, number, value);
    case Form::integer32:
      return append_as<std::int32_t>(field, number, value);
    case Form::octets:
      break;
  }
  assert(false && "octets have no grid");
}

/// Takes the field's bytes off the front of the value.
Bytes take(const QuantisedField& field, Bytes& value) {
  assert(field.padding + field.size <= value.size());
  const Bytes found = value.subspan(field.padding, field.size);
  value = value.subspan(field.padding + field.size);
  return found;
}

void append_padding(const QuantisedField& field, std::vector<std::byte>& value) {
  value.resize(value.size() + field.padding);
}

void write_octets(BitWriter& bits, Bytes octets) {
  for (const std::byte octet : octets) bits.bits(octet, 8);
}

bool read_octets(BitReader& bits, std::size_t size, std::vector<std::byte>& value) {
  for (std::size_t i = 0; i < size; ++i)
    if (!bits.bits(value.emplace_back(), 8)) return false;
  return true;
}

}  // namespace

QuantisedCodec::QuantisedCodec(std::vector<QuantisedField> fields) : fields_(std::move(fields)) {
  assert(fields_.size() <= field_max);
  for (const QuantisedField& field : fields_) {
    assert(!field.grid || field.form != Form::octets);
    assert(!field.rate_of || (*field.rate_of < fields_.size() && fields_[*field.rate_of].grid));
    fields_size_ += field.size;
    packed_bits_ += field.grid ? field.grid->bits : 8 * field.size;
    is_all_quantised_ = is_all_quantised_ && field.grid.has_value();
  }
}

std::string QuantisedCodec::name() const {
  std::string text = "rink-quantised-1";
  const auto add = [&text](char mark, std::int64_t number) {
    text += mark;
    text += std::to_string(number);
  };
  for (const QuantisedField& field : fields_) {
    add(' ', static_cast<int>(field.form));
    add(field.is_big_endian ? 'b' : 'l', field.size);
    if (field.grid)
      add(':', std::ilogb(field.grid->step)), add(':', field.grid->first),
          add(':', static_cast<std::int64_t>(field.grid->last));
    if (field.rate_of) add('@', *field.rate_of);
    if (field.padding != 0) add('+', field.padding);
  }
  return text;
}

bool QuantisedCodec::is_in_range(Bytes value) const {
  for (const QuantisedField& field : fields_) {
    const Bytes own = take(field, value);
    if (field.grid && !field.grid->contains(load(field, own))) return false;
  }
  return true;
}

void QuantisedCodec::encode(Bytes value, double, std::vector<std::byte>& coded) const {
  BitWriter bits(coded);
  const bool is_full = !is_in_range(value);
  bits.flag(is_full);
  for (const QuantisedField& field : fields_) {
    const Bytes own = take(field, value);
    if (field.grid && !is_full) bits.quantised(load(field, own), *field.grid);
    else write_octets(bits, own);
  }
}

std::optional<std::size_t> QuantisedCodec::size(Bytes coded) const {
  BitReader bits(coded);
  bool is_full = false;
  if (!bits.flag(is_full)) return std::nullopt;
  const std::size_t size = (coded_bits(is_full) + 7) / 8;
  if (size > coded.size()) return std::nullopt;
  return is_full || is_sound(bits) ? std::optional(size) : std::nullopt;
}

/// True if the counts, all of which are there, are in their ranges.
bool QuantisedCodec::is_sound(BitReader bits) const {
  for (const QuantisedField& field : fields_) {
    double number = 0.0;
    if (field.grid ? !bits.quantised(number, *field.grid) : !bits.skip(8 * field.size))
      return false;
  }
  return bits.finish();
}

bool QuantisedCodec::read_in_full(BitReader& bits, std::vector<std::byte>& value) const {
  for (const QuantisedField& field : fields_) {
    append_padding(field, value);
    if (!read_octets(bits, field.size, value)) return false;
  }
  return true;
}

bool QuantisedCodec::decode(BitReader& bits, std::vector<std::byte>& value) const {
  bool is_full = false;
  if (!bits.flag(is_full)) return false;
  if (is_full) return read_in_full(bits, value);
  for (const QuantisedField& field : fields_) {
    double number = 0.0;
    append_padding(field, value);
    if (!(field.grid ? bits.quantised(number, *field.grid) : read_octets(bits, field.size, value)))
      return false;
    if (field.grid) append(field, number, value);
  }
  return true;
}

bool QuantisedCodec::decode(Bytes coded, double, std::vector<std::byte>& value) const {
  BitReader bits(coded);
  return decode(bits, value) && bits.finish() && bits.left() == 0;
}

std::optional<bool> QuantisedCodec::decode(BitReader& bits, Counts& counts,
                                           std::vector<std::byte>& value) const {
  assert(is_all_quantised_);
  bool is_full = false;
  if (!bits.flag(is_full) || !(is_full ? read_in_full(bits, value) : exchange_counts(bits, counts)))
    return std::nullopt;
  if (!is_full) append_value(counts, value);
  return !is_full;
}

bool QuantisedCodec::read_counts(Bytes coded, Counts& counts) const {
  assert(is_all_quantised_);
  BitReader bits(coded);
  bool is_full = false;
  return bits.flag(is_full) && !is_full && exchange_counts(bits, counts);
}

void QuantisedCodec::append_value(const Counts& counts, std::vector<std::byte>& value) const {
  assert(is_all_quantised_);
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    assert(counts[i] >= 0 && static_cast<std::uint64_t>(counts[i]) <= fields_[i].grid->last);
    append_padding(fields_[i], value);
    append(fields_[i], fields_[i].grid->value(static_cast<std::uint64_t>(counts[i])), value);
  }
}

void QuantisedCodec::list_fields(Bytes coded, const FieldVisitor& visit) const {
  BitReader bits(coded);
  bool is_full = false;
  if (!bits.flag(is_full)) return;
  visit("form", 1);
  for (const QuantisedField& field : fields_)
    visit(field.name, field.grid && !is_full ? field.grid->bits : 8 * field.size);
  visit("fill", 8 * coded.size() - coded_bits(is_full));
}

}  // namespace rink::rti
