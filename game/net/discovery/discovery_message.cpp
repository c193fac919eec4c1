// Little-endian fields, then zeros up to the size that both messages have:
// "RNK?" or "RNK!"  version u8  number u64  [host u64  port u16  protocol u16  length u8  name]
#include "game/net/discovery/discovery_message.h"

#include <algorithm>
#include <cassert>
#include <string_view>

namespace rink::game {
namespace {

constexpr std::string_view query_mark = "RNK?", answer_mark = "RNK!";

/// One function for both directions would need a reader's checks in the writer; these are shorter.
class Fields {
 public:
  explicit Fields(DiscoveryBytes& bytes) : bytes_(bytes) {}
  void put(std::uint64_t value, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k)
      bytes_[at_++] = static_cast<std::byte>(value >> (8 * k) & 0xff);
  }
  void put(std::string_view text) {
    for (const char letter : text) bytes_[at_++] = static_cast<std::byte>(letter);
  }
  std::uint64_t take(std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < size; ++k)
      value |= static_cast<std::uint64_t>(bytes_[at_++]) << (8 * k);
    return value;
  }
  std::string take_text(std::size_t size) {
    std::string text;
    for (std::size_t k = 0; k < size; ++k) text += static_cast<char>(bytes_[at_++]);
    return text;
  }
  bool is_rest_zero() const {
    return std::all_of(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), bytes_.end(),
                       [](std::byte byte) { return byte == std::byte{0}; });
  }

 private:
  DiscoveryBytes& bytes_;
  std::size_t at_ = 0;
};

/// The bytes if they have the size, the mark and the version.
std::optional<DiscoveryBytes> marked(rti::Bytes bytes, std::string_view mark) {
  if (bytes.size() != discovery_size) return std::nullopt;
  DiscoveryBytes copy;
  std::copy(bytes.begin(), bytes.end(), copy.begin());
  Fields fields(copy);
  if (fields.take_text(mark.size()) != mark || fields.take(1) != discovery_version)
    return std::nullopt;
  return copy;
}

constexpr std::size_t head_size = 5;

}  // namespace

rti::MulticastGroup discovery_group() {
  return {.ipv4 = "239.255.82.75", .ipv6 = "ff02::524b", .port = 4712};
}

std::string match_name(const std::string& name) {
  std::string fit;
  for (const char letter : name) {
    const auto code = static_cast<unsigned char>(letter);
    if (code >= 0x20 && code != 0x7f) fit += letter;
  }
  std::size_t size = std::min(fit.size(), match_name_size_max);
  while (size > 0 && size < fit.size() && (static_cast<unsigned char>(fit[size]) & 0xc0) == 0x80)
    --size;
  return fit.substr(0, size);
}

DiscoveryBytes encoded(const DiscoveryQuery& query) {
  DiscoveryBytes bytes{};
  Fields fields(bytes);
  fields.put(query_mark);
  fields.put(discovery_version, 1);
  fields.put(query.number, 8);
  return bytes;
}

DiscoveryBytes encoded(const DiscoveryAnswer& answer) {
  assert(match_name(answer.name) == answer.name);
  DiscoveryBytes bytes{};
  Fields fields(bytes);
  fields.put(answer_mark);
  fields.put(discovery_version, 1);
  fields.put(answer.number, 8);
  fields.put(answer.host, 8);
  fields.put(answer.port, 2);
  fields.put(answer.protocol, 2);
  fields.put(answer.name.size(), 1);
  fields.put(answer.name);
  return bytes;
}

std::optional<DiscoveryQuery> query_of(rti::Bytes bytes) {
  std::optional<DiscoveryBytes> message = marked(bytes, query_mark);
  if (!message) return std::nullopt;
  Fields fields(*message);
  fields.take(head_size);
  const DiscoveryQuery query{fields.take(8)};
  return fields.is_rest_zero() ? std::optional(query) : std::nullopt;
}

std::optional<DiscoveryAnswer> answer_of(rti::Bytes bytes) {
  std::optional<DiscoveryBytes> message = marked(bytes, answer_mark);
  if (!message) return std::nullopt;
  Fields fields(*message);
  fields.take(head_size);
  DiscoveryAnswer answer;
  answer.number = fields.take(8);
  answer.host = fields.take(8);
  answer.port = static_cast<std::uint16_t>(fields.take(2));
  answer.protocol = static_cast<std::uint16_t>(fields.take(2));
  const std::size_t length = fields.take(1);
  if (answer.port == 0 || length > match_name_size_max) return std::nullopt;
  answer.name = fields.take_text(length);
  if (match_name(answer.name) != answer.name || !fields.is_rest_zero()) return std::nullopt;
  return answer;
}

}  // namespace rink::game
