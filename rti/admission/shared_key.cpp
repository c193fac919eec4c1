// scrypt and keyed BLAKE2b by libsodium.
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

/// Prefixes of what is hashed, so that nothing that is made for another purpose or by another
/// version is valid here.
constexpr std::string_view of_keys = "rink key 2", of_proofs = "rink admission 2",
                           of_sessions = "rink session 2";

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
  const Bytes salt = std::as_bytes(std::span(of_keys));
  constexpr std::uint64_t cost = 1 << 15;
  if (crypto_pwhash_scryptsalsa208sha256_ll(raw(secret.data()), secret.size(), raw(salt.data()),
                                            salt.size(), cost, 8, 1, raw(key_.data()),
                                            key_.size()) != 0)
    throw std::runtime_error("no memory for the key: it takes 32 MiB");
}

SharedKey SharedKey::load(const std::filesystem::path& file) {
  using std::filesystem::perms;
  std::error_code error;
  const perms granted = std::filesystem::status(file, error).permissions();
  constexpr perms of_others =
      perms::group_read | perms::group_write | perms::others_read | perms::others_write;
  if (!error && (granted & of_others) != perms::none)
    throw std::runtime_error(file.string() + ": others may read or write this key; chmod 600 " +
                             file.string());
  std::ifstream stream(file, std::ios::binary);
  std::string secret((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream) throw std::runtime_error("can't read the key file " + file.string());
  secret.erase(secret.find_last_not_of(" \t\r\n") + 1);
  try {
    return SharedKey(std::as_bytes(std::span(secret)));
  } catch (const std::invalid_argument& trouble) {
    throw std::runtime_error(file.string() + ": " + trouble.what() +
                             "; make one with: (umask 077; head -c 32 /dev/urandom | base64 > " +
                             file.string() + ")");
  }
}

std::array<std::byte, 32> SharedKey::derive(std::string_view purpose, Role role,
                                            const ProofBasis& basis) const {
  assert(basis.federation.size() <= text_max);
  std::array<std::byte, 32> derived;
  crypto_generichash_state state;
  crypto_generichash_init(&state, raw(key_.data()), key_.size(), derived.size());
  hash(state, std::as_bytes(std::span(purpose)));
  const std::array<std::byte, 4> head{static_cast<std::byte>(role),
                                      static_cast<std::byte>(protocol_version),
                                      static_cast<std::byte>(protocol_version >> 8),
                                      static_cast<std::byte>(basis.federation.size())};
  hash(state, head);
  hash(state, basis.federate);
  hash(state, basis.rti);
  hash(state, std::as_bytes(std::span(basis.federation)));
  crypto_generichash_final(&state, raw(derived.data()), derived.size());
  return derived;
}

Proof SharedKey::prove(Role role, const ProofBasis& basis) const {
  return derive(of_proofs, role, basis);
}

SessionKey SharedKey::session_key(Role sender, const ProofBasis& basis) const {
  return derive(of_sessions, sender, basis);
}

bool SharedKey::is_proven(Role role, const ProofBasis& basis, const Proof& proof) const {
  const Proof expected = prove(role, basis);
  return sodium_memcmp(expected.data(), proof.data(), proof.size()) == 0;
}

}  // namespace rink::rti
