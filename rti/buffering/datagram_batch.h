// The datagrams of one flush: cut once from runs of updates for all federates that receive a whole
// run, gathered record by record for others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rti/buffering/datagram_ledger.h"
#include "rti/buffering/update_runs.h"

namespace rink::rti {

/// A run in datagrams, each complete in itself: stamp, header, records, end. All but the last are
/// padded to one size.
class CutRun {
 public:
  struct Part {
    std::size_t from, to;         ///< of `bytes`
    SentRecordPool::Number sent;  ///< the objects and attributes in it
  };
  /// `part_max` [bytes] of a part. `fits` is false afterwards if one record alone takes more.
  void cut(const UpdateRun& run, std::size_t part_max, SentRecordPool& lists);
  void let_go(SentRecordPool& lists);
  bool fits = false;
  std::size_t size_max = 0;
  std::vector<Part> parts;
  std::vector<std::byte> bytes;

 private:
  void end_part(SentRecordPool& lists);
  SentRecord sent_;
};

/// Collects one destination's datagrams. Keeps its memory.
class DatagramBatch {
 public:
  /// Begins a flush: runs may have changed.
  void begin_tick();
  /// Run number `index` of the tick, cut when it is first asked for, and again for another size.
  const CutRun& cut(std::size_t index, const UpdateRun& run, std::size_t size_max);

  /// Begins a destination, whose datagrams have bodies of at most `size_max` bytes.
  void begin(std::size_t size_max);
  /// Adds the whole run. Its parts are not copied unless they are short; they must stay until the
  /// next `begin_tick`.
  void add(const CutRun& cut);
  /// Adds one record; false if it does not fit a datagram.
  bool add(std::uint16_t object_class, AttributeSet attributes, const Stamp& stamp,
           std::uint32_t handle, Bytes values);
  bool is_empty() const { return planned_.empty() && !is_open_; }

  /// Numbers them after `frames` and notes in `ledger` what they carry. Valid until the next
  /// `begin`.
  std::span<const Datagram> finish(std::uint32_t frames, DatagramLedger& ledger, double now);
  /// The records that ledgers refer to.
  SentRecordPool& lists() { return lists_; }

 private:
  struct Planned {
    Bytes shared{};                                      ///< bytes of a shared part, or
    std::size_t from = 0, to = 0;                        ///< own ones
    SentRecordPool::Number sent = SentRecordPool::none;  ///< of the shared
    bool is_short = false;  ///< the shared is, and others may still share its datagram
    std::size_t sent_from = 0, sent_to = 0;  ///< of the own
  };
  void make_room(std::size_t needed);
  void copy(Bytes body, SentRecordPool::Number sent);
  void close(bool is_full);
  void end_block();

  SentRecordPool lists_;
  std::vector<CutRun> cuts_;
  std::vector<bool> is_cut_;
  std::size_t cut_count_ = 0;

  std::size_t size_max_ = 0;
  std::vector<std::byte> bytes_, heads_;
  SentRecord sent_;
  std::vector<Planned> planned_;
  std::vector<Datagram> finished_;
  bool is_open_ = false, has_block_ = false;
  std::uint16_t block_class_ = 0;
  AttributeSet block_attributes_;
  Stamp block_stamp_;
  std::uint32_t block_last_ = 0;
};

}  // namespace rink::rti
