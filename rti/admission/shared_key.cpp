// Keyed BLAKE2b by libsodium.
#include "rti/admission/shared_key.h"

#include <sodium.h>

#include <cassert>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "rti/wire/message.h"

namespace rink::rti {

namespace {

const unsigned char* raw(const std::byte* bytes) {
  return reinterpret_cast<const unsigned char*>(bytes);
}
unsigned char* raw(std::byte* bytes) { return reinterpret_cast<unsigned char*>(bytes); }

/// Prefix of the hashed text, so that a proof for another purpose or of another version is never
/// valid here.
constexpr std::string_view purpose = "rink admission 1";

void hash(crypto_generichash_state& state, Bytes bytes) {
  crypto_generichash_update(&state, raw(bytes.data()), bytes.size());
}

}  // namespace

Nonce draw_nonce() {
  if (sodium_init() < 0) throw std::runtime_error("no source of random numbers");
  Nonce nonce;
  randombytes_buf(nonce.data(), nonce.size());
  return nonce;
}

SharedKey::SharedKey(Bytes secret) {
  if (sodium_init() < 0) throw std::runtime_error("no source of random numbers");
  if (secret.size() < secret_size_min)
    throw std::invalid_argument("a key needs at least " + std::to_string(secret_size_min) +
                                " bytes, not " + std::to_string(secret.size()));
  crypto_generichash(raw(key_.data()), key_.size(), raw(secret.data()), secret.size(), nullptr, 0);
}

SharedKey SharedKey::load(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string secret((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream) throw std::runtime_error("can't read the key file " + file.string());
  secret.erase(secret.find_last_not_of(" \t\r\n") + 1);
  try {
    return SharedKey(std::as_bytes(std::span(secret)));
  } catch (const std::invalid_argument& trouble) {
    throw std::runtime_error(file.string() + ": " + trouble.what() +
                             "; make one with: head -c 32 /dev/urandom | base64 > " +
                             file.string());
  }
}

Proof SharedKey::prove(Role role, const ProofBasis& basis) const {
  assert(basis.federation.size() <= text_max);
  Proof proof;
  crypto_generichash_state state;
  crypto_generichash_init(&state, raw(key_.data()), key_.size(), proof.size());
  hash(state, std::as_bytes(std::span(purpose)));
  const std::array<std::byte, 4> head{static_cast<std::byte>(role),
                                      static_cast<std::byte>(protocol_version),
                                      static_cast<std::byte>(protocol_version >> 8),
                                      static_cast<std::byte>(basis.federation.size())};
  hash(state, head);
  hash(state, basis.federate);
  hash(state, basis.rti);
  hash(state, std::as_bytes(std::span(basis.federation)));
  crypto_generichash_final(&state, raw(proof.data()), proof.size());
  return proof;
}

bool SharedKey::is_proven(Role role, const ProofBasis& basis, const Proof& proof) const {
  const Proof expected = prove(role, basis);
  return sodium_memcmp(expected.data(), proof.data(), proof.size()) == 0;
}

}  // namespace rink::rti
