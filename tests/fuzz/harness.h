// What is fuzzed: one function for each reader of bytes from elsewhere, run by libFuzzer and, over
// the kept corpus, by a test.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>

#include "rti/wire/bytes.h"

namespace rink::fuzz {

/// What every reader of bytes from elsewhere owes: it takes any bytes at all, and refuses what is
/// malformed.
struct Harness {
  const char* name;
  /// Returns if the reader did with `input` what it promises, aborts or trips a sanitizer if not.
  void (*run)(rti::Bytes input);
  /// Hands the reader `input` and then what is malformed whatever came before it, in each way that
  /// the reader knows. Returns if all of that was refused: a connection dropped, a value or file
  /// turned away, nothing of it taken.
  void (*refuse)(rti::Bytes input);
};

/// Of the RTI, of the game and of interest management, all lists one after the other.
std::span<const Harness> rti_harnesses();
std::span<const Harness> game_harnesses();
std::span<const Harness> im_harnesses();

/// Stands in all builds, unlike an assertion.
inline void require(bool rest_contacts, const char* what) {
  if (rest_contacts) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// Takes numbers and parts off the front of an input; zeros and nothing once it is used up.
class Input {
 public:
  explicit Input(rti::Bytes bytes) : bytes_(bytes) {}
  bool is_empty() const { return bytes_.empty(); }
  unsigned byte() {
    if (bytes_.empty()) return 0;
    const auto value = static_cast<unsigned>(bytes_.front());
    bytes_ = bytes_.subspan(1);
    return value;
  }
  rti::Bytes part(std::size_t size) {
    const rti::Bytes part = bytes_.first(std::min(size, bytes_.size()));
    bytes_ = bytes_.subspan(part.size());
    return part;
  }
  rti::Bytes rest() { return part(bytes_.size()); }

 private:
  rti::Bytes bytes_;
};

inline std::string text_of(rti::Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace rink::fuzz
