// libFuzzer's way into a harness: rink-fuzz --harness=NAME [libFuzzer's options] [corpus].
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "tests/fuzz/harness.h"

namespace {
const rink::fuzz::Harness* chosen = nullptr;
}

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr const char* option = "--harness=";
  for (int i = 1; i < *argc; ++i) {
    if (std::strncmp((*argv)[i], option, std::strlen(option)) != 0) continue;
    for (const auto& list :
         {rink::fuzz::rti_harnesses(), rink::fuzz::game_harnesses(), rink::fuzz::im_harnesses()})
      for (const rink::fuzz::Harness& harness : list)
        if (std::strcmp(harness.name, (*argv)[i] + std::strlen(option)) == 0) chosen = &harness;
  }
  rink::fuzz::require(chosen != nullptr, "--harness names one of tests/fuzz/*_harnesses.cpp");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const rink::rti::Bytes input{reinterpret_cast<const std::byte*>(data), size};
  chosen->run(input);
  chosen->refuse(input);
  return 0;
}
