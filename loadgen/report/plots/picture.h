// Writes a plot as a file of its own, so that a paper can include it.
#pragma once

#include <string>
#include <vector>

namespace rink::loadgen {

/// `name` becomes plots/NAME.svg; `svg` is as the page has it.
struct Picture {
  std::string name, svg;
};

/// Repeated names get -2, -3 and so on.
std::vector<Picture> numbered(std::vector<Picture> pictures);

/// A self-contained SVG document on white: width and height in its own units, a little more room on
/// each side than on the page, and all styles with their colours in place, since many readers of
/// SVG do not support CSS variables.
std::string to_file(const Picture& picture);

}  // namespace rink::loadgen
