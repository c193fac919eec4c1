// The frame around the sections.
#include "loadgen/report/page.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "loadgen/report/plots/style.h"
#include "loadgen/report/plots/text.h"

namespace rink::loadgen {

void Page::add(const std::string& id, const std::string& title, SectionContent content) {
  assert(!id.empty() && id.find_first_of("\"<>& ") == std::string::npos && "it stands in a link");
  contents_ += (contents_.empty() ? "" : " \xC2\xB7 ") + std::string("<a href=\"#") + id + "\">" +
               escaped(title) + "</a>\n";
  body_ += "<section id=\"" + id + "\">\n<h2>" + escaped(title) + "</h2>\n" + content.html +
           "</section>\n";
  std::move(content.tables.begin(), content.tables.end(), std::back_inserter(tables_));
  std::move(content.pictures.begin(), content.pictures.end(), std::back_inserter(pictures_));
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

SectionContent provenance_list(const Provenance& provenance) {
  SectionContent content{"<dl>\n"};
  for (const auto& [name, text] : provenance.facts)
    content.html += "<dt>" + escaped(name) + "</dt><dd>" + escaped(text) + "</dd>\n";
  content.html += "</dl>\n";
  return content;
}

}  // namespace rink::loadgen
