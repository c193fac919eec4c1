// Compiles the text of a condition or score (docs/im.md, "Conditions").
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "im/pairs/pair_function.h"

namespace rink::im {

enum class Wanted { condition, score };

/// What is wrong with a text; `character` is where the faulty part begins, from 0.
struct ConditionFault {
  std::string what;
  std::size_t character = 0;
};

/// Null if `text` is faulty, which `fault` then says.
std::unique_ptr<PairFunction> compile_condition(std::string_view text, Wanted wanted,
                                                ConditionFault& fault);

}  // namespace rink::im
