// Cutting and gathering datagrams.
#include "rti/buffering/datagram_batch.h"

#include <algorithm>

#include "rti/wire/update_block.h"

namespace rink::rti {

namespace {

/// Stamp, block header with two numbers of at most 5 bytes, the zero that ends the block.
constexpr std::size_t block_overhead_max = StampMessage::size_max + 1 + 5 + 5 + 1;
constexpr std::size_t step_max = 5;

void begin_block(std::vector<std::byte>& bytes, std::uint16_t object_class, AttributeSet attributes, const Stamp& stamp) {
  StampMessage stamped{stamp};
  write(bytes, stamped);
  UpdatesMessage header{object_class, attributes.bits};
  write(bytes, header);
}

void put_record(std::vector<std::byte>& bytes, std::uint32_t& last, std::uint32_t handle, Bytes values) {
  std::uint64_t step = handle_step(last, handle);
  Writer(bytes).varint(step);
  last = handle;
  bytes.insert(bytes.end(), values.begin(), values.end());
}

}  // namespace

void CutRun::cut(const UpdateRun& run, std::size_t part_max) {
  size_max = part_max;
  parts.clear();
  bytes.clear();
  handles.clear();
  fits = true;
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    const Bytes values = run.values(i);
    if (block_overhead_max + step_max + values.size() > size_max) {
      fits = false;
      return;
    }
    const bool is_full = !parts.empty() && bytes.size() - parts.back().from + step_max + values.size() + 1 > size_max;
    if (is_full) {
      bytes.resize(parts.back().from + size_max);  // zeros: the end of the block, of the messages, and padding
      parts.back().to = bytes.size();
      parts.back().last = handles.size();
    }
    if (is_full || parts.empty()) {
      parts.push_back({bytes.size(), 0, handles.size(), 0});
      begin_block(bytes, run.object_class, run.attributes, run.stamp);
      last = 0;
    }
    put_record(bytes, last, run.records[i].handle, values);
    handles.push_back(run.records[i].handle);
  }
  if (parts.empty()) return;
  bytes.push_back(std::byte{0});
  parts.back().to = bytes.size();
  parts.back().last = handles.size();
}

const CutRun& DatagramBatch::cut(std::size_t index, const UpdateRun& run, std::size_t size_max) {
  if (cut_count_ == 0) is_cut_.assign(is_cut_.size(), false);
  if (index >= cuts_.size()) {
    cuts_.resize(index + 1);
    is_cut_.resize(index + 1);
  }
  if (!is_cut_[index] || cuts_[index].size_max != size_max) {
    cuts_[index].cut(run, size_max);
    is_cut_[index] = true;
    ++cut_count_;
  }
  return cuts_[index];
}

void DatagramBatch::begin(std::size_t size_max) {
  size_max_ = size_max;
  bytes_.clear();
  said_.clear();
  planned_.clear();
  is_open_ = has_block_ = false;
}

void DatagramBatch::open() {
  planned_.push_back({.shared = {}, .from = bytes_.size(), .to = 0, .attributes = {}, .handles = {}, .said_from = said_.size(), .said_to = 0});
  is_open_ = true;
}

void DatagramBatch::end_block() {
  if (has_block_) bytes_.push_back(std::byte{0});
  has_block_ = false;
}

void DatagramBatch::close(bool is_full) {
  if (!is_open_) return;
  end_block();
  Planned& own = planned_.back();
  if (is_full) bytes_.resize(own.from + size_max_);
  own.to = bytes_.size();
  own.said_to = said_.size();
  is_open_ = false;
}

void DatagramBatch::carry(AttributeSet attributes, std::span<const std::uint32_t> handles) {
  said_.push_back(attributes.bits);
  said_.push_back(static_cast<std::uint32_t>(handles.size()));
  said_.insert(said_.end(), handles.begin(), handles.end());
}

void DatagramBatch::add(const CutRun& cut, AttributeSet attributes) {
  for (const CutRun::Part& part : cut.parts) {
    const Bytes body = Bytes(cut.bytes).subspan(part.from, part.to - part.from);
    const auto handles = std::span(cut.handles).subspan(part.first, part.last - part.first);
    // A short one shares its datagram with others; a long one is its own, and not copied.
    const bool is_short = 2 * body.size() < size_max_;
    if (!is_short) {
      close(false);
      planned_.push_back({.shared = body, .from = 0, .to = 0, .attributes = attributes, .handles = handles, .said_from = 0, .said_to = 0});
      continue;
    }
    if (is_open_ && bytes_.size() - planned_.back().from + body.size() + 1 > size_max_) close(true);
    if (!is_open_) open();
    end_block();
    bytes_.insert(bytes_.end(), body.begin(), body.end());
    carry(attributes, handles);
  }
}

bool DatagramBatch::add(std::uint16_t object_class, AttributeSet attributes, const Stamp& stamp, std::uint32_t handle, Bytes values) {
  if (block_overhead_max + step_max + values.size() > size_max_) return false;
  const bool continues = has_block_ && block_class_ == object_class && block_attributes_ == attributes && block_stamp_ == stamp;
  const std::size_t needed = step_max + values.size() + 1 + (continues ? 0 : block_overhead_max);
  if (is_open_ && bytes_.size() - planned_.back().from + needed > size_max_) close(true);
  if (!is_open_) open();
  if (!has_block_ || !continues) {
    end_block();
    begin_block(bytes_, object_class, attributes, stamp);
    carry(attributes, {});
    has_block_ = true;
    block_class_ = object_class;
    block_attributes_ = attributes;
    block_stamp_ = stamp;
    block_last_ = 0;
    block_count_ = said_.size() - 1;
  }
  put_record(bytes_, block_last_, handle, values);
  said_.push_back(handle);
  ++said_[block_count_];
  return true;
}

std::span<const Datagram> DatagramBatch::finish(std::uint32_t frames, DatagramLedger& ledger, double now) {
  close(false);
  heads_.clear();
  finished_.clear();
  for (const Planned& each : planned_) {
    DatagramHead head{ledger.begin(now), frames};
    Writer writer(heads_);
    exchange(writer, head);
    if (!each.shared.empty()) ledger.carry(each.attributes, each.handles);
    for (std::size_t i = each.said_from; i < each.said_to; i += 2 + said_[i + 1]) ledger.carry(AttributeSet(said_[i]), std::span(said_).subspan(i + 2, said_[i + 1]));
  }
  for (std::size_t i = 0; i < planned_.size(); ++i) {
    const Planned& each = planned_[i];
    finished_.push_back({Bytes(heads_).subspan(i * DatagramHead::size, DatagramHead::size), each.shared.empty() ? Bytes(bytes_).subspan(each.from, each.to - each.from) : each.shared});
  }
  return finished_;
}

}  // namespace rink::rti
