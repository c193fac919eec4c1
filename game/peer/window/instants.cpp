// Reads in the journal of a run what came at one instant.
#include "game/peer/window/instants.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "game/peer/window/claim_trace.h"

namespace rink::peer {

namespace {

using Entries = std::span<const physics::Change>;

/// Calls `visit(time, entries)` for each counted event of the run. One without entries has own
/// bodies alone, which are at home.
template <class Visit>
void visit_counted(const physics::Journal& journal, Visit&& visit) {
  assert(journal.counted.size() == journal.times.size());
  const std::vector<physics::Change>& changes = journal.changes;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < journal.counted.size(); ++k) {
    while (begin < changes.size() && changes[begin].event < journal.counted[k]) ++begin;
    std::size_t end = begin;
    while (end < changes.size() && changes[end].event == journal.counted[k]) ++end;
    visit(journal.times[k], Entries(changes).subspan(begin, end - begin));
    begin = end;
  }
}

bool is_own(const Share& share, Entries entries) {
  return entries.empty() || std::ranges::any_of(entries, [&](const physics::Change& change) {
           return share.owns(change.body);
         });
}

/// Each event of the whole has one peer that owns its first body.
bool is_led(const Share& share, Entries entries) {
  return entries.empty() || share.owns(std::ranges::min(entries, {}, &physics::Change::body).body);
}

std::uint64_t digest_of(const physics::Change& change) {
  std::uint64_t digest = change.body;
  const auto mix = [&](std::uint64_t word) {
    digest = (digest ^ word) * 0x9e3779b97f4a7c15ULL, digest ^= digest >> 31;
  };
  mix(change.conditions);
  for (const double number : {change.time, change.x, change.y, change.vx, change.vy, change.since})
    mix(std::bit_cast<std::uint64_t>(number));
  return digest;
}

std::size_t count_between(const std::vector<double>& sorted, double low, double high) {
  return static_cast<std::size_t>(std::ranges::upper_bound(sorted, high) -
                                  std::ranges::lower_bound(sorted, low));
}

/// Instants with more than `usual` of these events; what is nearer to each other than the margin is
/// one.
std::vector<CriticalInstant> crowds(const std::vector<double>& sorted, std::uint64_t usual) {
  std::vector<CriticalInstant> found;
  for (std::size_t k = 0, first = 0; k < sorted.size(); ++k) {
    while (physics::most_at_once(std::array{sorted[first], sorted[k]}) < 2 && first < k) ++first;
    const std::uint64_t count = k - first + 1;
    if (count <= usual) continue;
    const bool is_new =
        found.empty() || sorted[k] > found.back().time + instant_margin(found.back().time);
    if (is_new) found.push_back({sorted[first], count, false});
    else found.back().events = std::max(found.back().events, count);
  }
  return found;
}

}  // namespace

double instant_margin(double time) {
  return std::max(time_margin,
                  64.0 * std::numeric_limits<double>::epsilon() * (1.0 + std::abs(time)));
}

RunInstants instants_of(const Share& share, std::uint64_t usual) {
  const physics::Journal& journal = share.subdomain().journal();
  std::vector<double> own, all = journal.times;
  visit_counted(journal, [&](double time, Entries entries) {
    if (is_own(share, entries)) own.push_back(time);
  });
  std::ranges::sort(own), std::ranges::sort(all);
  const auto own_around = [&](double time) {
    const double margin = instant_margin(time);
    return count_between(own, time - margin, time + 2.0 * margin);
  };
  RunInstants found{physics::most_at_once(own), crowds(own, usual)};
  // The run itself has counted as if events had come without end.
  for (const CriticalInstant& one : crowds(all, physics::events_at_once_local - 1))
    if (own_around(one.time) > 0) found.critical.push_back({one.time, one.events, false});
  for (const double time : journal.unsolved)
    if (const std::size_t count = own_around(time); count > 0)
      found.critical.push_back({time, count, true});
  std::ranges::sort(found.critical, {}, &CriticalInstant::time);
  return found;
}

std::vector<InstantReport> reports_on(const Share& share, std::span<const AskedInstant> asked) {
  assert(std::ranges::is_sorted(asked, {}, &AskedInstant::low));
  std::vector<InstantReport> reports(asked.size());
  if (asked.empty()) return reports;
  visit_counted(share.subdomain().journal(), [&](double time, Entries entries) {
    const auto next = std::ranges::upper_bound(asked, time, {}, &AskedInstant::low);
    if (next == asked.begin() || time > (next - 1)->high) return;
    InstantReport& report = reports[static_cast<std::size_t>(next - 1 - asked.begin())];
    ++report.events;
    report.own += is_own(share, entries), report.led += is_led(share, entries);
    for (const physics::Change& change : entries) report.digest += digest_of(change);
  });
  return reports;
}

}  // namespace rink::peer
