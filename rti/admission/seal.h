// What is sent between two ends that have proven their key, encrypted and authenticated.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

#include "rti/wire/frame.h"

namespace rink::rti {

/// Of one conversation and direction.
using SessionKey = std::array<std::byte, 32>;

inline constexpr std::size_t seal_tag_size = 16;
inline constexpr std::size_t sealed_bytes_max = 16 * 1024;  ///< in one record
/// What a record begins with: a frame's head is not told from an older one by sealed bytes.
inline constexpr std::byte record_mark{1};
inline constexpr std::size_t seal_record_max = 1 + sealed_bytes_max + seal_tag_size;
/// What a seal adds to a datagram [bytes].
inline constexpr std::size_t datagram_seal_size = sizeof(std::uint64_t) + seal_tag_size;

/// The sender's end of one direction: ChaCha20-Poly1305 (RFC 8439) by libsodium, under a number
/// that no two records share.
class Seal {
 public:
  explicit Seal(const SessionKey& key) : key_(key) {}

  /// Appends the parts, one after the other, as records: frames of sealed bytes.
  void seal(std::span<const Bytes> parts, FrameWriter& records);
  /// Appends one datagram with its number before it.
  void seal_datagram(const Datagram& datagram, std::vector<std::byte>& sealed);

 private:
  SessionKey key_;
  std::uint64_t records_ = 0, datagrams_ = 0;
};

/// The receiver's end.
class SealReader {
 public:
  explicit SealReader(const SessionKey& key) : key_(key) {}

  /// Gives the bytes of the next record; false if it is not the next that the other end sealed.
  /// After that nothing of the stream can be believed.
  bool open(Bytes record, std::vector<std::byte>& bytes);
  /// The same of a datagram, in any order; false as well if it has come before, or is older than
  /// the last 1,024.
  bool open_datagram(Bytes sealed, std::vector<std::byte>& bytes);

 private:
  static constexpr std::size_t window = 1024;
  bool is_new(std::uint64_t number) const;
  void note(std::uint64_t number);

  SessionKey key_;
  std::uint64_t records_ = 0;
  std::uint64_t next_datagram_ = 0;  ///< one more than the greatest number so far
  std::bitset<window> seen_;         ///< by number modulo the window: those before the next
};

}  // namespace rink::rti
