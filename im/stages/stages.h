// The stages that may follow a scheme: each takes filters and is one, so that any number of them
// may follow any scheme.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "im/filter.h"
#include "im/pairs/pair_function.h"

namespace rink::im {

/// Pairs are relevant from when `enter` holds until `stay`, the same scheme, no longer holds for a
/// subscription that is `margin` [m] larger on each side.
std::unique_ptr<Filter> make_hysteresis(std::unique_ptr<Filter> enter, std::unique_ptr<Filter> stay,
                                        double margin);

/// Pairs stay relevant for `matches` matches at least.
std::unique_ptr<Filter> make_dwell(std::unique_ptr<Filter> inner, std::uint32_t matches);

/// Tier k: within `fractions[k]` (above 0, ascending) of the subscription's disc, by the rule of
/// `aura`, of which `rings` has one for each; an entity in none has the last tier.
std::unique_ptr<Filter> make_tiers(std::unique_ptr<Filter> inner,
                                   std::vector<std::unique_ptr<Filter>> rings,
                                   std::vector<double> fractions);

/// Gives `inner` regions that reach over the next `horizon` seconds of their flights, never less
/// than half of it, and computes when pairs touch: by rectangles, or by the disc of the
/// subscription.
std::unique_ptr<Filter> make_swept(std::unique_ptr<Filter> inner, double horizon, double drag,
                                   bool is_disc);

/// Of the relevant entities of each subscriber only the `count` with the highest scores stay so; of
/// equal scores the smaller id is first. `name` is that of the stage, for its counts.
std::unique_ptr<Filter> make_rank(std::unique_ptr<Filter> inner,
                                  std::unique_ptr<PairFunction> score, std::uint32_t count,
                                  const char* name);

/// Of the relevant entities of each subscriber only its near and sensor nodes stay so: those within
/// `vision`, a share (above 0, up to 1) of the subscription's disc, by their middles, and the
/// nearest one beyond in each of eight sectors, of equals the smaller id (Schmieg et al. 2008).
std::unique_ptr<Filter> make_psense(std::unique_ptr<Filter> inner, double vision);

/// Of the relevant entities of each subscriber only those stay so that are within `area`, a share
/// (0 to 1) of the subscription's disc, by their middles, its own ones, and those whose regions
/// touch the subscriber's in the Voronoi diagram of all middles but its own ones' (Hu, Chen & Chen
/// 2006).
std::unique_ptr<Filter> make_von(std::unique_ptr<Filter> inner, double area);

/// Tier 0: the subscriber's own entities and the `count` others of its list that have most of its
/// attention, by proximity, aim and recency (Bharambe et al. 2008); tier `guidance_tier` (above 0):
/// all others. `own` is the scheme `owner`.
std::unique_ptr<Filter> make_donnybrook(std::unique_ptr<Filter> inner,
                                        std::unique_ptr<Filter> same_inner,
                                        std::unique_ptr<Filter> own, std::uint32_t count,
                                        unsigned guidance_tier);

/// What may be held back of an entity whose middle is farther than `from` times the radius of the
/// subscription's disc, at most; without a bound the largest number.
struct ConsistencyZone {
  double from;
  double matches, updates;  ///< since what was told was the newest
  double distance;          ///< from where it was then [m]
};

/// Holds updates back: within every zone all is told at once, in a zone as soon as one of its
/// bounds is exceeded (Santos, Veiga & Ferreira 2007). `zones`, at least one, ascend.
std::unique_ptr<Filter> make_vfc(std::unique_ptr<Filter> inner, std::vector<ConsistencyZone> zones);

/// What may be held back in a cell at most, for each step from the subscriber's cell to it; without
/// a bound the largest number.
struct DyconitBounds {
  double cell_size;  ///< [m]
  double matches;    ///< since all that was told was the newest
  double error;      ///< the sum of all ways since then [m]
};

/// Holds updates back: all those of a cell are told as soon as one of its bounds is exceeded, those
/// of the subscriber's own cell at once. Cells count from the low corner of `world`; a pair is in
/// that of its entity's middle (Donkervliet et al. 2021).
std::unique_ptr<Filter> make_dyconits(std::unique_ptr<Filter> inner, const Region& world,
                                      const DyconitBounds& bounds);

/// Orders relevant entities by urgency (im/stages/priority_order.h), for senders of at most
/// `budget` bytes to a subscriber between two matches; 0: no limit.
std::unique_ptr<Filter> make_priority(std::unique_ptr<Filter> inner, std::size_t budget);

}  // namespace rink::im
