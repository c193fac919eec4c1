// A score, sound or wrong in the one way that FAULT names.
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "im/pairs/rink_plugin.h"

#define TEXT_OF(name) #name
#define VALUE_OF(name) TEXT_OF(name)

namespace {

constexpr std::string_view fault = VALUE_OF(FAULT);

void evaluate(const rink_pairs* pairs, double* results, double*) {
  static int calls = 0;
  ++calls;
  if (fault == "throws") throw std::runtime_error("of course");
  if (fault == "crashes") std::raise(SIGSEGV);
  if (fault == "ends") std::exit(0);
  if (fault == "hangs") sleep(3600);
  for (size_t i = 0; i < pairs->count; ++i) {
    const rink_party& its = pairs->entities[pairs->pairs[i].entity];
    results[i] = fault == "rubbish"  ? std::numeric_limits<double>::quiet_NaN()
                 : fault == "unfit"  ? 2.0
                 : fault == "impure" ? calls
                                     : its.x;
  }
  if (fault == "beyond") results[pairs->count] = 1.0;
}

const rink_plugin plugin{fault == "older" ? RINK_PLUGIN_VERSION - 1 : RINK_PLUGIN_VERSION,
                         fault == "smaller" ? 8u : static_cast<uint32_t>(sizeof(rink_party)),
                         fault == "nameless" ? "Not A Name" : "rightmost",
                         fault == "kindless" ? 7u
                         : fault == "unfit"  ? RINK_PREDICATE
                                             : RINK_SCORE,
                         0,
                         fault == "none" ? nullptr : evaluate};

}  // namespace

const rink_plugin* rink_plugin_describe(void) { return &plugin; }
