// The innermost loops of every matcher: one box against stretches of many, eight at a time where
// the processor can.
#pragma once

#include <cstdint>
#include <span>

#include "im/matching/projection.h"

namespace rink::im {

/// Boxes in columns. Eight more than the last are readable.
struct BoxColumns {
  const float *low_x, *low_y, *high_x, *high_y;
};

inline constexpr std::uint32_t scan_width = 8;

/// What is scanned: `before` is where the boxes were, or the same columns as `now` if all rest.
struct Candidates {
  BoxColumns before, now;
  const std::uint32_t* ids;
  std::uint32_t stride = scan_width;  ///< from eight places to the next eight: more where columns
                                      ///< are cut into blocks that lie beside each other
};

/// Places `first` to `end` of the candidates. Where the stride is not eight, whole blocks.
struct Stretch {
  std::uint32_t first, end;
};

/// One who asks; its stretches begin where those of the probe before it end.
struct Probe {
  FloatBox before, now;
  std::uint32_t id;
  std::uint32_t stretches_end;
};

/// Ids are below; found by `changes` it says that the overlap is now.
inline constexpr std::uint32_t entered_bit = 0x80000000;

enum class Verdict : std::uint8_t { no, match, entered };

/// Decides pairs whose projections tie. Not needed where all projections are exact: a tie then is
/// an overlap.
struct TieJudge {
  bool is_needed;
  Verdict (*judge)(const void* context, std::uint32_t probe_id, std::uint32_t candidate_id);
  const void* context;

  Verdict operator()(std::uint32_t probe_id, std::uint32_t candidate_id) const {
    return judge(context, probe_id, candidate_id);
  }
};

/// Probes that are answered together, and the stretches of them all.
struct ProbeBlock {
  std::span<const Probe> probes;
  const Stretch* stretches;
};

/// Where a scan writes.
struct ScanOutput {
  std::uint32_t* found;  ///< the ids of each probe's matches, in the order of its stretches; has
                         ///< room for all candidates and eight more
  std::uint32_t* ends;   ///< where those of each probe end, counted from `found`
};

/// Returns the number of matches.
using Scan = std::size_t (*)(const Candidates& candidates, const ProbeBlock& block,
                             const TieJudge& judge, const ScanOutput& output);

/// Up to eight askers, each with two places, in columns.
struct AskerGroup {
  const Candidates& askers;
  std::size_t first, count;
};

struct GroupOutput {
  std::uint64_t* work;   ///< room for two numbers per eight candidates, and two more
  std::uint32_t* found;  ///< `stride` of each asker, one after the other: room for all candidates
  std::size_t stride;
  std::uint32_t* counts;  ///< of what each of eight askers found, from zero up
};

/// What is found by a group: the id, and as the last bit whether the overlap is now.
constexpr std::uint32_t found_change(std::uint32_t id, bool is_entered) {
  return id << 1 | (is_entered ? 1u : 0u);
}

/// All askers look at all stretches, and find what `changes` finds, as `found_change`. Returns a
/// bit for each asker that found something.
using GroupScan = unsigned (*)(const Candidates& candidates, std::span<const Stretch> stretches,
                               const AskerGroup& group, const TieJudge& judge,
                               const GroupOutput& output);

/// What is asked about two boxes: whether they overlap, or whether one touches the disc that the
/// other holds (disc.h): the asker's disc, or the candidate's.
enum class Question : std::uint8_t { rectangles, of_discs, about_discs };

struct Scans {
  Scan overlaps;  ///< matches: `now` overlaps `now`
  Scan changes;   ///< matches: overlap of `before` with `before` and of `now` with `now` differ;
                  ///< with `entered_bit`
  Scan changes_of_discs,
      changes_about_discs;  ///< the same for discs; the judge must decide exactly, for it is asked
                            ///< wherever distances are in doubt
  GroupScan changes_of_group;  ///< as `changes`, several askers at a time
  const char* name;
};

/// `best` asks the processor; `sse2` is what every x86-64 processor has, and `scalar` wherever
/// there is no such path.
enum class Instructions : std::uint8_t { best, sse2, scalar };

/// The same matches in the same order, whatever is chosen.
const Scans& scans(Instructions instructions);

extern const Scans scalar_scans;
/// Null where the compiler cannot make them.
extern const Scans* const avx2_scans;

}  // namespace rink::im
