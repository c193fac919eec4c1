// What tests draw from a seed.
#pragma once

#include <cstddef>
#include <random>

#include "rti/admission/shared_key.h"

namespace rink::rti::testing {

inline double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Nonce nonce_of(unsigned seed) {
  std::mt19937 random(seed);
  Nonce nonce;
  for (std::byte& each : nonce) each = static_cast<std::byte>(random());
  return nonce;
}

}  // namespace rink::rti::testing
