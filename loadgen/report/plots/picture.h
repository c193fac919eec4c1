// A plot as a file of its own, so that a paper can include it.
#pragma once

#include <string>
#include <vector>

namespace rink::loadgen {

/// `name` becomes plots/NAME.svg; `svg` is as the page has it.
struct Picture {
  std::string name, svg;
};

/// Names that are there already get -2, -3 and so on.
std::vector<Picture> numbered(std::vector<Picture> pictures);

/// An SVG document that stands alone, on white: width and height in its own units and a little more
/// on each side than the page leaves, and all styles with their colours in place, for many readers
/// of SVG know no CSS variables.
std::string to_file(const Picture& picture);

}  // namespace rink::loadgen
