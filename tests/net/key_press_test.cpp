// The path of docs/key-press.md, walked: from a key to the client's own replica.
#include <gtest/gtest.h>

#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

TEST(KeyPress, MovesTheOwnBatInThePlayersMirrorAtTheNextTickByTheClosedForm) {
  const Scene scene = match();
  LockstepRink rink(scene, {.clients = 2, .rate_hz = 60.0});
  rink.start();
  rink.tick();
  Client& player = rink.client(0);
  const Position before = player.bat()->position;

  // 1. The player presses a key 3 ms into the tick; the client sends KeyDown.
  rink.now += 0.003;
  const double pressed = rink.now;
  player.press(Key::up);
  EXPECT_EQ(player.keys_sent(), 1u);

  // 2. The RTI hands it to the server, which stamps it with that instant and queues it for its
  // game.
  rink.settle();
  ASSERT_EQ(rink.server().keys().recorded().size(), 1u);
  EXPECT_EQ(rink.server().keys().recorded()[0].time, pressed);
  EXPECT_EQ(player.bat()->input.count, 0u);

  // 3. The tick applies it: the bat accelerates from the stamped instant on, x(t) = x0 + a (t -
  // s)/g with s = (1 - exp(-g t))/g.
  rink.tick();
  const double g = scene.world.bat_drag, t = rink.now - pressed, a = scene.bodies.bats[0].thrust;
  const double s = g > 0.0 ? -std::expm1(-g * t) / g : t;
  const double moved = g > 0.0 ? a * (t - s) / g : 0.5 * a * t * t;
  const Vector2 home = scene.bodies.bats[0].body.position;
  EXPECT_NEAR(rink.server().game().position(*rink.server().game().bat(0)).y(), home.y() + moved,
              1e-12);

  // 4. The publisher moves the update region and sends the position; the filter keeps the bat in
  // its player's interest; the mirror has it.
  EXPECT_EQ(player.bat()->input.count, 1u);
  EXPECT_EQ(player.bat()->input.held, 1u << static_cast<unsigned>(Key::up));
  EXPECT_EQ(player.bat()->position, rounded({home.x(), home.y() + moved}));
  EXPECT_NE(player.bat()->position, before);

  // 5. The client's interest follows.
  const im::Region& view = player.view();
  EXPECT_NEAR(0.5 * (view.low_y + view.high_y), player.bat()->position.y, 1e-9);
}

}  // namespace
}  // namespace rink::game
