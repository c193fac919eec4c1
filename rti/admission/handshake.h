// One handshake in which both ends prove that they have the same key.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rti/admission/shared_key.h"
#include "rti/wire/frame.h"

namespace rink::rti {

/// Hello, challenge, proof, proof. No I/O and no clock: bytes in, bytes out. The RTI's end never
/// sends more bytes than it received; it sends nothing instead.
class Handshake {
 public:
  enum class State : std::uint8_t {
    going_on,
    proven,  ///< the other end has the key
    failed,  ///< it has not, or sent something else: send what is left and close
  };
  /// `key` must outlive it. `nonce` must never have been used before. A federate's end has
  /// something to send at once.
  Handshake(const SharedKey& key, Role role, std::string_view federation, const Nonce& nonce);

  State state() const { return state_; }
  /// After `failed`: a sentence for a user.
  const std::string& why() const { return why_; }
  /// Takes no more than the handshake's bytes from the front of `bytes`, which may be cut anywhere;
  /// what is left after the proof is sealed.
  State receive(Bytes& bytes);
  /// After `proven`: the key under which `sender` seals what follows.
  SessionKey session_key(Role sender) const { return key_.session_key(sender, basis()); }
  Bytes outgoing() const { return outgoing_; }
  void clear_outgoing() { outgoing_.clear(); }

 private:
  void handle_frame(Bytes frame);
  void handle_hello(Bytes body);
  void handle_proof(Bytes body);
  void handle_challenge(Bytes body);
  void handle_admission(Bytes body);
  void handle_refusal(Bytes body);
  template <class Message>
  void send(Message message);
  void refuse(std::string_view why);
  void fail(std::string_view why);
  ProofBasis basis() const;

  const SharedKey& key_;
  Role role_;
  std::string federation_;
  Nonce ours_;
  std::optional<Nonce> theirs_;
  State state_ = State::going_on;
  std::string why_;
  FrameReader incoming_;
  std::vector<std::byte> outgoing_;
  std::size_t received_ = 0, sent_ = 0;  ///< bytes in all
};

}  // namespace rink::rti
