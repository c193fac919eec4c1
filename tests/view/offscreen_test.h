// What tests share that draw without a window.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "game/view/render/offscreen.h"

namespace rink::view {

/// The tests of a suite share a context, which takes long to make. Where nothing can draw, they are
/// skipped with the reason.
class OffscreenTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    setenv("LP_NUM_THREADS", "1", 0);
    try {
      context_ = std::make_unique<OffscreenContext>();
    } catch (const GraphicsError& error) {
      error_ = error.what();
    }
  }
  static void TearDownTestSuite() { context_.reset(); }
  void SetUp() override {
    if (!context_) GTEST_SKIP() << error_;
  }
  static bool can_draw() { return context_ != nullptr; }

 private:
  static inline std::unique_ptr<OffscreenContext> context_;
  static inline std::string error_;
};

}  // namespace rink::view
