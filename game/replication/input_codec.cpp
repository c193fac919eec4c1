// One varint of the count above and the keys that are held below; as a residual, how many keys more
// and which one changed.
#include "game/replication/input_codec.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "game/replication/attributes.h"
#include "im/basics/varint.h"
#include "rti/wire/bit_stream.h"

namespace rink::game {
namespace {

constexpr unsigned held_bits = 4, key_bits = 2;  // which of the held keys
constexpr std::uint32_t more_max = 1023;         ///< keys between two updates
constexpr std::size_t size_max = 6;              ///< of 36 bits

}  // namespace

void InputCodec::encode(rti::Bytes value, double, std::vector<std::byte>& coded) const {
  Input input;
  [[maybe_unused]] const bool is_sound = game::decode(value, input);
  assert(is_sound && input.held < 1u << held_bits);
  std::uint64_t packed = static_cast<std::uint64_t>(input.count) << held_bits | input.held;
  [[maybe_unused]] const std::size_t begin = coded.size();
  rti::Writer(coded).varint(packed);
  assert(coded.size() - begin <= size_max);
}

std::optional<std::size_t> InputCodec::size(rti::Bytes coded) const {
  std::uint64_t packed = 0;
  const std::size_t size = get_varint(coded.first(std::min(coded.size(), size_max)), packed);
  return size > 0 ? std::optional(size) : std::nullopt;
}

bool InputCodec::decode(rti::Bytes coded, double, std::vector<std::byte>& value) const {
  std::uint64_t packed = 0;
  if (coded.size() > size_max || get_varint(coded, packed) != coded.size() || coded.empty())
    return false;
  if (packed >> held_bits > std::numeric_limits<std::uint32_t>::max()) return false;
  Input input{.count = static_cast<std::uint32_t>(packed >> held_bits),
              .held = static_cast<std::uint8_t>(packed & 15u)};
  rti::Writer writer(value);
  exchange(writer, input);
  return true;
}

bool InputCodec::encode_residual(const rti::ResidualBasis& basis, rti::Bytes value, double,
                                 rti::BitWriter& bits) const {
  Input former, input;
  if (!game::decode(basis.former, former) || !game::decode(value, input) ||
      former.held >> held_bits != 0 || input.held >> held_bits != 0)
    return false;
  const std::uint32_t more = input.count - former.count;  // modulo 2^32
  if (more > more_max) return false;
  const unsigned changed = unsigned{former.held} ^ input.held;
  bits.flag(more == 1);
  if (more != 1) bits.golomb(more, 0);
  bits.flag(std::has_single_bit(changed));
  if (std::has_single_bit(changed))
    bits.bits(static_cast<unsigned>(std::countr_zero(changed)), key_bits);
  else bits.bits(input.held, held_bits);
  return true;
}

bool InputCodec::decode_residual(const rti::ResidualBasis& basis, double, rti::BitReader& bits,
                                 std::vector<std::byte>& value) const {
  Input input;
  std::uint64_t more = 1;
  bool is_next = false, is_one = false;
  unsigned which = 0;
  if (!game::decode(basis.former, input) || !bits.flag(is_next) ||
      (!is_next && (!bits.golomb(more, 0) || more > more_max)) || !bits.flag(is_one) ||
      !bits.bits(which, is_one ? key_bits : held_bits))
    return false;
  input.count += static_cast<std::uint32_t>(more);
  input.held = static_cast<std::uint8_t>(is_one ? unsigned{input.held} ^ 1u << which : which);
  rti::Writer writer(value);
  exchange(writer, input);
  return true;
}

void InputCodec::list_fields(rti::Bytes coded, const rti::FieldVisitor& visit) const {
  visit("held", held_bits);
  visit("count", 8 * coded.size() - held_bits);
}

bool InputCodec::list_residual_fields(rti::BitReader& bits, bool,
                                      const rti::FieldVisitor& visit) const {
  const std::size_t from = bits.at();
  bool is_next = false, is_one = false;
  std::uint64_t more = 0;
  if (!bits.flag(is_next) || (!is_next && !bits.golomb(more, 0))) return false;
  visit("count", bits.at() - from);
  const unsigned size = !bits.flag(is_one) ? 0 : is_one ? key_bits : held_bits;
  if (size == 0 || !bits.skip(size)) return false;
  visit("held", 1 + size);
  return true;
}

}  // namespace rink::game
