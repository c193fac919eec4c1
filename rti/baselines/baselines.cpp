// Keyframes, acknowledgements and the encoding of blocks.
#include "rti/baselines/baselines.h"

#include <algorithm>
#include <cassert>

#include "im/basics/checked.h"
#include "rti/fom/fom.h"
#include "rti/wire/baseline_messages.h"

namespace rink::rti {

namespace {

/// Counts differences by their length: enough to choose an order by, and cheaper than trying every
/// order on every record.
using Lengths = std::array<std::uint32_t, 65>;

std::uint8_t best_order(const Lengths& lengths) {
  std::uint64_t least = ~std::uint64_t{0};
  std::uint8_t best = 0;
  for (unsigned order = 0; order <= golomb_order_max; ++order) {
    std::uint64_t bits = 0;
    for (unsigned length = 0; length < lengths.size(); ++length)
      bits += std::uint64_t{lengths[length]} *
              (order + 1 + (length > order ? 2 * (length - order) - 1 : 0));
    if (bits >= least) continue;
    least = bits;
    best = static_cast<std::uint8_t>(order);
  }
  return best;
}

/// True if `number` is one of the last `keyframe_window` up to `newest`.
bool is_recent(std::uint16_t number, std::uint16_t newest) {
  return static_cast<std::uint16_t>(newest - number) < keyframe_window;
}

}  // namespace

Baselines::Baselines(const Fom& fom, std::uint32_t keyframe_period)
    : fom_(fom), period_(std::max(keyframe_period, 1u)) {
  for (const ObjectClass& object_class : fom.object_classes())
    for (const Attribute& attribute : object_class.attributes)
      if (attribute.baselines) stride_ = std::max(stride_, attribute.baselines->fields().size());
}

const QuantisedCodec* Baselines::codec_of(const UpdateRun& run) const {
  assert(run.object_class < fom_.object_classes().size());
  if (run.attributes.count() != 1) return nullptr;
  return fom_.object_classes()[run.object_class]
      .attributes[run.attributes.front().value]
      .baselines.get();
}

void Baselines::begin(std::span<const UpdateRun> runs, std::size_t federate_slots,
                      std::uint64_t& flushes) {
  is_keyframe_ = false;
  if (stride_ == 0) return;
  assert(run_count_ == 0 && block_count_ == 0);  // the flush before has ended
  if (periodic_.size() < runs.size()) periodic_.resize(runs.size());
  if (receivers_.size() < federate_slots) receivers_.resize(federate_slots);
  run_count_ = runs.size();
  bool is_any = false;
  for (std::size_t i = 0; i < run_count_; ++i) {
    periodic_[i].codec = codec_of(runs[i]);
    if (periodic_[i].codec == nullptr) continue;
    read(runs[i], periodic_[i]);
    is_any = true;
  }
  if (!is_any || flushes++ % period_ != 0) return;
  is_keyframe_ = true;
  ++counters_.keyframes;
  ++number_;
  keyframes_.resize(keyframe_window);
  Keyframe& keyframe = keyframes_[number_ % keyframe_window];
  keyframe.number = number_;
  std::ranges::fill(keyframe.records, Keyframe::Record{});
  for (std::size_t i = 0; i < run_count_; ++i)
    if (covers(i)) keep(runs[i], periodic_[i]);
}

void Baselines::end() {
  if constexpr (checks_whole_structures) check();
  run_count_ = 0;
  block_count_ = 0;
}

void Baselines::read(const UpdateRun& run, Periodic& periodic) {
  assert(periodic.codec->fields().size() <= stride_);
  const std::size_t count = run.records.size();
  periodic.counts.resize(count * stride_);
  periodic.is_full.assign(count, false);
  QuantisedCodec::Counts counts{};
  for (std::size_t i = 0; i < count; ++i) {
    periodic.is_full[i] = !periodic.codec->read_counts(run.values(i), counts);
    std::copy_n(counts.begin(), stride_,
                periodic.counts.begin() + static_cast<std::ptrdiff_t>(i * stride_));
  }
}

void Baselines::keep(const UpdateRun& run, const Periodic& periodic) {
  assert(run.slots.size() == run.records.size());
  assert(periodic.is_full.size() == run.records.size());
  Keyframe& keyframe = keyframes_[number_ % keyframe_window];
  for (std::size_t i = 0; i < run.slots.size(); ++i) {
    const ObjectSlot slot = run.slots[i];
    if (slot >= keyframe.records.size())
      keyframe.records.resize(slot + 1), keyframe.counts.resize((slot + 1) * stride_);
    keyframe.records[slot] = {periodic.is_full[i] ? ObjectHandle::none : run.records[i].handle,
                              run.stamp.time};
    std::copy_n(periodic.counts.begin() + static_cast<std::ptrdiff_t>(i * stride_), stride_,
                keyframe.counts.begin() + static_cast<std::ptrdiff_t>(slot * stride_));
  }
}

std::optional<std::uint16_t> Baselines::usable(std::uint32_t federate) const {
  assert(federate < receivers_.size());
  const std::optional<std::uint16_t>& acknowledged = receivers_[federate].acknowledged;
  return acknowledged && is_recent(*acknowledged, number_) ? acknowledged : std::nullopt;
}

const DeltaBlock& Baselines::block(const UpdateRun& run, std::size_t index,
                                   std::uint32_t federate) {
  assert(covers(index) && periodic_[index].is_full.size() == run.records.size());
  const std::optional<std::uint16_t> keyframe = usable(federate);
  for (std::size_t i = 0; i < block_count_; ++i)
    if (blocks_[i].run == index && blocks_[i].keyframe == keyframe) return blocks_[i];
  if (block_count_ == blocks_.size()) blocks_.emplace_back();
  DeltaBlock& block = blocks_[block_count_++];
  block.run = index;
  block.keyframe = keyframe;
  encode(block, run);
  ++counters_.blocks_encoded;
  return block;
}

const Baselines::Keyframe::Record* Baselines::baseline(
    const DeltaBlock& block, const UpdateRun& run, std::size_t record,
    std::span<const std::int64_t>& counts) const {
  if (!block.keyframe || periodic_[block.run].is_full[record]) return nullptr;
  const Keyframe& keyframe = keyframes_[*block.keyframe % keyframe_window];
  const ObjectSlot slot = run.slots[record];
  // A keyframe of this flush is no federate's baseline yet, and a slot may have had another object.
  if (keyframe.number != block.keyframe || slot >= keyframe.records.size() ||
      keyframe.records[slot].object != run.records[record].handle)
    return nullptr;
  counts = std::span(keyframe.counts).subspan(slot * stride_, stride_);
  return &keyframe.records[slot];
}

void Baselines::choose_orders(DeltaBlock& block, const UpdateRun& run) const {
  const Periodic& periodic = periodic_[block.run];
  const std::size_t field_count = periodic.codec->fields().size();
  std::array<Lengths, QuantisedCodec::field_max> lengths{};
  QuantisedCodec::Counts predicted{};
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    std::span<const std::int64_t> counts;
    const Keyframe::Record* record = baseline(block, run, i, counts);
    if (record == nullptr) continue;
    block.header.has_baseline = true;
    predict(*periodic.codec, counts, run.stamp.time - record->time, predicted);
    for (std::size_t field = 0; field < field_count; ++field)
      ++lengths[field][std::bit_width(zigzag(counts_of(periodic, i)[field] - predicted[field]))];
  }
  if (!block.header.has_baseline) return;
  block.header.baseline = *block.keyframe;
  for (std::size_t field = 0; field < field_count; ++field)
    block.header.orders[field] = best_order(lengths[field]);
}

void Baselines::encode(DeltaBlock& block, const UpdateRun& run) const {
  block.header = {};
  block.message.clear();
  block.records.clear();
  block.differences.clear();
  block.difference_count = 0;
  choose_orders(block, run);
  DeltasMessage message{run.object_class};
  write(block.message, message);
  const std::size_t body = block.message.size();
  BitWriter bits(block.message);
  exchange(bits, block.header, codec(block.run).fields().size());
  std::uint32_t previous = 0;
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    write_handle(bits, previous, run.records[i].handle);
    previous = run.records[i].handle;
    const std::size_t at = bits.at();
    const bool is_difference = append_difference(bits, block, run, i);
    if (is_difference) block.differences.insert(run.slots[i]), ++block.difference_count;
    else append_absolute(bits, run, block.run, i);
    block.records.push_back({static_cast<std::uint32_t>(8 * body + at),
                             static_cast<std::uint32_t>(bits.at() - at), is_difference});
  }
  write_end(bits);
  assert(block.records.size() == run.records.size());
  assert(block.difference_count == 0 || block.header.has_baseline);
}

/// False, and nothing is written, if there is no baseline or the absolute state is not longer than
/// the difference.
bool Baselines::append_difference(BitWriter& bits, const DeltaBlock& block, const UpdateRun& run,
                                  std::size_t index) const {
  std::span<const std::int64_t> counts;
  const Keyframe::Record* record = baseline(block, run, index, counts);
  if (record == nullptr) return false;
  const Periodic& periodic = periodic_[block.run];
  QuantisedCodec::Counts predicted{}, actual{};
  predict(*periodic.codec, counts, run.stamp.time - record->time, predicted);
  std::ranges::copy(counts_of(periodic, index), actual.begin());
  BitMeasurer measurer;
  exchange_differences(measurer, *periodic.codec, block.header.orders, predicted, actual);
  if (measurer.bits() >= periodic.codec->packed_bits()) return false;
  bits.flag(false);
  return exchange_differences(bits, *periodic.codec, block.header.orders, predicted, actual);
}

void Baselines::append_absolute(BitWriter& bits, const UpdateRun& run, std::size_t index,
                                std::size_t record) const {
  assert(covers(index) && record < periodic_[index].is_full.size());
  bits.flag(true);
  append_bits(bits, run.values(record), 0,
              periodic_[index].codec->coded_bits(periodic_[index].is_full[record]));
}

std::uint64_t Baselines::known(std::uint32_t federate, std::size_t word) const {
  const std::optional<std::uint16_t> keyframe = usable(federate);
  return keyframe ? receivers_[federate].sent[*keyframe % keyframe_window].objects.word(word) : 0;
}

void Baselines::note_sent(std::uint32_t federate, std::size_t word, std::uint64_t objects) {
  assert(is_keyframe_ && federate < receivers_.size());
  Receiver& receiver = receivers_[federate];
  receiver.sent.resize(keyframe_window);
  Receiver::Sent& sent = receiver.sent[number_ % keyframe_window];
  if (sent.number != number_) {
    sent.number = number_;
    sent.objects.clear();
  }
  sent.objects.insert_word(word, objects);
}

void Baselines::acknowledge(std::uint32_t federate, std::uint16_t number) {
  Receiver* receiver = federate < receivers_.size() ? &receivers_[federate] : nullptr;
  const bool was_sent = receiver != nullptr && !receiver->sent.empty() &&
                        receiver->sent[number % keyframe_window].number == number &&
                        is_recent(number, number_);
  const bool is_newer =
      was_sent &&
      (!receiver->acknowledged || static_cast<std::int16_t>(number - *receiver->acknowledged) > 0);
  if (is_newer) receiver->acknowledged = number;
  ++(is_newer ? counters_.acknowledged : counters_.acknowledgements_ignored);
}

void Baselines::refuse(std::uint32_t federate) {
  ++counters_.refused;
  forget(federate);
}

void Baselines::forget(std::uint32_t federate) {
  if (federate < receivers_.size()) receivers_[federate] = {};
}

void Baselines::check() const {
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    [[maybe_unused]] const Keyframe& keyframe = keyframes_[i];
    assert(!keyframe.number || *keyframe.number % keyframe_window == i);
    assert(keyframe.counts.size() == keyframe.records.size() * stride_);
  }
  for (const Receiver& receiver : receivers_) {
    assert(receiver.sent.empty() || receiver.sent.size() == keyframe_window);
    assert(!receiver.acknowledged || !receiver.sent.empty());
    for (std::size_t i = 0; i < receiver.sent.size(); ++i)
      assert(!receiver.sent[i].number || *receiver.sent[i].number % keyframe_window == i);
  }
  for (std::size_t i = 0; i < block_count_; ++i)
    for (std::size_t k = 0; k < i; ++k)
      assert(blocks_[i].run != blocks_[k].run || blocks_[i].keyframe != blocks_[k].keyframe);
}

}  // namespace rink::rti
