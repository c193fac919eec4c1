// Lies about any field of any message, made from the function that writes the message: a new field
// is lied about without being named here.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/session/loss.h"
#include "game/peer/session/scoring.h"
#include "game/peer/session/session_state.h"
#include "game/peer/standby/part_record.h"
#include "game/peer/verdict_tree.h"
#include "game/physics/snapshot_stream.h"
#include "im/basics/byte_stream.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {

/// The messages that a session's mail carries.
enum class MessageKind : std::uint8_t {
  loss,
  entry,
  verdict,
  claims,
  handover,
  face_off,
  record,
  piece,
  bundle,
  none
};
inline constexpr std::array kind_names{
    "Loss",        "Entry",      "Verdict",       "Claims",        "Handover",
    "FaceOffWord", "PartRecord", "SnapshotPiece", "VerdictBundle", "nothing"};

/// A field as a message writes it: the `size` lowest bytes of `value`.
struct Word {
  std::uint64_t value = 0;
  int size = 0;
};

/// Collects the fields of a message.
class WordList : public ByteStream<WordList> {
 public:
  static constexpr bool is_reading = true;  // fields that it changes are seen by exchange()
  /// `longer`: a field that becomes one more on its way, so that a list gets one more element.
  explicit WordList(std::optional<std::size_t> longer = {}) : longer_(longer) {}
  bool part(std::uint64_t& value, std::size_t size) {
    if (longer_ == words_.size()) ++value;
    words_.push_back({value, static_cast<int>(size)});
    return true;
  }
  /// Each of its bytes is a field.
  template <class Number>
  bool varint(Number& number) {
    std::array<std::byte, varint_size_max> bytes{};
    put_varint(bytes.data(), number);
    std::size_t size = 0;
    for (std::uint64_t byte = 0x80; byte >= 0x80 && size < bytes.size(); ++size) {
      byte = static_cast<std::uint64_t>(bytes[size]);
      part(byte, 1);
      bytes[size] = static_cast<std::byte>(byte);
    }
    return ByteReader(std::span(bytes).first(size)).varint(number);
  }
  static bool check(bool is_sound) { return is_sound; }
  static std::uint64_t count_max() { return 1 << 20; }
  const std::vector<Word>& words() const { return words_; }

 private:
  std::optional<std::size_t> longer_;
  std::vector<Word> words_;
};

/// A message in fields.
struct Fields {
  MessageKind kind = MessageKind::none;
  std::vector<Word> words;
  std::size_t checksum_size = 8;
  /// How many fields one element takes of the list whose length this field is; 0: it is none.
  std::function<std::size_t(std::size_t field)> element_size;

  std::vector<std::uint8_t> bytes() const {
    std::vector<std::uint8_t> all;
    for (const Word& word : words)
      for (int byte = 0; byte < word.size; ++byte)
        all.push_back(static_cast<std::uint8_t>(word.value >> (8 * byte)));
    physics::add_checksum(all, checksum_size);
    return all;
  }
};

template <class Message>
bool take_fields(std::span<const std::uint8_t> bytes, MessageKind kind, std::size_t checksum_size,
                 Message message, Fields& fields) {
  if (!read(bytes, message)) return false;
  WordList list;
  exchange(list, message);
  fields.kind = kind, fields.words = list.words(), fields.checksum_size = checksum_size;
  fields.element_size = [message, count = list.words().size()](std::size_t field) -> std::size_t {
    WordList longer(field);
    Message copy = message;
    exchange(longer, copy);
    return longer.words().size() > count ? longer.words().size() - count : 0;
  };
  return true;
}

inline Fields fields_of(std::span<const std::uint8_t> bytes, const physics::Field& rink) {
  Fields fields;
  take_fields(bytes, MessageKind::loss, 8, Loss{}, fields) ||
      take_fields(bytes, MessageKind::entry, 8, Entry{.state = {.cuts = Cuts::whole(rink)}},
                  fields) ||
      take_fields(bytes, MessageKind::verdict, 4, Verdict{}, fields) ||
      take_fields(bytes, MessageKind::claims, 4, Claims{}, fields) ||
      take_fields(bytes, MessageKind::handover, 4, Handover{}, fields) ||
      take_fields(bytes, MessageKind::face_off, 8, FaceOffWord{}, fields) ||
      take_fields(bytes, MessageKind::record, 4, PartRecord{}, fields) ||
      take_fields(bytes, MessageKind::piece, 4, SnapshotPiece{}, fields) ||
      take_fields(bytes, MessageKind::bundle, 4, VerdictBundle{}, fields);
  return fields;
}

/// Ways in which a field can be wrong.
enum class Wrong : std::uint8_t {
  zero,
  most,
  one_more,
  one_less,
  other_peer,
  out_of_range,
  no_number,
  infinite,
  reversed,
  nudged,     ///< by a billionth
  later,      ///< by a window
  swapped,    ///< with the next of its size
  stale,      ///< as in the last message of this kind
  repeated,   ///< of a list: its last element comes twice
  dropped,    ///< of a list: its last element is left out
  exchanged,  ///< of a list: its first two elements change places
  unsaid,     ///< the whole message
  twice
};
inline constexpr std::array wrong_names{
    "zero",  "most",     "one more", "one less",  "another peer", "out of range",
    "NaN",   "inf",      "reversed", "nudged",    "later",        "swapped",
    "stale", "repeated", "dropped",  "exchanged", "unsaid",       "twice"};
static_assert(wrong_names.size() == static_cast<std::size_t>(Wrong::twice) + 1);

/// One lie: in a field, counted on from the first after the last.
class Lie {
 public:
  Lie(std::size_t field, Wrong wrong, std::uint64_t other_peer)
      : field_(field), wrong_(wrong), other_peer_(other_peer) {}

  /// How often it is said.
  int copies() const { return wrong_ == Wrong::unsaid ? 0 : wrong_ == Wrong::twice ? 2 : 1; }
  /// False, with nothing changed, if this message cannot be wrong so. `last`: the last message of
  /// this kind, if there was one.
  bool spoil(Fields& fields, const Fields& last) const {
    if (copies() != 1) return true;
    if (fields.words.empty()) return false;
    const std::size_t field = field_ % fields.words.size();
    if (wrong_ >= Wrong::repeated) return spoil_list(fields, field);
    Word& word = fields.words[field];
    const std::uint64_t was = word.value;
    if (wrong_ == Wrong::swapped) return swap(fields, field);
    const std::uint64_t all = word.size == 8 ? ~std::uint64_t{0} : (1ULL << (8 * word.size)) - 1;
    word.value = (word.size == 8   ? wrong_real(was)
                  : word.size == 4 ? wrong_single(was)
                                   : wrong_count(was)) &
                 all;
    if (wrong_ == Wrong::stale && field < last.words.size() && last.words[field].size == word.size)
      word.value = last.words[field].value;
    return word.value != was;
  }

 private:
  std::uint64_t wrong_count(std::uint64_t was) const {
    switch (wrong_) {
      case Wrong::zero:
        return 0;
      case Wrong::most:
        return ~std::uint64_t{0};
      case Wrong::one_more:
        return was + 1;
      case Wrong::one_less:
        return was - 1;
      case Wrong::other_peer:
        return other_peer_;
      case Wrong::out_of_range:
        return 4'000'000'000;
      case Wrong::reversed:
        return was ^ 1;
      default:
        return was;
    }
  }
  std::uint64_t wrong_single(std::uint64_t was) const {
    const float value = std::bit_cast<float>(static_cast<std::uint32_t>(was));
    switch (wrong_) {
      case Wrong::no_number:
        return std::bit_cast<std::uint32_t>(std::nanf(""));
      case Wrong::infinite:
        return std::bit_cast<std::uint32_t>(HUGE_VALF);
      case Wrong::nudged:
        return std::bit_cast<std::uint32_t>(value * (1.0f + 1e-6f));
      case Wrong::later:
        return std::bit_cast<std::uint32_t>(value + 0.01f);
      default:
        return wrong_count(was);
    }
  }
  std::uint64_t wrong_real(std::uint64_t was) const {
    const double value = std::bit_cast<double>(was);
    switch (wrong_) {
      case Wrong::out_of_range:
        return std::bit_cast<std::uint64_t>(1e300);
      case Wrong::no_number:
        return std::bit_cast<std::uint64_t>(std::nan(""));
      case Wrong::infinite:
        return std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
      case Wrong::reversed:
        return std::bit_cast<std::uint64_t>(-value);
      case Wrong::nudged:
        return std::bit_cast<std::uint64_t>(value * (1.0 + 1e-9));
      case Wrong::later:
        return std::bit_cast<std::uint64_t>(value + 0.01);
      default:
        return wrong_count(was);
    }
  }
  static bool swap(Fields& fields, std::size_t field) {
    Word& word = fields.words[field];
    for (std::size_t k = field + 1; k < fields.words.size(); ++k)
      if (fields.words[k].size == word.size && fields.words[k].value != word.value)
        return std::swap(fields.words[k].value, word.value), true;
    return false;
  }
  bool spoil_list(Fields& fields, std::size_t field) const {
    const int length_size = fields.words[field].size;
    const std::size_t size = length_size == 1 || length_size == 4 ? fields.element_size(field) : 0;
    const auto count = static_cast<std::size_t>(fields.words[field].value);
    std::vector<Word>& words = fields.words;
    if (size == 0 || count == 0 || count > 100 || field + 1 + count * size > words.size())
      return false;
    const auto first = words.begin() + static_cast<std::ptrdiff_t>(field + 1),
               last = first + static_cast<std::ptrdiff_t>((count - 1) * size),
               end = last + static_cast<std::ptrdiff_t>(size);
    if (wrong_ == Wrong::exchanged) {
      if (count < 2) return false;
      return std::swap_ranges(first, first + static_cast<std::ptrdiff_t>(size),
                              first + static_cast<std::ptrdiff_t>(size)),
             true;
    }
    if (wrong_ == Wrong::dropped) {
      --words[field].value;
      words.erase(last, end);
      return true;
    }
    ++words[field].value;
    const std::vector<Word> copy(last, end);
    words.insert(end, copy.begin(), copy.end());
    return true;
  }

  std::size_t field_;
  Wrong wrong_;
  std::uint64_t other_peer_;
};

}  // namespace rink::peer::test
