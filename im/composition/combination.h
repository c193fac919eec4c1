// And, or and not of filters.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "im/composition/parts.h"

namespace rink::im {

/// What to do with the bits that operands said, last in first out: a number below 16 fetches that
/// of an operand, `is_still` is 1 while neither of the pair is swept.
enum class Step : std::uint8_t { conjunction = 16, alternative = 17, negation = 18, is_still = 19 };

/// Relevant while `steps` say so. Where they do so of pairs that no operand lets through, one of
/// the operands must be `none`, which lets all through.
std::unique_ptr<Filter> make_combination(std::vector<std::unique_ptr<Filter>> operands,
                                         std::vector<Step> steps);

/// What `steps` make of the operands' bits.
bool follow(const std::vector<Step>& steps, std::uint16_t says, bool is_still);

}  // namespace rink::im
