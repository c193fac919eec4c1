// One HTML page that needs neither network nor script, made of sections.
#pragma once

#include <string>
#include <vector>

#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {

struct Report {
  std::string html;
  std::vector<PlotTable> tables;  ///< for plots/NAME.csv
  std::vector<Picture> pictures;  ///< for plots/NAME.svg: each has a name of its own
};

/// Sections in the order of the page, with the list of contents that leads to them.
class Page {
 public:
  /// `id` of letters and dashes.
  void add(const std::string& id, const std::string& title, SectionContent content);
  /// Finishes the page with `introduction`, markup, above the contents; `title` is text.
  Report finished(const std::string& title, const std::string& introduction) &&;

 private:
  std::string contents_, body_;
  std::vector<PlotTable> tables_;
  std::vector<Picture> pictures_;
};

/// The facts as a list.
SectionContent provenance_list(const Provenance& provenance);

}  // namespace rink::loadgen
