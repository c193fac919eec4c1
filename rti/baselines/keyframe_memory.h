// The keyframes that a federate received and keeps, to which later differences refer.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rink::rti {

/// Keyframes that an RTI may refer to: those of the last so many numbers.
inline constexpr std::uint16_t keyframe_window = 32;

/// The last few keyframes, each with the counts of its objects. Its memory follows what was sent
/// since the oldest keyframe that the RTI still refers to.
class KeyframeMemory {
 public:
  /// An object's state at a keyframe.
  struct Baseline {
    double time = 0.0;  ///< of the stamp under which it was sent [s]
    std::span<const std::int64_t> counts;
  };

  /// Begins a keyframe; records added until `seal` belong to it.
  void begin(std::uint16_t number);
  bool is_open() const { return open_.has_value(); }
  void add(std::uint32_t object, double time, std::span<const std::int64_t> counts);
  /// Completes the keyframe that was begun, if any, and gives its number.
  std::optional<std::uint16_t> seal();
  /// Nothing if the object or the keyframe is not known. Valid until the next call of another
  /// member. Fastest in ascending order of objects.
  std::optional<Baseline> find(std::uint16_t number, std::uint32_t object);
  /// The RTI will not refer to a keyframe before this one any more.
  void drop_before(std::uint16_t number);
  std::size_t memory_bytes() const;
  /// Asserts that sealed keyframes are in order and at the places of their numbers.
  void check() const;

 private:
  struct Record {
    std::uint32_t object = 0, at = 0, count = 0;  ///< counts from `at` on
    double time = 0.0;
  };
  struct Keyframe {
    std::optional<std::uint16_t> number;
    std::vector<Record> records;  ///< by object once sealed
    std::vector<std::int64_t> counts;
    std::size_t next = 0;  ///< where the last look-up ended
  };
  Keyframe& place_of(std::uint16_t number) { return keyframes_[number % keyframe_window]; }
  void clear(Keyframe& keyframe);

  std::vector<Keyframe> keyframes_;  ///< none before the first is begun
  /// Memory of cleared keyframes. The next one to begin takes it, so a federate touches as much as
  /// is referred to and not a window of 32 in turn.
  std::vector<Keyframe> spare_;
  std::optional<std::uint16_t> open_;
};

}  // namespace rink::rti
