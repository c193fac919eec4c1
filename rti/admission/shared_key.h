// A key that both ends have, and proofs of having it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "rti/admission/seal.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

using Nonce = std::array<std::byte, 32>;  ///< drawn at random for one conversation
using Proof = std::array<std::byte, 32>;

/// From the operating system's generator, as keys are.
Nonce draw_nonce();

/// The end that makes a proof: the two ends' proofs differ, so a proof cannot be sent back to its
/// maker.
enum class Role : std::uint8_t { federate = 1, rti = 2 };

/// The data that a proof is bound to: both ends' nonces, so that an old proof is invalid, and the
/// federation, so that a proof for another federation is.
struct ProofBasis {
  Nonce federate{}, rti{};
  std::string_view federation;  ///< at most 255 bytes
};

/// Made of the secret by scrypt (RFC 7914) with N = 2^15, r = 8, p = 1: who guesses secrets needs
/// 32 MiB and some 0.1 s for each. Proofs and session keys are BLAKE2b keyed with it, 32 bytes
/// (libsodium's generichash), compared in constant time. The key is never sent.
class SharedKey {
 public:
  static constexpr std::size_t secret_size_min = 16;  ///< bytes
  /// Throws std::invalid_argument if the secret is shorter than `secret_size_min`.
  explicit SharedKey(Bytes secret);
  /// The file's bytes without white space at its end. Throws std::runtime_error, which names the
  /// file and what is wrong, as that others than its owner may read or write it.
  static SharedKey load(const std::filesystem::path& file);

  Proof prove(Role role, const ProofBasis& basis) const;
  bool is_proven(Role role, const ProofBasis& basis, const Proof& proof) const;
  /// The key under which `sender` seals what it says in the conversation of `basis`.
  SessionKey session_key(Role sender, const ProofBasis& basis) const;

 private:
  std::array<std::byte, 32> derive(std::string_view purpose, Role role,
                                   const ProofBasis& basis) const;

  std::array<std::byte, 32> key_;
};

}  // namespace rink::rti
