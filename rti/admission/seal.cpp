// ChaCha20-Poly1305 by libsodium.
#include "rti/admission/seal.h"

#include <sodium.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace rink::rti {
namespace {

static_assert(seal_tag_size == crypto_aead_chacha20poly1305_IETF_ABYTES);
static_assert(std::tuple_size_v<SessionKey> == crypto_aead_chacha20poly1305_IETF_KEYBYTES);

using Number = std::array<unsigned char, crypto_aead_chacha20poly1305_IETF_NPUBBYTES>;
enum Channel : std::uint32_t { stream = 0, datagrams = 1 };

/// Channel and number, little-endian: no two messages under one key have the same.
Number number_of(std::uint32_t channel, std::uint64_t number) {
  static_assert(std::endian::native == std::endian::little);
  Number bytes;
  std::memcpy(bytes.data(), &channel, sizeof channel);
  std::memcpy(bytes.data() + sizeof channel, &number, sizeof number);
  return bytes;
}

unsigned char* raw_bytes(std::byte* bytes) { return reinterpret_cast<unsigned char*>(bytes); }
const unsigned char* raw_bytes(const std::byte* bytes) {
  return reinterpret_cast<const unsigned char*>(bytes);
}

/// Of the last `size` bytes, after which the tag follows; in place.
void seal_last(std::size_t size, const SessionKey& key, const Number& number,
               std::vector<std::byte>& bytes) {
  assert(size <= bytes.size());
  bytes.resize(bytes.size() + seal_tag_size);
  unsigned char* const start = raw_bytes(bytes.data() + bytes.size() - seal_tag_size - size);
  crypto_aead_chacha20poly1305_ietf_encrypt(start, nullptr, start, size, nullptr, 0, nullptr,
                                            number.data(), raw_bytes(key.data()));
}

bool opens(Bytes sealed, const SessionKey& key, const Number& number,
           std::vector<std::byte>& bytes) {
  if (sealed.size() < seal_tag_size) return false;
  bytes.resize(sealed.size() - seal_tag_size);
  return crypto_aead_chacha20poly1305_ietf_decrypt(raw_bytes(bytes.data()), nullptr, nullptr,
                                                   raw_bytes(sealed.data()), sealed.size(), nullptr,
                                                   0, number.data(), raw_bytes(key.data())) == 0;
}

}  // namespace

void Seal::seal(std::span<const Bytes> parts, FrameWriter& records) {
  std::size_t left = 0;
  for (const Bytes part : parts) left += part.size();
  auto part = parts.begin();
  for (Bytes rest; left > 0;) {
    const std::size_t size = std::min(left, sealed_bytes_max);
    left -= size;
    std::vector<std::byte>& record = records.begin_message(1 + size + seal_tag_size);
    record.push_back(record_mark);
    for (std::size_t wanted = size; wanted > 0;) {
      while (rest.empty()) rest = *part++;
      const Bytes taken = rest.first(std::min(rest.size(), wanted));
      record.insert(record.end(), taken.begin(), taken.end());
      rest = rest.subspan(taken.size()), wanted -= taken.size();
    }
    seal_last(size, key_, number_of(stream, records_++), record);
    records.appended();
    records.close_frame();
  }
}

void Seal::seal_datagram(const Datagram& datagram, std::vector<std::byte>& sealed) {
  const std::uint64_t number = datagrams_++;
  const auto* const bytes = reinterpret_cast<const std::byte*>(&number);
  sealed.insert(sealed.end(), bytes, bytes + sizeof number);
  sealed.insert(sealed.end(), datagram.head.begin(), datagram.head.end());
  sealed.insert(sealed.end(), datagram.body.begin(), datagram.body.end());
  seal_last(datagram.head.size() + datagram.body.size(), key_, number_of(datagrams, number),
            sealed);
}

bool SealReader::open(Bytes record, std::vector<std::byte>& bytes) {
  return !record.empty() && record.front() == record_mark &&
         opens(record.subspan(1), key_, number_of(stream, records_++), bytes);
}

bool SealReader::is_new(std::uint64_t number) const {
  return number >= next_datagram_ || (next_datagram_ - number <= window && !seen_[number % window]);
}

void SealReader::note(std::uint64_t number) {
  if (number >= next_datagram_ + window) seen_.reset();
  else
    for (; next_datagram_ < number; ++next_datagram_) seen_.reset(next_datagram_ % window);
  seen_.set(number % window);
  next_datagram_ = std::max(next_datagram_, number + 1);
}

bool SealReader::open_datagram(Bytes sealed, std::vector<std::byte>& bytes) {
  std::uint64_t number = 0;
  if (sealed.size() < datagram_seal_size) return false;
  std::memcpy(&number, sealed.data(), sizeof number);
  // The last number of all has no next.
  if (number + 1 == 0 || !is_new(number)) return false;
  if (!opens(sealed.subspan(sizeof number), key_, number_of(datagrams, number), bytes))
    return false;
  note(number);
  return true;
}

}  // namespace rink::rti
