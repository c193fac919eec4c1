// Allocates memory for buffers and asks for huge pages where they pay.
#include "im/matching/buffer.h"

#include <cassert>
#include <cstdint>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace rink::im {
namespace {

constexpr std::size_t line = 64, huge_page = std::size_t{2} << 20;

std::align_val_t alignment(std::size_t bytes) {
  return std::align_val_t{bytes >= huge_page ? huge_page : line};
}

}  // namespace

std::byte* allocate_buffer(std::size_t bytes) {
  assert(bytes > 0);
  auto* memory = static_cast<std::byte*>(::operator new(bytes, alignment(bytes)));
  assert(reinterpret_cast<std::uintptr_t>(memory) % line == 0);
#ifdef MADV_HUGEPAGE
  // Advice: where it is not followed, pages are small and all else is the same.
  if (bytes >= huge_page) madvise(memory, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_buffer(std::byte* memory, std::size_t bytes) {
  assert((memory == nullptr) == (bytes == 0));  // the size says how it was aligned
  if (memory != nullptr) ::operator delete(memory, alignment(bytes));
}

}  // namespace rink::im
