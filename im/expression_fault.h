// What is wrong with an expression and where, for whoever points a writer at it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rink::im {

/// `what` as `complaint_about` says it; `character` is the first of the offender, counted from 1,
/// or one beyond the last if something is missing at the end.
struct ExpressionFault {
  std::string what;
  std::size_t character = 1;
};

/// What is wrong with `expression`; nothing if `make_filter` takes it.
std::optional<ExpressionFault> fault_in(const std::string& expression);

/// The same where it has to say what is relevant at an instant from how things are at that instant.
/// Schemes do. Stages do not: they go by what was relevant before, by what is foreseen, or by how
/// often something is told, so the first of them is a fault.
std::optional<ExpressionFault> fault_in_momentary(const std::string& expression);

}  // namespace rink::im
