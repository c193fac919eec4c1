// The frame around the sections.
#include "loadgen/report/page.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "loadgen/report/plots/style.h"
#include "loadgen/report/plots/text.h"

namespace rink::loadgen {

void Page::add(const std::string& id, const std::string& title, Exhibit exhibit) {
  assert(!id.empty() && id.find_first_of("\"<>& ") == std::string::npos && "it stands in a link");
  contents_ += (contents_.empty() ? "" : " \xC2\xB7 ") + std::string("<a href=\"#") + id + "\">" +
               escaped(title) + "</a>\n";
  body_ += "<section id=\"" + id + "\">\n<h2>" + escaped(title) + "</h2>\n" + exhibit.html +
           "</section>\n";
  std::move(exhibit.tables.begin(), exhibit.tables.end(), std::back_inserter(tables_));
  std::move(exhibit.pictures.begin(), exhibit.pictures.end(), std::back_inserter(pictures_));
}

Report Page::finished(const std::string& title, const std::string& introduction) && {
  const std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta "
      "name=\"viewport\" content=\"width=device-width\"/>\n<title>" +
      escaped(title) + "</title>\n<style>" + report_style() + "</style>\n</head>\n<body>\n<h1>" +
      escaped(title) + "</h1>\n" + introduction + "<nav>" + contents_ + "</nav>\n" + body_ +
      "</body>\n</html>\n";
  return {html, std::move(tables_), numbered(std::move(pictures_))};
}

Exhibit provenance_list(const Provenance& provenance) {
  Exhibit exhibit{"<dl>\n"};
  for (const auto& [name, text] : provenance.facts)
    exhibit.html += "<dt>" + escaped(name) + "</dt><dd>" + escaped(text) + "</dd>\n";
  exhibit.html += "</dl>\n";
  return exhibit;
}

}  // namespace rink::loadgen
