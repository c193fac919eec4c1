// Arrays that many events look into at random places, on large pages where the system offers them.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace rink::physics {

/// With a million bodies nearly every event misses the processor's cache of addresses, too: pages
/// of 2 MiB make it a fifth quicker. Small arrays come from the ordinary heap.
template <class T>
struct LargePageAllocator {
  using value_type = T;
  static constexpr std::size_t page = std::size_t{1} << 21;

  LargePageAllocator() = default;
  template <class Other>
  LargePageAllocator(const LargePageAllocator<Other>&) {}

  T* allocate(std::size_t count) {
    // Beyond that the rounding up to a page would overflow; g++ -O3 says so at every array.
    if (count > (std::numeric_limits<std::ptrdiff_t>::max() - page) / sizeof(T))
      throw std::bad_array_new_length();
    const std::size_t bytes = count * sizeof(T);
    if (bytes < page) return static_cast<T*>(::operator new(bytes, alignment));
    void* memory = std::aligned_alloc(page, (bytes + page - 1) / page * page);
    if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
    madvise(memory, (bytes + page - 1) / page * page,
            MADV_HUGEPAGE);  // a hint: whether it is taken changes nothing but speed
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    if (count * sizeof(T) < page) ::operator delete(memory, alignment);
    else std::free(memory);
  }
  friend bool operator==(const LargePageAllocator&, const LargePageAllocator&) { return true; }

 private:
  static constexpr std::align_val_t alignment{alignof(T) < 64 ? 64 : alignof(T)};
};

template <class T>
using LargeArray = std::vector<T, LargePageAllocator<T>>;

}  // namespace rink::physics
