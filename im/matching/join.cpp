// Finds the stretches for a block of probes, then scans them: the first loads of the one hide
// behind each other, the second runs over what has arrived.
#include "im/matching/join.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace rink::im {
namespace {

constexpr std::size_t block_size = 32;

}  // namespace

void Join::Part::clear() {
  candidate_count = 0;
  askers.clear(), found.clear(), ends.clear();
}

void Join::clear() { own_.clear(); }

template <class Index, class Askers, class Find>
void Join::Part::add(const Index& index, const Slice<Askers>& slice, const TieJudge& judge,
                     Scan scan, const Find& find) {
  const auto& [all, begin, end] = slice;
  assert(begin <= end && end <= all.size());
  const Candidates candidates = index.candidates();
  std::array<Probe, block_size> probes;
  std::array<std::uint32_t, block_size> block_ends;
  std::size_t place = askers.size();
  askers.resize(place + end - begin);
  ends.resize(place + end - begin);
  for (std::size_t first = begin; first < end; first += block_size) {
    const std::size_t count = std::min(block_size, end - first);
    stretches.clear();
    std::size_t block_candidates = 0;
    for (std::size_t i = 0; i < count; ++i) {
      probes[i] = all.probe(first + i);
      block_candidates += find(probes[i], stretches);
      probes[i].stretches_end = static_cast<std::uint32_t>(stretches.size());
    }
    candidate_count += block_candidates;
    const std::size_t found_before = found.size();
    found.reserve(found_before + block_candidates + 8);
    const std::size_t found_now = scan(candidates, {{probes.data(), count}, stretches.data()},
                                       judge, {found.data() + found_before, block_ends.data()});
    assert(found_now <= block_candidates && block_ends[count - 1] == found_now);
    found.resize(found_before + found_now);
    for (std::size_t i = 0; i < count; ++i, ++place) {
      askers[place] = probes[i].id;
      ends[place] = found_before + block_ends[i];
    }
  }
  assert(place == askers.size());
}

void Join::Part::append(const Part& other) {
  const std::size_t found_before = found.size(), place = askers.size();
  candidate_count += other.candidate_count;
  found.resize(found_before + other.found.size());
  std::copy(other.found.span().begin(), other.found.span().end(), found.data() + found_before);
  askers.resize(place + other.askers.size());
  std::copy(other.askers.span().begin(), other.askers.span().end(), askers.data() + place);
  ends.resize(place + other.ends.size());
  for (std::size_t i = 0; i < other.ends.size(); ++i)
    ends[place + i] = found_before + other.ends[i];
  assert(ends.size() == askers.size());
  assert(ends.empty() || ends[ends.size() - 1] == found.size());
}

template <class Index, class Askers, class Find>
void Join::add(const Index& index, const Askers& askers, const TieJudge& judge, Scan scan,
               const Find& find) {
  const std::size_t count = askers.size(), middle = worker_ ? count / 2 : count;
  if (middle == count) return own_.add(index, Slice<Askers>{askers, 0, count}, judge, scan, find);
  other_.clear();
  run_both(
      worker_,
      [&] {
        own_.add(index, Slice<Askers>{askers, 0, middle}, judge, scan, find);
      },
      [&] {
        other_.add(index, Slice<Askers>{askers, middle, count}, judge, scan, find);
      });
  own_.append(other_);
}

void Join::add_overlaps(const BoxIndex& index, const BoxIndex& askers, const TieJudge& judge) {
  add(index, askers, judge, scans_.overlaps, [&](const Probe& probe, Buffer<Stretch>& stretches) {
    return index.find_overlaps(probe.now, stretches);
  });
}

template <class Index, class Askers>
void Join::add_changes(const Index& index, const Askers& askers, const TieJudge& judge,
                       Question question) {
  if (question == Question::of_discs)
    return add(index, askers, judge, scans_.changes_of_discs,
               [&](const Probe& probe, Buffer<Stretch>& stretches) {
                 return index.find_disc_changes(probe, stretches);
               });
  // A subscription that lies inside of a box has its disc there too, so what rectangles leave out
  // may be left out of discs.
  const Scan scan = question == Question::rectangles ? scans_.changes : scans_.changes_about_discs;
  add(index, askers, judge, scan, [&](const Probe& probe, Buffer<Stretch>& stretches) {
    return index.find_changes(probe, stretches);
  });
}

template void Join::add_changes(const BoxIndex&, const BoxIndex&, const TieJudge&, Question);
template void Join::add_changes(const BoxIndex&, const ProbeList&, const TieJudge&, Question);
template void Join::add_changes(const LiveIndex&, const ProbeList&, const TieJudge&, Question);

std::size_t Join::Part::bytes() const {
  return sizeof(Stretch) * stretches.capacity() +
         sizeof(std::uint32_t) * (askers.capacity() + found.capacity()) +
         sizeof(std::size_t) * ends.capacity();
}

std::size_t Join::bytes() const { return own_.bytes() + other_.bytes(); }

}  // namespace rink::im
