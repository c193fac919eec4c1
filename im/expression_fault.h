// The fault of an expression and its place, for messages that point at it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rink::im {

/// `what` is the text of `complaint_about`; `character` is the first of the faulty part, counted
/// from 1, or one beyond the last if something is missing at the end.
struct ExpressionFault {
  std::string what;
  std::size_t character = 1;
};

/// What is wrong with `expression`; nothing if `make_filter` takes it.
std::optional<ExpressionFault> fault_in(const std::string& expression);

/// The fault of an expression that must decide relevance at an instant from that instant alone.
/// Schemes do. Stages do not: they depend on what was relevant before or on predicted flights, or
/// decide how often an entity is updated, so the first stage is a fault.
std::optional<ExpressionFault> fault_in_momentary(const std::string& expression);

}  // namespace rink::im
