// One varint of the count above and the keys that are held below.
#include "game/replication/input_codec.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "game/replication/attributes.h"
#include "im/basics/varint.h"

namespace rink::game {
namespace {

constexpr unsigned held_bits = 4;
constexpr std::size_t size_max = 6;  ///< of 36 bits

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

}  // namespace rink::game
