// Proves that a filter in its steady state allocates nothing, by counting every allocation of this
// executable.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <initializer_list>
#include <new>
#include <string>
#include <vector>

#include "im/filter.h"

namespace {

std::atomic<std::size_t> allocation_count = 0;  // a second core allocates too

}  // namespace

// Not inlined: the compiler would see free() meet new and warn of a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocation_count;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
// Buffers are aligned.
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocation_count;
  const auto line = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(line, (size + line - 1) / line * line)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace rink::im {
namespace {

/// Everything circles with a period of 16 ticks, so that one round shows all there is to store.
void tick(Filter& filter, int time) {
  const auto place = [time](std::uint32_t id, double half) {
    const double x = (id * 37u) % 101u + (time % 16) * 0.5, y = (id * 53u) % 97u;
    return Region{x - half, y - half, x + half, y + half};
  };
  for (Entity entity = 0; entity < 500; ++entity)
    filter.set_update_region(entity, place(entity, 0.1)), filter.note_update(entity);
  for (Subscriber subscriber = 0; subscriber < 50; ++subscriber)
    filter.set_subscription_region(subscriber, place(subscriber, 10.0));
  filter.match();
}

TEST(Filter, AllocatesNothingInTheSteadyState) {
  std::vector<std::string> all = filter_names();
  for (const char* composed : {"aura and not sight", "not (region or cone)",
                               "region with hysteresis(margin=1) with dwell(matches=3)",
                               "aura with swept(horizon=1) with tiers(at=0.3 at=0.6) with priority",
                               "region with psense(vision=0.5)", "region with von(area=0.5)",
                               "region with donnybrook(k=3)", "region with vfc(at=0.2 matches=2)",
                               "region with dyconits(cell_size=9 error=1)"})
    all.emplace_back(composed);
  for (const std::string& name : all) {
    const auto filter = make_filter(name, {.world = {0.0, 0.0, 110.0, 100.0}});
    for (int time = 0; time < 32; ++time) tick(*filter, time);
    const std::size_t before = allocation_count;
    for (int time = 32; time < 64; ++time) tick(*filter, time);
    EXPECT_EQ(allocation_count, before) << name;
  }
}

}  // namespace
}  // namespace rink::im
