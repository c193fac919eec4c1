// The Google Benchmark suite; every *_bench.cpp beside this file registers its own.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <string>
#include <vector>

#include "game/version/version.h"

namespace {

constexpr const char* usage = R"(Run the benchmarks; each reports time and error, in real time.

usage: rink bench [--filter REGEX] [--json FILE] [GOOGLE BENCHMARK ARGUMENTS]

  --filter REGEX   only benchmarks whose name matches            (default: all)
  --json FILE      also write the results to FILE as JSON        (default: none)

Example: rink bench --filter 'im/pass/region' --json im.json
)";

/// Google Benchmark's own spelling of `arguments`; false if one of ours lacks its value.
bool translate(const std::vector<std::string>& arguments, std::vector<std::string>& translated) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool is_filter = arguments[i] == "--filter", is_json = arguments[i] == "--json";
    if (!is_filter && !is_json) {
      translated.push_back(arguments[i]);
      continue;
    }
    if (++i == arguments.size()) return false;
    translated.push_back((is_filter ? "--benchmark_filter=" : "--benchmark_out=") + arguments[i]);
    if (is_json) translated.push_back("--benchmark_out_format=json");
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
  std::vector<std::string> translated;
  if (!translate(arguments, translated)) return std::fputs("rink bench: --filter and --json need a value\n", stderr), 2;
  std::vector<char*> pointers;
  for (std::string& argument : translated) pointers.push_back(argument.data());
  int pointer_count = static_cast<int>(pointers.size());
  benchmark::Initialize(&pointer_count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(pointer_count, pointers.data())) return 2;
  return benchmark::RunSpecifiedBenchmarks() == 0 ? 1 : 0;
}
