// The Google Benchmark suite; every *_bench.cpp beside this file registers its own.
#include <benchmark/benchmark.h>

BENCHMARK_MAIN();
