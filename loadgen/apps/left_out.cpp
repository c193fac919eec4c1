// One mode needs a library of others.
#include "loadgen/apps/left_out.h"

#include <algorithm>

#include "loadgen/dds/dds_absence.h"

namespace rink::loadgen {

std::string left_out(Experiment& experiment) {
  if (dds_absence == nullptr) return {};
  bool is_left_out = false;
  const auto leave_out = [&is_left_out](Experiment& each) {
    if (std::erase(each.modes, dds_mode) == 0) return;
    is_left_out = true;
    if (each.modes.empty())
      throw ExperimentError("experiment " + each.name + ": modes = " + dds_mode + ": " +
                            dds_absence);
  };
  if (experiment.parts.empty()) leave_out(experiment);
  std::ranges::for_each(experiment.parts, leave_out);
  return is_left_out ? std::string("rows of the mode dds are absent: ") + dds_absence + "\n"
                     : std::string();
}

}  // namespace rink::loadgen
