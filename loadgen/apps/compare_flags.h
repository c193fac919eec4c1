// The flags of rink compare, and how it ends.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "game/apps/flags.h"
#include "loadgen/run/saturation/saturate_command.h"

namespace rink::loadgen {

/// Exit statuses; --help lists them.
enum CompareStatus {
  success = 0,
  bad_usage = 2,
  some_invalid = 3,
  nothing_measured = 4,
  output_failed = 5,
  assertion_failed = 6,
  reader_gone = 7,
  no_baseline = 8,
  width_not_reached = 9,
  bad_report_folder = 10,
  not_repeated = 11,
  no_relevance = 12,
  hung_up = 129,
  interrupted = 130
};

struct CompareOptions {
  std::string experiment;
  std::string out, programs, from, trace;
  bool may_replace = false, is_resumed = false, is_dry_run = false, keeps_traces = false;
  std::vector<std::string> assertions, plugins;
  std::uint32_t seeds = 0;
  double until_width = 0.0;  ///< a fraction; 0: run the seeds and be done
  SaturateOptions saturate;
};

void add_options(game::Flags& flags, CompareOptions& options);

}  // namespace rink::loadgen
