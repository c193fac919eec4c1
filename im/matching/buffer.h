// A growing array of plain values that are not initialised, on huge pages once it is large.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

#include "im/basics/checked.h"

namespace rink::im {

/// Memory of `bytes`, aligned to a cache line; from 2 MB on aligned to and advised for huge pages,
/// which halves the time of a join of a million boxes (a box's columns are megabytes apart, so that
/// each column of each row otherwise wants an address translation of its own).
std::byte* allocate_buffer(std::size_t bytes);
void free_buffer(std::byte* memory, std::size_t bytes);

/// Like a vector without initialisation: what `reserve` and `resize` give has no values yet. Never
/// shrinks.
template <class Value>
class Buffer {
  static_assert(std::is_trivially_copyable_v<Value>);

 public:
  Buffer() = default;
  Buffer(Buffer&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(data_, other.data_), std::swap(size_, other.size_),
        std::swap(capacity_, other.capacity_);
    return *this;
  }
  ~Buffer() { free_buffer(reinterpret_cast<std::byte*>(data_), capacity_ * sizeof(Value)); }

  /// Keeps what there is.
  void reserve(std::size_t count) {
    if (count <= capacity_) return;
    // A difference that went below zero asks for nearly all memory.
    assert(count <= std::numeric_limits<std::size_t>::max() / (2 * sizeof(Value)));
    const std::size_t capacity = count + count / 2;
    auto* data = reinterpret_cast<Value*>(allocate_buffer(capacity * sizeof(Value)));
    if (size_ > 0) std::memcpy(static_cast<void*>(data), data_, size_ * sizeof(Value));
    free_buffer(reinterpret_cast<std::byte*>(data_), capacity_ * sizeof(Value));
    data_ = data;
    capacity_ = capacity;
  }
  void resize(std::size_t count) {
    reserve(count);
    size_ = count;
  }
  void fill(std::size_t count, const Value& value) {
    resize(count);
    for (std::size_t i = 0; i < count; ++i) data_[i] = value;
  }
  void push_back(const Value& value) {
    assert(size_ < capacity_ || !holds(&value));  // the memory that it is in goes
    reserve(size_ + 1);
    data_[size_++] = value;
  }
  void clear() { size_ = 0; }

  Value* data() { return data_; }
  const Value* data() const { return data_; }
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  bool empty() const { return size_ == 0; }
  // Up to the size, where the sanitizer itself looks no further than the capacity.
  Value& operator[](std::size_t i) {
    assert(!checks_whole_structures || i < size_);
    return data_[i];
  }
  const Value& operator[](std::size_t i) const {
    assert(!checks_whole_structures || i < size_);
    return data_[i];
  }
  std::span<const Value> span() const { return {data_, size_}; }

 private:
  bool holds(const Value* value) const {
    const std::less<const Value*> is_below;
    return !is_below(value, data_) && is_below(value, data_ + size_);
  }

  Value* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace rink::im
