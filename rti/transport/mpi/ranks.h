// Processes that an MPI launcher started together: who they are, messages between any two, and
// agreement of all by a collective.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rink::rti {

/// This process among the ranks of MPI_COMM_WORLD. One thread uses it, and there is one of it in a
/// process, once: MPI cannot begin again. An error of MPI itself ends all ranks, with MPI's words.
/// Nothing here waits but the constructor and `finish`: whoever waits decides how long, and hears
/// interrupts meanwhile.
class Ranks {
 public:
  /// Whether this build knows MPI; it does if there was one when it was configured.
  static bool is_built_in();

  /// Until all are there. Throws TransportError if this build has no MPI.
  Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  /// Ends all other ranks too unless it was `finish`ed: one that is gone would be waited for.
  ~Ranks();

  std::uint32_t number() const { return number_; }
  std::uint32_t count() const { return count_; }

  /// Goes whole, and in order between the same two; below 2 GiB (asserted).
  void send(std::uint32_t to, std::vector<std::uint8_t> bytes);
  /// The next message of `from`, if it is all there.
  std::optional<std::vector<std::uint8_t>> receive(std::uint32_t from);

  /// A collective: all ranks say equally many bytes, at most once at a time, in the same order of
  /// gatherings (MPI_Iallgather).
  void begin_gathering(std::span<const std::uint8_t> own);
  /// What all said, one after the other in order of their numbers, once all have; valid until the
  /// next gathering.
  std::optional<std::span<const std::uint8_t>> gathered();

  /// Messages that are not yet on their way.
  std::size_t unsent();
  /// When all ranks are done and nothing is unsent.
  void finish();
  /// Ends all ranks at once; the launcher returns `status`.
  [[noreturn]] void abort(int status);

 private:
  struct Requests;
  std::unique_ptr<Requests> requests_;
  std::uint32_t number_ = 0, count_ = 1;
};

}  // namespace rink::rti
