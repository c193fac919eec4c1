// The Google Benchmark suite; every *_bench.cpp beside this file registers its own.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "bench/column_reporter.h"
#include "game/version/version.h"

namespace {

constexpr int failed = 1, bad_usage = 2;  // exit statuses

constexpr const char* usage = R"(Run the benchmarks; each reports time and error, in real time.

usage: rink bench [--filter REGEX] [--json FILE] [--columns NAMES] [GOOGLE BENCHMARK ARGUMENTS]

  --filter REGEX   only benchmarks whose name matches            (default: all)
  --json FILE      also write the results to FILE as JSON        (default: none)
  --columns NAMES  a narrow table of time and these counters alone, separated by commas; --columns time: of time alone

Example: rink bench --filter 'im/pass/region' --json im.json
)";

struct Arguments {
  std::vector<std::string> translated;               ///< into Google Benchmark's own spelling
  std::optional<std::vector<std::string>> counters;  ///< of --columns, without the time
};

std::vector<std::string> counters_in(const std::string& names) {
  std::vector<std::string> counters;
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');)
    if (name != "time") counters.push_back(name);
  return counters;
}

/// False if one of our flags lacks its value.
bool translate(const std::vector<std::string>& arguments, Arguments& result) {
  std::vector<std::string>& translated = result.translated;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool is_filter = arguments[i] == "--filter", is_json = arguments[i] == "--json",
               is_columns = arguments[i] == "--columns";
    if (!is_filter && !is_json && !is_columns) {
      translated.push_back(arguments[i]);
      continue;
    }
    if (++i == arguments.size()) return false;
    if (is_columns) {
      result.counters = counters_in(arguments[i]);
      continue;
    }
    translated.push_back((is_filter ? "--benchmark_filter=" : "--benchmark_out=") + arguments[i]);
    if (is_json) translated.emplace_back("--benchmark_out_format=json");
  }
  return true;
}

}  // namespace

int main(int count, char** values) {
  const std::vector<std::string> arguments(values, values + count);
  for (const std::string& argument : arguments)
    if (argument == "--help" || argument == "-h") {
      return std::fputs(usage, stdout) < 0;
    } else if (argument == "--version") {
      return std::puts(rink::game::version_line("rink-bench").c_str()) < 0;
    }
  Arguments ours;
  if (!translate(arguments, ours))
    return std::fputs("rink bench: --filter, --json and --columns need a value\n", stderr),
           bad_usage;
  std::vector<char*> pointers;
  for (std::string& argument : ours.translated) pointers.push_back(argument.data());
  int pointer_count = static_cast<int>(pointers.size());
  benchmark::Initialize(&pointer_count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(pointer_count, pointers.data())) return bad_usage;
  if (!ours.counters) return benchmark::RunSpecifiedBenchmarks() == 0 ? failed : 0;
  rink::bench::ColumnReporter table(*ours.counters);
  if (benchmark::RunSpecifiedBenchmarks(&table) == 0 || !table.is_sound()) return failed;
  if (const std::string unknown = table.unknown_counter(); !unknown.empty())
    return std::fprintf(stderr, "rink bench: --columns: none of these benchmarks counts %s\n",
                        unknown.c_str()),
           bad_usage;
  return 0;
}
