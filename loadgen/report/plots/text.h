// Numbers and texts as a page shows them.
#pragma once

#include <optional>
#include <string>

namespace rink::loadgen {

/// `text` with &, <, >, " and ' as entities and control characters replaced, fit for HTML and SVG
/// content and attributes.
std::string escaped(const std::string& text);

/// `value` with three digits, or as many as said, and a k, M or G where it helps, e.g. `1.5 k`.
std::string short_number(double value, int digits = 3);
/// The same with its unit, e.g. `606 B/s`, `1.5 kB/s`.
std::string short_bytes_per_s(double value);

/// `value` with `digits` significant digits and never an exponent, e.g. 0.0123, 12.3, 1230; an
/// n-dash if absent.
std::string plain_number(std::optional<double> value, int digits = 3);

/// All digits that tell `value` from its neighbours, for files; empty if absent.
std::string exact_number(std::optional<double> value);

}  // namespace rink::loadgen
