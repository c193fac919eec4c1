// Gives memory that was freed back to the operating system, where the allocator would keep it.
#pragma once

#if defined(__linux__)
#include <malloc.h>
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define RINK_OTHER_ALLOCATOR
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define RINK_OTHER_ALLOCATOR
#endif
#endif

namespace rink {

/// For after a large structure was freed. Does nothing where glibc's allocator is not in use: the
/// sanitizers put their own in its place, so that glibc's never begins, and two threads that began
/// it here at once would fail inside it.
inline void give_back_freed_memory() {
#if defined(__GLIBC__) && !defined(RINK_OTHER_ALLOCATOR)
  malloc_trim(0);
#endif
}

}  // namespace rink

#undef RINK_OTHER_ALLOCATOR
