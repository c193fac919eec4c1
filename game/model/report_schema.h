// The schema of the JSON and the tables that commands write for programs.
#pragma once

namespace rink::game {

/// Their `schema`. It rises when a field goes or means something else, not when one is added.
inline constexpr int report_schema = 1;

}  // namespace rink::game
