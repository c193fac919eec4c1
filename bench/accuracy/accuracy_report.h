// The diagram and the stability table as one page that reads offline.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/accuracy/diagram.h"
#include "bench/accuracy/stability.h"
#include "loadgen/report/provenance.h"
#include "loadgen/report/report.h"

namespace rink::accuracy {

struct Findings {
  std::vector<Panel> panels{};
  std::vector<Ordeal> ordeals{};
  std::vector<std::string> absences{};  ///< sentences
  bool is_interrupted = false;
};

/// A plot and a table for each panel, a table for all ordeals; what is not there is left out.
loadgen::Report report_of(const Findings& findings, const loadgen::Provenance& provenance);

}  // namespace rink::accuracy
