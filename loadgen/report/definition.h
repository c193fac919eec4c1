// What a name in tables of results means.
#pragma once

namespace rink::loadgen {

/// The definition of one key of a line of runs.jsonl. Figures of a sample, such as update_age_ms,
/// have a member for each percentile.
struct Definition {
  const char* field;    ///< the key
  const char* unit;     ///< empty: a name or a truth value; "1": a count or a fraction
  const char* alias;    ///< the name in the literature where that differs; may be empty
  const char* meaning;  ///< a sentence without its stop
};

}  // namespace rink::loadgen
