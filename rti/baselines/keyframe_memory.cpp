// Records in the order of their objects, so that a block of neighbours walks through them.
#include "rti/baselines/keyframe_memory.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "im/basics/checked.h"

namespace rink::rti {

void KeyframeMemory::clear(Keyframe& keyframe) {
  keyframe.number.reset();
  keyframe.next = 0;
  if (keyframe.records.empty()) return;
  keyframe.records.clear();
  keyframe.counts.clear();
  spare_.push_back(std::exchange(keyframe, {}));
}

void KeyframeMemory::begin(std::uint16_t number) {
  if (open_) seal();
  keyframes_.resize(keyframe_window);
  Keyframe& keyframe = place_of(number);
  clear(keyframe);
  if (!spare_.empty()) {
    keyframe = std::move(spare_.back());
    spare_.pop_back();
  }
  assert(keyframe.records.empty() && keyframe.counts.empty() && !keyframe.number);
  open_ = number;
}

void KeyframeMemory::add(std::uint32_t object, double time, std::span<const std::int64_t> counts) {
  assert(open_);
  Keyframe& keyframe = place_of(*open_);
  keyframe.records.push_back({object, static_cast<std::uint32_t>(keyframe.counts.size()),
                              static_cast<std::uint32_t>(counts.size()), time});
  keyframe.counts.insert(keyframe.counts.end(), counts.begin(), counts.end());
}

std::optional<std::uint16_t> KeyframeMemory::seal() {
  if (!open_) return std::nullopt;
  Keyframe& keyframe = place_of(*open_);
  const auto by_object = [](const Record& a, const Record& b) { return a.object < b.object; };
  if (!std::ranges::is_sorted(keyframe.records, by_object))
    std::ranges::stable_sort(keyframe.records, by_object);
  keyframe.number = open_;
  open_.reset();
  if constexpr (checks_whole_structures) check();
  return keyframe.number;
}

void KeyframeMemory::check() const {
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    const Keyframe& keyframe = keyframes_[i];
    if (!keyframe.number) continue;
    assert(*keyframe.number % keyframe_window == i);
    assert(std::ranges::is_sorted(keyframe.records, {}, &Record::object));
    assert(keyframe.next <= keyframe.records.size());
    for ([[maybe_unused]] const Record& each : keyframe.records)
      assert(std::size_t{each.at} + each.count <= keyframe.counts.size());
  }
  for ([[maybe_unused]] const Keyframe& each : spare_) assert(each.records.empty() && !each.number);
}

std::optional<KeyframeMemory::Baseline> KeyframeMemory::find(std::uint16_t number,
                                                             std::uint32_t object) {
  if (keyframes_.empty()) return std::nullopt;
  Keyframe& keyframe = place_of(number);
  if (keyframe.number != number) return std::nullopt;
  const std::vector<Record>& records = keyframe.records;
  const auto is_last_of = [&](std::size_t at) {
    return at < records.size() && records[at].object == object &&
           (at + 1 == records.size() || records[at + 1].object != object);
  };
  if (!is_last_of(keyframe.next)) {
    const auto beyond = std::ranges::upper_bound(
        records, object, {},
        &Record::object);  // an object that was sent twice is as it was sent last
    keyframe.next = beyond == records.begin()
                        ? records.size()
                        : static_cast<std::size_t>(beyond - records.begin()) - 1;
    if (!is_last_of(keyframe.next)) return std::nullopt;
  }
  const Record& record = records[keyframe.next++];
  return Baseline{record.time, std::span(keyframe.counts).subspan(record.at, record.count)};
}

void KeyframeMemory::drop_before(std::uint16_t number) {
  for (Keyframe& each : keyframes_)
    if (each.number && static_cast<std::int16_t>(*each.number - number) < 0) clear(each);
}

std::size_t KeyframeMemory::memory_bytes() const {
  std::size_t sum = keyframes_.capacity() * sizeof(Keyframe);
  for (const std::vector<Keyframe>* all : {&keyframes_, &spare_})
    for (const Keyframe& each : *all)
      sum +=
          each.records.capacity() * sizeof(Record) + each.counts.capacity() * sizeof(std::int64_t);
  return sum + spare_.capacity() * sizeof(Keyframe);
}

}  // namespace rink::rti
