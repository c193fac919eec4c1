// A lockstep rink whose clients compute, and its truth: every body that a client knows against the
// server's, bit for bit.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <utility>
#include <vector>

#include "game/physics/subdomain.h"
#include "game/replication/exact/exact_replicas.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {

/// How many bodies were compared over all clients and ticks, and how many were not computed, being
/// held by somebody unknown, or lingered out of scope.
struct Compared {
  std::uint64_t bodies = 0, held_by_unknown = 0, lingering = 0;
};

inline bool are_same_bits(const Vector2& a, const Vector2& b) {
  return std::bit_cast<std::uint64_t>(a.x()) == std::bit_cast<std::uint64_t>(b.x()) &&
         std::bit_cast<std::uint64_t>(a.y()) == std::bit_cast<std::uint64_t>(b.y());
}

/// All that `client` knows against the truth at the same tick, and its scope against the filter's.
inline void compare(LockstepRink& rink, Client& client, const std::string& where,
                    Compared& compared) {
  if (client.computed() == nullptr || !client.ambassador().is_joined()) return;
  const ExactReplicas* const exact = &client.computed()->exact();
  const Game& game = rink.server().game();
  ASSERT_TRUE(exact->is_exact()) << where << ": " << exact->error();
  ASSERT_EQ(exact->time(), game.now()) << where;
  for (const ExactReplicas::Body& body : exact->bodies()) {
    if (exact->class_of(body).kind == physics::BodyKind::post) continue;
    const EntityId id{body.number};
    const std::string who =
        where + ", body " + std::to_string(body.number) + " at t = " + std::to_string(game.now());
    ASSERT_TRUE(game.is_there(id)) << who;
    ASSERT_EQ(rink.server().publisher().object(id), body.object) << who;
    const physics::BodyState truth = physics::Subdomain::state_in(game.world(), body.number),
                             found = exact->state(body);
    ASSERT_EQ(truth.flight.time, found.flight.time) << who;
    ASSERT_TRUE(
        are_same_bits({truth.flight.x, truth.flight.y}, {found.flight.x, found.flight.y}) &&
        are_same_bits({truth.flight.vx, truth.flight.vy}, {found.flight.vx, found.flight.vy}) &&
        truth.flags == found.flags)
        << who;
    ASSERT_EQ(digest_of(body.number, truth), digest_of(body.number, found)) << who;
    const EntityReplica* const shown = client.replicas().find(body.object);
    ASSERT_TRUE(shown != nullptr && shown->in_scope == body.is_in_scope) << who;
    ASSERT_TRUE(shown->is_placed || !body.is_in_scope) << who;
    if (!body.is_in_scope) ++compared.lingering;
    else if (game.world().is_in_play(id)) {
      ASSERT_EQ(shown->position_at(game.now()), game.position(id)) << who;
    }
    ++compared.bodies;
    if (!body.is_computed) ++compared.held_by_unknown;
  }
}

/// What all clients counted.
inline ExactReplicaCounters counted(LockstepRink& rink) {
  ExactReplicaCounters sum;
  for (std::size_t k = 0; k < rink.client_count(); ++k) {
    if (rink.client(k).computed() == nullptr) continue;
    const ExactReplicaCounters& each = rink.client(k).computed()->exact().counters();
    sum.ticks += each.ticks, sum.keys += each.keys, sum.entries += each.entries;
    sum.exits += each.exits, sum.starts += each.starts, sum.doubtful += each.doubtful;
    sum.hashes += each.hashes, sum.wrong_hashes += each.wrong_hashes;
    sum.malformed += each.malformed;
  }
  return sum;
}

/// Plays `ticks` and compares all clients after each.
inline void follow(LockstepRink& rink, int ticks, const std::string& where, Compared& compared) {
  for (int tick = 0; tick < ticks && !testing::Test::HasFatalFailure(); ++tick) {
    rink.tick();
    for (std::size_t k = 0; k < rink.client_count(); ++k)
      compare(rink, rink.client(k), where + ", client " + std::to_string(k), compared);
  }
}

}  // namespace rink::game
