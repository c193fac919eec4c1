// Measures an RTI by the standard's C++ API, whichever this was compiled with: a row for each kind
// of work. Ends with 1 if anything was not received as it was sent.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "bench/standard/standard_work.h"

namespace {

constexpr const char* usage =
    "usage: rink-standard-driver MODEL [SETTINGS] [--scale N]\n\n"
    "  MODEL      bench/standard/driver.xml, as the RTI names files\n"
    "  SETTINGS   local settings designator        (default: empty)\n"
    "  --scale N  N times the work                 (default: 1)\n";

/// A row; true if all was right.
bool show(const char* work, const rink_driver::Outcome& outcome) {
  const double each = outcome.count == 0 ? 0.0 : 1e6 / static_cast<double>(outcome.count);
  std::printf("%-24s %9llu %12.3f %12.3f  %s\n", work,
              static_cast<unsigned long long>(outcome.count), outcome.seconds * each,
              outcome.processor_seconds * each,
              outcome.fault.empty() ? "all right" : outcome.fault.c_str());
  std::fflush(stdout);
  return outcome.fault.empty();
}

}  // namespace

int main(int count, char** words) {
  using namespace rink_driver;
  StandardPlace place;
  unsigned long scale = 1;
  int plain = 0;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--help" || word == "-h") return std::fputs(usage, stdout) < 0;
    if (word == "--scale" && i + 1 < count) {
      char* end = nullptr;
      scale = std::strtoul(words[++i], &end, 10);
      if (*end != '\0' || scale < 1 || scale > 1000)
        return std::fprintf(stderr, "--scale is 1 to 1000, not '%s'\n", words[i]), 2;
    } else if (word.compare(0, 2, "--") == 0 || plain == 2) {
      return std::fprintf(stderr, "what is '%s'?\n%s", words[i], usage), 2;
    } else {
      (plain++ == 0 ? place.model : place.settings) = std::wstring(word.begin(), word.end());
    }
  }
  if (plain == 0) return std::fputs(usage, stderr), 2;
  std::printf("%-24s %9s %12s %12s\n", "work", "count", "us each", "cpu us each");
  bool is_right = show("updates to 1", standard_updates(place, 1, 1000 * scale));
  is_right &= show("updates to 8", standard_updates(place, 8, 200 * scale));
  is_right &= show("round trips", standard_round_trips(place, 1000 * scale));
  is_right &= show("time advances of 8", standard_advances(place, 8, 200 * scale));
  is_right &= show("joins", standard_joins(place, 50 * scale));
  is_right &= show("values to late joiners", standard_late_joiners(place, 20 * scale));
  return is_right ? 0 : 1;
}
