// Processes that an MPI launcher started together: their numbers, messages between any two, and
// agreement of all by a collective.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rink::rti {

/// A message between two ranks; all ranks mean the same by a channel.
struct RankMessage {
  std::uint8_t channel = 0;
  std::vector<std::uint8_t> bytes;
};

/// This process among the ranks of MPI_COMM_WORLD. One thread uses it at a time, and there is one
/// of it in a process, once: MPI cannot begin again. An error of MPI itself ends all ranks, with
/// MPI's message. Only the constructor and `finish` wait, so that callers decide how long to wait
/// and can handle interrupts meanwhile. The thread that made it calls `finish`.
class Ranks {
 public:
  /// True if this build has MPI, which it has if MPI was found when it was configured.
  static bool is_built_in();

  /// Waits until all ranks have started. Throws TransportError if this build has no MPI.
  Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  /// Ends all other ranks too unless `finish` was called, since they would wait for this one.
  ~Ranks();

  std::uint32_t number() const { return number_; }
  std::uint32_t count() const { return count_; }

  /// Sends a message, which arrives whole, and in order between the same two ranks, whatever the
  /// channels; below 2 GiB (asserted).
  void send(std::uint32_t to, RankMessage message);
  /// The next message of `from`, if all of it has arrived.
  std::optional<RankMessage> receive(std::uint32_t from);
  /// The last one that was received of `from` is the next again, for another reader.
  void put_back(std::uint32_t from, RankMessage message);

  /// Begins a collective: all ranks contribute equally many bytes, one gathering at a time, in the
  /// same order (MPI_Iallgather).
  void begin_gathering(std::span<const std::uint8_t> own);
  /// The bytes of all ranks, in order of their numbers, once all have contributed; valid until the
  /// next gathering.
  std::optional<std::span<const std::uint8_t>> gathered();
  /// True from the beginning of a gathering until its bytes were there.
  bool is_gathering() const;

  /// Messages that are not yet on their way.
  std::size_t unsent();
  /// Call it when all ranks are done and nothing is unsent.
  void finish();
  /// Ends all ranks at once; the launcher returns `status`.
  [[noreturn]] void abort(int status);

 private:
  struct Requests;
  std::unique_ptr<Requests> requests_;
  std::uint32_t number_ = 0, count_ = 1;
};

}  // namespace rink::rti
