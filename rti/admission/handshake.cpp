// The next message of each end of a handshake.
#include "rti/admission/handshake.h"

#include <cassert>

#include "rti/wire/admission_messages.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

Handshake::Handshake(const SharedKey& key, Role role, std::string_view federation,
                     const Nonce& nonce)
    : key_(key), role_(role), federation_(federation), ours_(nonce) {
  assert(federation.size() <= text_max);
  if (role == Role::federate) send(HelloMessage{protocol_version, nonce, federation});
}

ProofBasis Handshake::basis() const {
  assert(theirs_);  // a proof is bound to the nonces of both ends
  return role_ == Role::federate ? ProofBasis{ours_, *theirs_, federation_}
                                 : ProofBasis{*theirs_, ours_, federation_};
}

template <class Message>
void Handshake::send(Message message) {
  const std::vector<std::byte> frame = framed(message);
  if (role_ == Role::rti && sent_ + frame.size() > received_) return;
  sent_ += frame.size();
  outgoing_.insert(outgoing_.end(), frame.begin(), frame.end());
  assert(role_ == Role::federate || sent_ <= received_);
}

void Handshake::fail(std::string_view why) {
  assert(state_ == State::going_on && !why.empty());
  state_ = State::failed;
  why_ = why;
}

void Handshake::refuse(std::string_view why) {
  fail(why);
  send(RefusedMessage{static_cast<std::uint8_t>(Refusal::not_admitted), why});
}

Handshake::State Handshake::receive(Bytes& bytes) {
  while (state_ == State::going_on && !bytes.empty()) {
    const std::size_t before = bytes.size();
    Bytes frame;
    const Framing framing = incoming_.next(bytes, frame_max_to_join, frame);
    received_ += before - bytes.size();
    if (framing != Framing::sound) fail("the other end does not speak this protocol");
    else if (!frame.empty()) handle_frame(frame);
  }
  return state_;
}

void Handshake::handle_frame(Bytes frame) {
  assert(!frame.empty());
  const auto kind = static_cast<MessageKind>(frame.front());
  const Bytes body = frame.subspan(1);
  if (role_ == Role::rti && !theirs_)
    return kind == MessageKind::hello ? handle_hello(body) : refuse("wants a key");
  if (role_ == Role::rti)
    return kind == MessageKind::proof ? handle_proof(body) : refuse("no proof");
  if (kind == MessageKind::refused) return handle_refusal(body);
  if (kind == MessageKind::challenge && !theirs_) return handle_challenge(body);
  if (kind == MessageKind::admitted && theirs_) return handle_admission(body);
  fail("the other end did not prove that it has the key");
}

void Handshake::handle_hello(Bytes body) {
  Reader reader(body);
  HelloMessage hello;
  if (!exchange(reader, hello) || (hello.version == protocol_version && !reader.is_at_end()))
    return fail("no hello");
  if (hello.version != protocol_version)
    return refuse("other version: " + std::to_string(hello.version) + ", the RTI speaks " +
                  std::to_string(protocol_version));
  if (hello.federation != federation_) return refuse("other federation");
  theirs_ = hello.nonce;
  send(ChallengeMessage{ours_});
}

void Handshake::handle_challenge(Bytes body) {
  Reader reader(body);
  ChallengeMessage challenge;
  if (!exchange(reader, challenge) || !reader.is_at_end()) return fail("no challenge");
  theirs_ = challenge.block;
  send(ProofMessage{key_.prove(role_, basis())});
}

void Handshake::handle_proof(Bytes body) {
  Reader reader(body);
  ProofMessage proof;
  if (!exchange(reader, proof) || !reader.is_at_end()) return fail("no proof");
  if (!key_.is_proven(Role::federate, basis(), proof.block)) return refuse("wrong key");
  state_ = State::proven;
  send(AdmittedMessage{key_.prove(role_, basis())});
}

void Handshake::handle_admission(Bytes body) {
  Reader reader(body);
  AdmittedMessage admitted;
  if (!exchange(reader, admitted) || !reader.is_at_end() ||
      !key_.is_proven(Role::rti, basis(), admitted.block))
    return fail("the RTI does not have this end's key");
  state_ = State::proven;
}

void Handshake::handle_refusal(Bytes body) {
  Reader reader(body);
  RefusedMessage refused;
  if (!exchange(reader, refused)) return fail("refused");
  fail("the RTI refuses us: " + std::string(refused.why));
}

}  // namespace rink::rti
