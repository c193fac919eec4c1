// Kind and team in a byte each, then six numbers: varints of twice the ten thousandths, or a one
// and all bits of the float.
#include "game/replication/shape_codec.h"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "game/replication/attributes.h"
#include "im/basics/varint.h"

namespace rink::game {
namespace {

constexpr double decimals = 1e4;
constexpr std::uint64_t ten_thousandths_max = 1 << 24;

/// The float nearest to so many ten thousandths; the division rounds alike on any machine.
float float_of(std::uint64_t count) {
  return static_cast<float>(static_cast<double>(count) / decimals);
}

void encode_number(rti::Writer& writer, float value) {
  const double scaled = std::nearbyint(static_cast<double>(value) * decimals);
  const std::uint64_t count = scaled >= 0.0 && scaled < static_cast<double>(ten_thousandths_max)
                                  ? static_cast<std::uint64_t>(scaled)
                                  : 0;
  const bool is_short =
      std::bit_cast<std::uint32_t>(float_of(count)) == std::bit_cast<std::uint32_t>(value);
  std::uint64_t first = is_short ? count << 1 : 1;
  writer.varint(first);
  if (!is_short) writer.number(value);
}

/// Reads the number; false if it is malformed or not all there.
bool decode_number(rti::Reader& reader, float& value) {
  std::uint64_t first = 0;
  if (!reader.varint(first)) return false;
  if (first == 1) return reader.number(value);
  value = float_of(first >> 1);
  return (first & 1u) == 0 && first >> 1 < ten_thousandths_max;
}

std::array<float*, 6> numbers_of(Shape& shape) {
  return {&shape.half_length, &shape.half_width, &shape.drag,
          &shape.friction,    &shape.thrust,     &shape.mass};
}

bool read_shape(rti::Reader& reader, Shape& shape) {
  if (!reader.number(shape.kind) || !reader.number(shape.team)) return false;
  for (float* each : numbers_of(shape))
    if (!decode_number(reader, *each)) return false;
  return true;
}

}  // namespace

void ShapeCodec::encode(rti::Bytes value, double, std::vector<std::byte>& coded) const {
  Shape shape;
  [[maybe_unused]] const bool is_sound = game::decode(value, shape);
  assert(is_sound);
  rti::Writer writer(coded);
  writer.number(shape.kind);
  writer.number(shape.team);
  for (const float* each : numbers_of(shape)) encode_number(writer, *each);
}

std::optional<std::size_t> ShapeCodec::size(rti::Bytes coded) const {
  Shape shape;
  rti::Reader reader(coded);
  if (!read_shape(reader, shape)) return std::nullopt;
  return coded.size() - reader.rest().size();
}

bool ShapeCodec::decode(rti::Bytes coded, double, std::vector<std::byte>& value) const {
  Shape shape;
  rti::Reader reader(coded);
  if (!read_shape(reader, shape) || !reader.is_at_end()) return false;
  const std::size_t before = value.size();
  rti::Writer writer(value);
  if (exchange(writer, shape)) return true;
  value.resize(before);  // no finite number, or a strength below 0
  return false;
}

void ShapeCodec::list_fields(rti::Bytes coded, const rti::FieldVisitor& visit) const {
  rti::Reader reader(coded);
  std::uint8_t byte = 0;
  for (const char* each : {"kind", "team"})
    if (reader.number(byte)) visit(each, 8);
  for (const char* each : {"half_length", "half_width", "drag", "friction", "thrust", "mass"}) {
    const std::size_t before = reader.left();
    float number = 0.0f;
    if (decode_number(reader, number)) visit(each, 8 * (before - reader.left()));
  }
}

}  // namespace rink::game
