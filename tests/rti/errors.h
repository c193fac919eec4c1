// What services refuse, by the standard's names.
#pragma once

#include <gtest/gtest.h>

#include <string_view>

#include "rti/hla_error.h"

namespace rink::rti::testing {

/// The standard's name for what `service` throws; none if it does not.
HlaError error_thrown_by(const auto& service) {
  try {
    service();
  } catch (const RtiException& exception) {
    EXPECT_TRUE(std::string_view(exception.what()).starts_with(to_string(exception.error())))
        << exception.what();
    return exception.error();
  }
  return HlaError::none;
}

}  // namespace rink::rti::testing
