// Finds the stretches for a block of probes, then scans them: the first loads of the one hide behind each other, the second runs over what has arrived.
#include "im/matching/join.h"

#include <array>

namespace rink::im {
namespace {

constexpr std::size_t block_size = 32;

}  // namespace

void Join::clear() {
  candidate_count_ = 0;
  askers_.clear(), found_.clear(), ends_.clear();
}

template <class Index, class Askers, class Find>
void Join::add(const Index& index, const Askers& askers, const TieJudge& judge, Scan scan, const Find& find) {
  const Candidates candidates = index.candidates();
  std::array<Probe, block_size> probes;
  std::array<std::uint32_t, block_size> ends;
  const std::size_t old_count = askers_.size();
  askers_.resize(old_count + askers.size());
  ends_.resize(old_count + askers.size());
  for (std::size_t first = 0; first < askers.size(); first += block_size) {
    const std::size_t count = std::min(block_size, askers.size() - first);
    stretches_.clear();
    std::size_t block_candidates = 0;
    for (std::size_t i = 0; i < count; ++i) {
      probes[i] = askers.probe(first + i);
      block_candidates += find(probes[i], stretches_);
      probes[i].stretches_end = static_cast<std::uint32_t>(stretches_.size());
    }
    candidate_count_ += block_candidates;
    const std::size_t found_before = found_.size();
    found_.reserve(found_before + block_candidates + 8);
    const std::size_t found = scan(candidates, {probes.data(), count}, stretches_.data(), judge, found_.data() + found_before, ends.data());
    found_.resize(found_before + found);
    for (std::size_t i = 0; i < count; ++i) {
      askers_[old_count + first + i] = probes[i].id;
      ends_[old_count + first + i] = found_before + ends[i];
    }
  }
}

void Join::add_overlaps(const BoxIndex& index, const BoxIndex& askers, const TieJudge& judge) {
  add(index, askers, judge, scans_.overlaps, [&](const Probe& probe, Buffer<Stretch>& stretches) { return index.find_overlaps(probe.now, stretches); });
}

template <class Index, class Askers>
void Join::add_changes(const Index& index, const Askers& askers, const TieJudge& judge) {
  add(index, askers, judge, scans_.changes, [&](const Probe& probe, Buffer<Stretch>& stretches) { return index.find_changes(probe, stretches); });
}

template void Join::add_changes(const BoxIndex&, const BoxIndex&, const TieJudge&);
template void Join::add_changes(const BoxIndex&, const ProbeList&, const TieJudge&);
template void Join::add_changes(const LiveIndex&, const ProbeList&, const TieJudge&);

std::size_t Join::bytes() const {
  return sizeof(Stretch) * stretches_.capacity() + sizeof(std::uint32_t) * (askers_.capacity() + found_.capacity()) + sizeof(std::size_t) * ends_.capacity();
}

}  // namespace rink::im
