// The message between peers when one of them is gone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/division.h"
#include "game/peer/messages.h"

namespace rink::peer {

/// Whether a peer hears one of which somebody hears nothing more.
enum class Answer : std::uint8_t {
  open,  ///< it waits for a word of that one
  missed,
  heard
};
struct Question {
  PeerNumber peer = 0;
  Answer answer = Answer::open;
  friend bool operator==(const Question&, const Question&) = default;
};

/// A digest of what all peers have agreed on: the state at a step (`round` 0), or a round of words
/// that each of them said to all after it.
struct Mark {
  std::uint64_t step = 0;
  std::uint32_t round = 0;
  std::uint64_t digest = 0;
};

/// A peer's message after a loss: its last step, all lost peers that it knows of, and its answers
/// about those that may be lost.
struct Loss {
  std::uint64_t word = 0x73736f4c6b6e6952ULL;  ///< marks the message: "RinkLoss"
  std::uint64_t step = 0;
  std::vector<PeerNumber> gone{};
  std::vector<PeerNumber> finished{};  ///< of these, those that left in good order
  std::vector<Question> questions{};   ///< by peer
  std::vector<Mark> marks{};           ///< the last ones
};

template <class Stream>
bool exchange(Stream& stream, Question& question) {
  return stream.number(question.peer) && stream.choice(question.answer, Answer::heard);
}

template <class Stream>
bool exchange(Stream& stream, Mark& mark) {
  return stream.numbers(mark.step, mark.round, mark.digest);
}

template <class Stream>
bool exchange(Stream& stream, Loss& loss) {
  return stream.number(loss.word) && loss.word == Loss{}.word && stream.number(loss.step) &&
         stream.number_list(loss.gone) && stream.number_list(loss.finished) &&
         exchange_list(stream, loss.questions) && exchange_list(stream, loss.marks);
}
std::vector<std::uint8_t> written(Loss message);
bool read(std::span<const std::uint8_t> bytes, Loss& message);

}  // namespace rink::peer
