// What the parts that measure and report assert of each other: a wrong argument ends the program,
// with the condition that it broke.
#include <gtest/gtest.h>

#include "loadgen/measure/equal_error.h"
#include "loadgen/measure/sequential.h"
#include "loadgen/measure/truth/encounters.h"
#include "loadgen/measure/truth/scope_history.h"
#include "loadgen/report/plot_table.h"
#include "loadgen/report/plots/boxes.h"

namespace rink::loadgen {
namespace {

#ifndef NDEBUG

TEST(MeasureDeathTest, NamesWhatIsWrongWithSamplesAndLooks) {
  EXPECT_DEATH(confidence_of_look(0), "look > 0");
  EXPECT_DEATH(at_equal_error({}, 0.9, 0.0), "error_mm > 0.0");
  EXPECT_DEATH(ScopeHistory({{2.0, 1, true}, {1.0, 1, false}}), "is_sorted");
  EXPECT_DEATH(Encounters(0.0, 1.0).build({}), "length_ > 0.0");
  EXPECT_DEATH(clamped_cell(1.0, 0), "count > 0");
}

TEST(MeasureDeathTest, NamesWhatIsWrongWithTablesAndBoxes) {
  const PlotTable uneven{"a", "A row is a row.", {"x", "y"}, {{"1"}}};
  EXPECT_DEATH(to_details(uneven), "is_rectangular");
  EXPECT_DEATH(box_of({}), "sample.empty");
}

#endif

}  // namespace
}  // namespace rink::loadgen
