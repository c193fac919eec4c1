// Periodic state at the RTI: keyframes that all receivers share, which federate has acknowledged
// which, and blocks of differences that are encoded once for all federates with the same keyframe.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rti/baselines/baseline_counters.h"
#include "rti/baselines/delta_bits.h"
#include "rti/baselines/keyframe_memory.h"
#include "rti/buffering/update_runs.h"
#include "rti/objects/bitmap.h"

namespace rink::rti {

/// A run of periodic state encoded for the federates that have acknowledged one keyframe, or none.
struct DeltaBlock {
  struct Record {
    std::uint32_t at = 0, size = 0;  ///< bits in `message`, after the step to its handle
    bool is_difference = false;
  };
  std::size_t run = 0;
  std::optional<std::uint16_t> keyframe;
  DeltaHeader header;
  std::vector<std::byte> message;  ///< as it is sent
  std::vector<Record> records;     ///< as in the run
  Bitmap differences;              ///< slots whose record is one
  std::size_t difference_count = 0;
};

/// One for a federation execution. A flush is `begin`, any number of looks at blocks for each
/// federate, `end`. Costs nothing where no attribute has baselines.
class Baselines {
 public:
  /// Every `keyframe_period`-th flush with periodic state is a keyframe: the more often, the nearer
  /// the baselines and the more acknowledgements.
  Baselines(const Fom& fom, std::uint32_t keyframe_period);

  /// `flushes` counts those with periodic state that the same federates receive.
  void begin(std::span<const UpdateRun> runs, std::size_t federate_slots, std::uint64_t& flushes);
  void end();
  /// True if the run is sent as differences to baselines.
  bool covers(std::size_t run) const { return run < run_count_ && periodic_[run].codec != nullptr; }
  /// The keyframe that this flush is, if it is one.
  std::optional<std::uint16_t> keyframe() const {
    return is_keyframe_ ? std::optional(number_) : std::nullopt;
  }

  /// The block for `federate` of a run that is covered, before it is cut to its interest.
  const DeltaBlock& block(const UpdateRun& run, std::size_t index, std::uint32_t federate);
  /// 64 objects from 64 * `word` on of which `federate` has the baseline that its blocks refer to.
  std::uint64_t known(std::uint32_t federate, std::size_t word) const;
  /// Notes that these objects' records of this keyframe go to `federate`.
  void note_sent(std::uint32_t federate, std::size_t word, std::uint64_t objects);
  /// The encoding of a record whose baseline the federate lacks.
  void append_absolute(BitWriter& bits, const UpdateRun& run, std::size_t index,
                       std::size_t record) const;
  const QuantisedCodec& codec(std::size_t run) const {
    assert(covers(run));
    return *periodic_[run].codec;
  }

  void acknowledge(std::uint32_t federate, std::uint16_t number);
  /// The federate lacks a baseline: it gets absolute states until it acknowledges a keyframe that
  /// is yet to come.
  void refuse(std::uint32_t federate);
  /// Another federate takes the slot.
  void forget(std::uint32_t federate);

  /// Asserts that keyframes and what federates were sent of them are at the places of their
  /// numbers, and that no block exists twice.
  void check() const;
  const BaselineCounters& counters() const { return counters_; }
  BaselineCounters& counters() { return counters_; }

 private:
  /// The latest state of each object at one keyframe, by slot.
  struct Keyframe {
    struct Record {
      std::uint32_t object = ObjectHandle::none;
      double time = 0.0;
    };
    std::optional<std::uint16_t> number;
    std::vector<Record> records;
    std::vector<std::int64_t> counts;  ///< `stride_` for each slot
  };
  /// What a federate was sent and has acknowledged.
  struct Receiver {
    struct Sent {
      std::optional<std::uint16_t> number;
      Bitmap objects;
    };
    std::vector<Sent> sent;  ///< by number, going round; none before the first
    std::optional<std::uint16_t> acknowledged;
  };
  /// The counts of a run's records.
  struct Periodic {
    const QuantisedCodec* codec = nullptr;  ///< null: sent without baselines
    std::vector<std::int64_t> counts;       ///< `stride_` for each record
    std::vector<bool> is_full;              ///< by record: some of it is out of its range
  };

  const QuantisedCodec* codec_of(const UpdateRun& run) const;
  void read(const UpdateRun& run, Periodic& periodic);
  void keep(const UpdateRun& run, const Periodic& periodic);
  std::optional<std::uint16_t> usable(std::uint32_t federate) const;
  const Keyframe::Record* baseline(const DeltaBlock& block, const UpdateRun& run,
                                   std::size_t record, std::span<const std::int64_t>& counts) const;
  void choose_orders(DeltaBlock& block, const UpdateRun& run) const;
  void encode(DeltaBlock& block, const UpdateRun& run) const;
  bool append_difference(BitWriter& bits, const DeltaBlock& block, const UpdateRun& run,
                         std::size_t record) const;
  std::span<const std::int64_t> counts_of(const Periodic& periodic, std::size_t record) const {
    assert(record < periodic.is_full.size());
    return std::span(periodic.counts).subspan(record * stride_, periodic.codec->fields().size());
  }

  const Fom& fom_;
  std::uint32_t period_;
  std::size_t stride_ = 0;  ///< most fields of any attribute that has baselines; 0: none has
  std::uint16_t number_ = 0;
  bool is_keyframe_ = false;
  std::vector<Keyframe> keyframes_;  ///< by number, going round
  std::vector<Receiver> receivers_;  ///< by federate slot
  std::vector<Periodic> periodic_;   ///< by run
  std::size_t run_count_ = 0;
  std::vector<DeltaBlock> blocks_;  ///< of this flush
  std::size_t block_count_ = 0;
  BaselineCounters counters_;
};

}  // namespace rink::rti
