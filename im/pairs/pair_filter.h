// A filter made of a pair function: what `when` and `anywhere` build, and the short path for
// predicates that ask more than regions.
#pragma once

#include <memory>

#include "im/filter.h"
#include "im/pairs/pair_function.h"

namespace rink::im {

/// Of which pairs the function is asked.
enum class PairScope {
  overlapping,  ///< those whose closed rectangles overlap; no others are relevant
  all
};

/// Relevant are the pairs of the scope for which the predicate is true. It is asked about pairs of
/// which one moved, or changed in what the function uses; about all while it uses ages and the time
/// goes on. While one of a pair is swept (Filter::set_swept_update_region) the pair is relevant
/// unasked. Memory: 12 bytes per pair of the scope.
std::unique_ptr<Filter> make_pair_filter(const FilterSettings& settings,
                                         std::unique_ptr<PairFunction> predicate,
                                         PairScope scope = PairScope::overlapping);

}  // namespace rink::im
