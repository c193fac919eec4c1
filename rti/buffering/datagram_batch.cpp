// Cuts runs into datagrams and gathers records for each destination.
#include "rti/buffering/datagram_batch.h"

#include <algorithm>
#include <cassert>

#include "rti/wire/update_block.h"

namespace rink::rti {

namespace {

/// Stamp, block header with two numbers of at most 5 bytes, the zero that ends the block.
constexpr std::size_t block_overhead_max = StampMessage::size_max + 1 + 5 + 5 + 1;
constexpr std::size_t step_max = 5;

void begin_block(std::vector<std::byte>& bytes, std::uint16_t object_class, AttributeSet attributes,
                 const Stamp& stamp) {
  StampMessage stamped{stamp};
  write(bytes, stamped);
  UpdatesMessage header{object_class, attributes.bits};
  write(bytes, header);
}

void put_record(std::vector<std::byte>& bytes, std::uint32_t& last, std::uint32_t handle,
                Bytes values) {
  write_handle(bytes, last, handle);
  last = handle;
  bytes.insert(bytes.end(), values.begin(), values.end());
}

}  // namespace

void CutRun::let_go(SentRecordPool& lists) {
  for (const Part& part : parts)
    if (part.sent != SentRecordPool::none) lists.release(part.sent);
  parts.clear();
}

void CutRun::end_part(SentRecordPool& lists) {
  assert(!parts.empty() && bytes.size() - parts.back().from <= size_max);
  sent_.end_group();
  parts.back().to = bytes.size();
  parts.back().sent = lists.add(sent_.groups());
}

void CutRun::cut(const UpdateRun& run, std::size_t part_max, SentRecordPool& lists) {
  assert(part_max > 0);
  let_go(lists);
  size_max = part_max;
  bytes.clear();
  fits = true;
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    const Bytes values = run.values(i);
    if (block_overhead_max + step_max + values.size() > size_max) {
      fits = false;
      return;
    }
    const bool is_full = !parts.empty() &&
                         bytes.size() - parts.back().from + step_max + values.size() + 1 > size_max;
    if (is_full) {
      bytes.resize(parts.back().from +
                   size_max);  // zeros: the end of the block, of the messages, and padding
      end_part(lists);
    }
    if (is_full || parts.empty()) {
      parts.push_back({bytes.size(), 0, SentRecordPool::none});
      sent_.clear();
      sent_.begin_group(run.attributes);
      begin_block(bytes, run.object_class, run.attributes, run.stamp);
      last = 0;
    }
    put_record(bytes, last, run.records[i].handle, values);
    sent_.add(run.records[i].handle);
  }
  if (parts.empty()) return;
  bytes.push_back(std::byte{0});
  end_part(lists);
}

void DatagramBatch::begin_tick() {
  for (CutRun& each : cuts_) each.let_go(lists_);
  cut_count_ = 0;
}

const CutRun& DatagramBatch::cut(std::size_t index, const UpdateRun& run, std::size_t size_max) {
  if (cut_count_ == 0) is_cut_.assign(is_cut_.size(), false);
  if (index >= cuts_.size()) {
    cuts_.resize(index + 1);
    is_cut_.resize(index + 1);
  }
  if (!is_cut_[index] || cuts_[index].size_max != size_max) {
    cuts_[index].cut(run, size_max, lists_);
    is_cut_[index] = true;
    ++cut_count_;
  }
  return cuts_[index];
}

void DatagramBatch::begin(std::size_t size_max) {
  size_max_ = size_max;
  bytes_.clear();
  sent_.clear();
  planned_.clear();
  is_open_ = has_block_ = false;
}

/// Opens a datagram of our own unless one is open that has room for `needed` more bytes.
void DatagramBatch::make_room(std::size_t needed) {
  assert(needed <= size_max_);
  if (is_open_ && bytes_.size() - planned_.back().from + needed > size_max_) close(true);
  if (is_open_) return;
  const Planned last = planned_.empty() ? Planned{} : planned_.back();
  const bool continues = last.is_short && last.shared.size() + needed <= size_max_;
  if (continues) planned_.pop_back();
  Planned own;
  own.from = bytes_.size();
  own.sent_from = sent_.groups().size();
  planned_.push_back(own);
  is_open_ = true;
  if (continues) copy(last.shared, last.sent);
  assert(bytes_.size() - planned_.back().from + needed <= size_max_);
}

void DatagramBatch::copy(Bytes body, SentRecordPool::Number sent) {
  assert(is_open_);
  end_block();
  bytes_.insert(bytes_.end(), body.begin(), body.end());
  sent_.append(lists_.groups(sent));
}

void DatagramBatch::end_block() {
  if (has_block_) bytes_.push_back(std::byte{0});
  sent_.end_group();
  has_block_ = false;
}

void DatagramBatch::close(bool is_full) {
  if (!is_open_) return;
  end_block();
  Planned& own = planned_.back();
  if (is_full) bytes_.resize(own.from + size_max_);
  own.to = bytes_.size();
  assert(own.to - own.from <= size_max_);
  own.sent_to = sent_.groups().size();
  is_open_ = false;
}

void DatagramBatch::add(const CutRun& cut) {
  assert(cut.fits && cut.size_max <= size_max_);
  for (const CutRun::Part& part : cut.parts) {
    const Bytes body = Bytes(cut.bytes).subspan(part.from, part.to - part.from);
    // A short part shares its datagram with its neighbours; a long one is a datagram of its own.
    // Nothing is copied of a part that stays alone.
    const bool is_short = 2 * body.size() < size_max_,
               follows_short = is_open_ || (!planned_.empty() && planned_.back().is_short);
    if (is_short && follows_short) {
      make_room(body.size() + 1);
      copy(body, part.sent);
      continue;
    }
    close(false);
    planned_.push_back({.shared = body,
                        .from = 0,
                        .to = 0,
                        .sent = part.sent,
                        .is_short = is_short,
                        .sent_from = 0,
                        .sent_to = 0});
  }
}

bool DatagramBatch::add(std::uint16_t object_class, AttributeSet attributes, const Stamp& stamp,
                        std::uint32_t handle, Bytes values) {
  if (block_overhead_max + step_max + values.size() > size_max_) return false;
  const bool continues = has_block_ && block_class_ == object_class &&
                         block_attributes_ == attributes && block_stamp_ == stamp;
  const std::size_t needed = step_max + values.size() + 1 + (continues ? 0 : block_overhead_max);
  make_room(needed);
  if (!has_block_ || !continues) {
    end_block();
    begin_block(bytes_, object_class, attributes, stamp);
    sent_.begin_group(attributes);
    has_block_ = true;
    block_class_ = object_class;
    block_attributes_ = attributes;
    block_stamp_ = stamp;
    block_last_ = 0;
  }
  put_record(bytes_, block_last_, handle, values);
  sent_.add(handle);
  assert(bytes_.size() - planned_.back().from < size_max_);  // the block's end has room
  return true;
}

std::span<const Datagram> DatagramBatch::finish(std::uint32_t frames, DatagramLedger& ledger,
                                                double now) {
  close(false);
  heads_.clear();
  finished_.clear();
  for (const Planned& each : planned_) {
    const bool is_own = each.sent == SentRecordPool::none;
    if (!is_own) lists_.hold(each.sent);
    const SentRecordPool::Number sent =
        is_own ? lists_.add(sent_.groups().subspan(each.sent_from, each.sent_to - each.sent_from))
               : each.sent;
    DatagramHead head{ledger.note(now, sent), frames};
    Writer writer(heads_);
    exchange(writer, head);
  }
  for (std::size_t i = 0; i < planned_.size(); ++i) {
    const Planned& each = planned_[i];
    const Bytes head = Bytes(heads_).subspan(i * DatagramHead::size, DatagramHead::size);
    const bool is_own = each.shared.empty();
    finished_.push_back(
        {head, is_own ? Bytes(bytes_).subspan(each.from, each.to - each.from) : each.shared,
         !is_own});
  }
  assert(finished_.size() == planned_.size());
  return finished_;
}

}  // namespace rink::rti
