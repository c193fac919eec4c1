// What a plugin and Rink agree on: one predicate or score over arrays of pairs, in plain C, so that
// any compiler's shared object serves (docs/im.md, "Plugins").
#pragma once

// C has no other headers, and no using.
// NOLINTBEGIN(modernize-deprecated-headers,modernize-use-using)
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Grows with every change of what follows; a plugin of another version is refused.
#define RINK_PLUGIN_VERSION 1u
// Of a team or owner: there is none.
#define RINK_NONE 0xffffffffu

// What is known of an entity with its update region, or of a subscriber with its subscription
// region. Lengths are in m, velocities in m/s, times in s.
typedef struct rink_party {
  double low_x, low_y, high_x, high_y;  // the region
  double x, y;                          // its middle
  double velocity_x, velocity_y;        // 0 where unknown
  double heading_x, heading_y;          // a direction of any length; both 0 where unknown
  double age;      // since its motion last changed, by contact or key; infinite if never
  uint32_t id;     // of the entity or the subscriber; these are numbered apart
  uint32_t team;   // or RINK_NONE
  uint32_t owner;  // or RINK_NONE
  uint32_t kind;   // 1 puck, 2 bat, 3 post; 0 where unknown
  uint32_t is_always_relevant;  // 0 or 1
  uint32_t reserved;            // 0
} rink_party;

// Indices of rink_pairs.subscribers and .entities.
typedef struct rink_pair {
  uint32_t subscriber, entity;
} rink_pair;

typedef struct rink_pairs {
  const rink_party* subscribers;
  const rink_party* entities;
  const rink_pair* pairs;
  size_t count;  // of pairs
} rink_pairs;

// What a plugin is.
#define RINK_PREDICATE 1u
#define RINK_SCORE 2u

// What it looks at beside regions, so that Rink asks again when that changes; added up.
#define RINK_USES_ROLES 1u   // team, owner, is_always_relevant
#define RINK_USES_MOTION 2u  // velocity, heading, kind
#define RINK_USES_AGE 4u     // age: all pairs are asked about at every match

typedef struct rink_plugin {
  uint32_t version;     // RINK_PLUGIN_VERSION
  uint32_t party_size;  // sizeof(rink_party)
  const char* name;     // small letters, digits and _, first a letter; at most 32
  uint32_t kind;        // RINK_PREDICATE or RINK_SCORE
  uint32_t uses;        // RINK_USES_...
  // A pure function of the pairs: the same give the same, in any company and order. results[i] is,
  // of a predicate, 1 if the entity matters to the subscriber, else 0; of a score any finite
  // number, the higher the better. slacks[i], 0 at first, may be set by a predicate that uses
  // nothing beside regions: how far both may come, the sum of the greatest changes of any
  // coordinate of either [m], before the answer can change. Nothing may be thrown out of it.
  void (*evaluate)(const rink_pairs* pairs, double* results, double* slacks);
} rink_plugin;

// What Rink looks up in the shared object. Valid for as long as that is loaded.
const rink_plugin* rink_plugin_describe(void);

#ifdef __cplusplus
}
#endif
// NOLINTEND(modernize-deprecated-headers,modernize-use-using)
