// The form of a saved federation in a file.
#include "rti/save/saved_federation.h"

#include <algorithm>

#include "im/basics/fnv_hash.h"

namespace rink::rti {

namespace {

constexpr std::string_view magic = "RINKSAVE";
constexpr std::uint32_t version = 1;
constexpr std::size_t head_size = 8 + 4 + 8 + 8;

std::uint64_t hash_of_bytes(Bytes bytes) {
  return hash_of(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace

std::vector<std::byte> encoded(SavedFederation& saved) {
  std::vector<std::byte> bytes(head_size), head;
  Writer writer(bytes);
  saved.keep(writer);
  const Bytes content = Bytes(bytes).subspan(head_size);
  Writer head_writer(head);
  Bytes kind = std::as_bytes(std::span(magic));
  std::uint32_t number = version;
  std::uint64_t size = content.size(), hash = hash_of_bytes(content);
  head_writer.rest(kind, kind.size());
  head_writer.number(number);
  head_writer.numbers(size, hash);
  std::ranges::copy(head, bytes.begin());
  return bytes;
}

std::string decode(Bytes bytes, SavedFederation& saved) {
  Reader reader(bytes);
  Bytes kind;
  std::uint32_t number = 0;
  std::uint64_t size = 0, hash = 0;
  if (!reader.rest(kind, magic.size()) ||
      std::string_view(reinterpret_cast<const char*>(kind.data()), kind.size()) != magic)
    return "it is no saved federation";
  if (!reader.number(number)) return "it is torn: its head is not whole";
  if (number != version)
    return "it is of version " + std::to_string(number) + "; expected is version " +
           std::to_string(version);
  if (!reader.numbers(size, hash)) return "it is torn: its head is not whole";
  if (size != reader.left())
    return "it is torn: it has " + std::to_string(reader.left()) + " of " + std::to_string(size) +
           " bytes";
  if (hash_of_bytes(reader.rest()) != hash) return "it is damaged: its hash is another";
  if (!saved.keep(reader) || !reader.is_at_end()) return "it is damaged: it cannot be read";
  return {};
}

}  // namespace rink::rti
