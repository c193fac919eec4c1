// The books of energy from plain values: what a law of motion costs, and what an event takes.
#include "game/physics/bodies/energy_ledger.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rink::physics::test {
namespace {

/// Without drag, all the work of thrust is motion: m ((v + a t)^2 - v^2)/2.
TEST(EnergyLedger, CountsThrustAsWork) {
  const Motion motion{1.0, {0.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}, {0.0, 0.0}};
  const EnergyTransfer transfer = energy_transfer_of(motion, 1.5, 4.0, nullptr);
  EXPECT_NEAR(transfer.work, 0.5 * 4.0 * (3.5 * 3.5 - 2.0 * 2.0), 1e-13);
  EXPECT_NEAR(transfer.loss, 0.0, 1e-15);
}

/// Drag alone takes m v^2 (1 - exp(-2 g t))/2.
TEST(EnergyLedger, CountsDragAsLoss) {
  const Motion motion{0.0, {0.0, 0.0}, {2.0, 1.0}, {0.0, 0.0}, {0.5, 0.5}};
  const EnergyTransfer transfer = energy_transfer_of(motion, 3.0, 2.0, nullptr);
  EXPECT_EQ(transfer.work, 0.0);
  EXPECT_NEAR(transfer.loss, 0.5 * 2.0 * 5.0 * (1.0 - std::exp(-3.0)), 1e-14);
}

/// What friction takes is its part of the acceleration; nothing more after it has brought the body
/// to rest.
TEST(EnergyLedger, CountsFrictionAsLossUntilTheBodyRests) {
  const Vector2 slowing(-2.0, 0.0);
  const Motion motion{0.0, {0.0, 0.0}, {4.0, 0.0}, slowing, {0.0, 0.0}, 2.0};
  for (const double time : {2.0, 5.0}) {
    const EnergyTransfer transfer = energy_transfer_of(motion, time, 3.0, &slowing);
    EXPECT_NEAR(transfer.work, 0.0, 1e-14);
    EXPECT_NEAR(transfer.loss, 0.5 * 3.0 * 16.0, 1e-13);
  }
}

TEST(EnergyLedger, TakesTheDifferenceOfAnEventForItsLoss) {
  EnergyLedger ledger(true);
  ledger.introduce(10.0);
  ledger.note_before(6.0), ledger.note_before(4.0);
  ledger.note_after(0, 1.0), ledger.note_after(1, 5.0);
  ledger.close_event();
  EXPECT_EQ(ledger.introduced(), 10.0);
  EXPECT_EQ(ledger.loss().value(), 4.0);
  EXPECT_EQ(ledger.work().value(), 0.0);
}

TEST(EnergyLedger, EntersNothingWhereNoBooksAreKept) {
  EnergyLedger ledger(false);
  ledger.introduce(10.0);
  EXPECT_EQ(ledger.introduced(), 0.0);
}

}  // namespace
}  // namespace rink::physics::test
