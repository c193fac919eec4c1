// Which bodies changed, for any number of readers that look when they like.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "game/physics/body.h"

namespace rink::physics {

/// How far a reader has read a world's changes; a new one has read nothing. Handed to another world
/// it begins anew there.
class ChangeCursor {
  friend class ChangeLog;
  std::shared_ptr<const char> log_;  ///< held, so that no later log can be taken for it
  std::uint64_t read_ = 0;
};

/// A list of bodies in the order in which they changed, each once between two readings by anybody:
/// whoever reads next sees it there. So the list grows by at most one entry per body and reading,
/// and without a reader by one per body in all. What a slow reader has not read yet is kept up to
/// twice the number of bodies; one that is slower still is handed all bodies.
class ChangeLog {
 public:
  void note(std::uint32_t body) {
    if ((is_listed_[body / 64] >> (body % 64) & 1) == 0) list(body);
  }
  /// Whether all of `body_count` bodies, which are all there are, are listed already: then note()
  /// has nothing to add.
  bool lists_all(std::uint32_t body_count) const {
    assert(begin_ <= unread_ && (body_count + 63) / 64 == is_listed_.size());
    return begin_ + entries_.size() - unread_ >= body_count;
  }
  /// The next body, by number.
  void add(std::uint32_t body) {
    if (body % 64 == 0) is_listed_.push_back(0);
    assert(body / 64 + 1 == is_listed_.size());
    note(body);
  }

  /// What changed since `cursor` read last, a body more than once if others have read in between;
  /// all of `body_count` bodies if that is not known. Valid until the next change or reading.
  std::span<const BodyId> read(ChangeCursor& cursor, std::uint32_t body_count) {
    const std::uint64_t end = begin_ + entries_.size();
    const bool is_known = cursor.log_ == identity_ && cursor.read_ >= begin_;
    const std::uint64_t from = cursor.read_;
    assert(begin_ <= unread_ && unread_ <= end && (!is_known || from <= end));
    cursor.log_ = identity_;
    cursor.read_ = end;
    for (std::uint64_t k = unread_; k < end; ++k) {
      const std::uint32_t body = entries_[k - begin_].index;
      is_listed_[body / 64] &= ~(std::uint64_t{1} << (body % 64));
    }
    unread_ = end;
    return is_known ? entries_since(from, body_count) : all_of(body_count);
  }

 private:
  static constexpr std::size_t entries_kept_min = 1024;

  /// Kept apart: most bodies that change are listed already.
  [[gnu::noinline]] void list(std::uint32_t body) {
    is_listed_[body / 64] |= std::uint64_t{1} << (body % 64);
    entries_.push_back({body});
  }

  std::span<const BodyId> entries_since(std::uint64_t from, std::uint32_t body_count) {
    const std::span<const BodyId> entries = std::span(entries_).subspan(from - begin_);
    if (from - begin_ <= 2 * std::size_t{body_count} + entries_kept_min) return entries;
    handed_out_.assign(entries.begin(), entries.end());
    begin_ = from;
    entries_ = handed_out_;
    return handed_out_;
  }

  std::span<const BodyId> all_of(std::uint32_t body_count) {
    handed_out_.resize(body_count);
    for (std::uint32_t body = 0; body < body_count; ++body) handed_out_[body] = {body};
    return handed_out_;
  }

  std::shared_ptr<const char> identity_ = std::make_shared<const char>('\0');
  std::uint64_t begin_ = 0;   ///< number of the first entry
  std::uint64_t unread_ = 0;  ///< entries from here on nobody has read: they are marked as listed
  std::vector<BodyId> entries_, handed_out_;
  std::vector<std::uint64_t> is_listed_;  ///< a bit per body
};

}  // namespace rink::physics
