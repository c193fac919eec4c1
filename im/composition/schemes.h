// Makes schemes by their plain names, for compositions.
#pragma once

#include <memory>
#include <string>

namespace rink::im {

class Filter;
struct FilterSettings;

/// The registered scheme called `name`, or nothing if there is none.
std::unique_ptr<Filter> make_scheme(const std::string& name, const FilterSettings& settings);

}  // namespace rink::im
