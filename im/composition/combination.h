// And, or and not of filters.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "im/composition/parts.h"

namespace rink::im {

/// A step of a stack machine over the operands' bits: a number below 16 pushes that operand's bit,
/// `is_still` pushes 1 while neither of the pair is swept.
enum class Step : std::uint8_t { conjunction = 16, alternative = 17, negation = 18, is_still = 19 };

/// Makes a filter whose pairs are relevant while `steps` give 1. If they do so for pairs that no
/// operand lets through, one of the operands must be `none`, which lets all through.
std::unique_ptr<Filter> make_combination(std::vector<std::unique_ptr<Filter>> operands,
                                         std::vector<Step> steps);

/// The result of `steps` on the operands' bits.
bool follow(const std::vector<Step>& steps, std::uint16_t decisions, bool is_still);

}  // namespace rink::im
