// What each end says next.
#include "rti/admission/handshake.h"

#include <algorithm>
#include <cstring>

#include "rti/wire/admission_messages.h"
#include "rti/wire/frame.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

Handshake::Handshake(const SharedKey& key, Role role, std::string_view federation,
                     const Nonce& nonce)
    : key_(key), role_(role), federation_(federation), ours_(nonce) {
  if (role == Role::federate) say(HelloMessage{protocol_version, nonce, federation});
}

ProofBasis Handshake::basis() const {
  return role_ == Role::federate ? ProofBasis{ours_, *theirs_, federation_}
                                 : ProofBasis{*theirs_, ours_, federation_};
}

template <class Message>
void Handshake::say(Message message) {
  const auto length = static_cast<std::uint32_t>(measure(message));
  if (role_ == Role::rti && said_ + frame_header_size + length > heard_) return;
  said_ += frame_header_size + length;
  const std::size_t header = outgoing_.size();
  outgoing_.resize(header + frame_header_size);
  std::memcpy(outgoing_.data() + header, &length, frame_header_size);
  write(outgoing_, message);
}

void Handshake::fail(std::string_view why) {
  state_ = State::failed;
  why_ = why;
}

void Handshake::refuse(std::string_view why) {
  fail(why);
  say(RefusedMessage{static_cast<std::uint8_t>(Refusal::not_admitted), why});
}

Handshake::State Handshake::receive(Bytes& bytes) {
  while (state_ == State::going_on && !bytes.empty()) {
    std::uint32_t length = 0;
    if (incoming_.size() >= frame_header_size)
      std::memcpy(&length, incoming_.data(), sizeof length);
    const std::size_t wanted = frame_header_size + length;
    const Bytes taken = bytes.first(std::min(bytes.size(), wanted - incoming_.size()));
    incoming_.insert(incoming_.end(), taken.begin(), taken.end());
    bytes = bytes.subspan(taken.size());
    heard_ += taken.size();
    if (incoming_.size() == frame_header_size && length == 0) {
      std::memcpy(&length, incoming_.data(), sizeof length);
      if (length == 0 || length > frame_max_to_join) fail("the other end speaks another language");
      continue;
    }
    if (length == 0 || incoming_.size() < wanted) continue;
    take_frame(Bytes(incoming_).subspan(frame_header_size));
    incoming_.clear();
  }
  return state_;
}

void Handshake::take_frame(Bytes frame) {
  const auto kind = static_cast<MessageKind>(frame.front());
  const Bytes body = frame.subspan(1);
  if (role_ == Role::rti && !theirs_)
    return kind == MessageKind::hello ? take_hello(body) : refuse("wants a key");
  if (role_ == Role::rti) return kind == MessageKind::proof ? take_proof(body) : refuse("no proof");
  if (kind == MessageKind::refused) return take_refusal(body);
  if (kind == MessageKind::challenge && !theirs_) return take_challenge(body);
  if (kind == MessageKind::admitted && theirs_) return take_admission(body);
  fail("the other end didn't prove that it has the key");
}

void Handshake::take_hello(Bytes body) {
  Reader reader(body);
  HelloMessage hello;
  if (!exchange(reader, hello) || (hello.version == protocol_version && !reader.is_at_end()))
    return fail("no hello");
  if (hello.version != protocol_version)
    return refuse("other version: " + std::to_string(hello.version) + ", the RTI speaks " +
                  std::to_string(protocol_version));
  if (hello.federation != federation_) return refuse("other federation");
  theirs_ = hello.nonce;
  say(ChallengeMessage{ours_});
}

void Handshake::take_challenge(Bytes body) {
  Reader reader(body);
  ChallengeMessage challenge;
  if (!exchange(reader, challenge) || !reader.is_at_end()) return fail("no challenge");
  theirs_ = challenge.block;
  say(ProofMessage{key_.prove(role_, basis())});
}

void Handshake::take_proof(Bytes body) {
  Reader reader(body);
  ProofMessage proof;
  if (!exchange(reader, proof) || !reader.is_at_end()) return fail("no proof");
  if (!key_.is_proven(Role::federate, basis(), proof.block)) return refuse("wrong key");
  state_ = State::proven;
  say(AdmittedMessage{key_.prove(role_, basis())});
}

void Handshake::take_admission(Bytes body) {
  Reader reader(body);
  AdmittedMessage admitted;
  if (!exchange(reader, admitted) || !reader.is_at_end() ||
      !key_.is_proven(Role::rti, basis(), admitted.block))
    return fail("the RTI doesn't have our key");
  state_ = State::proven;
}

void Handshake::take_refusal(Bytes body) {
  Reader reader(body);
  RefusedMessage refused;
  if (!exchange(reader, refused)) return fail("refused");
  fail("the RTI refuses us: " + std::string(refused.why));
}

}  // namespace rink::rti
