// Links rink::im and nothing else: a filter decides who sees whom.
#include <cstdio>

#include "im/filter.h"

int main() {
  const auto filter = rink::im::make_filter("grid(cell_size=2)", {.world = {0.0, 0.0, 10.0, 10.0}});
  filter->set_subscription_region(0, {0.0, 0.0, 1.0, 1.0});
  filter->set_update_region(7, {1.5, 1.5, 1.6, 1.6});
  filter->set_update_region(8, {8.0, 8.0, 8.1, 8.1});
  const auto changes = filter->match();
  if (changes.size() == 1 && changes[0].entity == 7) return 0;
  return std::puts("the grid does not show the entity in the viewer's cell, and only that"), 1;
}
