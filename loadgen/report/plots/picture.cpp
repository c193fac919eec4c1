// Puts size, paper and styles into a picture of the page.
#include "loadgen/report/plots/picture.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <map>
#include <utility>

#include "loadgen/report/plots/style.h"
#include "loadgen/report/plots/svg.h"

namespace rink::loadgen {
namespace {

constexpr double margin =
    10.0;  // labels of the outermost ticks pass the frame by up to half their width

/// The value of the light colour called `name`; the page's cards are paper here.
std::string colour(const std::string& name) {
  const std::string all = light_colours, key = name == "--card" ? "--paper:" : name + ":";
  const std::size_t at = all.find(key);
  assert(at != std::string::npos);
  const std::size_t begin = at + key.size();
  return all.substr(begin, std::min(all.find(';', begin), all.size()) - begin);
}

std::string style_with_colours() {
  std::string style = picture_style;
  for (std::size_t at = style.find("var("); at != std::string::npos; at = style.find("var(", at)) {
    const std::size_t end = style.find(')', at);
    style.replace(at, end + 1 - at, colour(style.substr(at + 4, end - at - 4)));
  }
  return style;
}

/// The opening tag's width and height.
std::pair<double, double> size_of(const std::string& svg) {
  const std::string opening = "<svg viewBox=\"0 0 ";
  assert(svg.starts_with(opening));
  char* rest = nullptr;
  const double width = std::strtod(svg.c_str() + opening.size(), &rest);
  return {width, std::strtod(rest, nullptr)};
}

}  // namespace

std::vector<Picture> numbered(std::vector<Picture> pictures) {
  std::map<std::string, int> count;
  for (Picture& picture : pictures) {
    const int place = ++count[picture.name];
    if (place > 1) picture.name += "-" + std::to_string(place);
  }
  return pictures;
}

std::string to_file(const Picture& picture) {
  const auto [width, height] = size_of(picture.svg);
  const auto sizes =
      attributes({{"width", width + 2.0 * margin}, {"height", height + 2.0 * margin}});
  const std::string corner = coordinate(-margin), box = corner + " " + corner + " " +
                                                        coordinate(width + 2.0 * margin) + " " +
                                                        coordinate(height + 2.0 * margin);
  const std::size_t rest = picture.svg.find(" role=");
  assert(rest != std::string::npos && "svg_opening() says what the picture is");
  const std::size_t content = picture.svg.find('>', rest) + 1;
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg viewBox=\"" + box + "\"" + sizes +
         picture.svg.substr(rest, content - rest) + "\n<style>" + style_with_colours() +
         "</style>\n<rect" + attributes({{"x", -margin}, {"y", -margin}}) + sizes + " fill=\"" +
         colour("--paper") + "\"/>" + picture.svg.substr(content);
}

}  // namespace rink::loadgen
