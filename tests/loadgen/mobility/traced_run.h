// Runs of a mobility trace under a virtual clock, and where its agents are by interpolation.
#pragma once

#include <fstream>
#include <map>
#include <string>

#include "loadgen/mobility/trace_formats.h"
#include "loadgen/mobility/trace_models.h"
#include "loadgen/mobility/trace_scene.h"
#include "tests/loadgen/mobility/agent_places.h"
#include "tests/loadgen/run/virtual_experiment.h"

namespace rink::loadgen {

class TracedRunTest : public VirtualRunTest {
 protected:
  TracedRunTest() {
    experiment_.scene = folder_ / "walk.toml";
    experiment_.population = Population::fixed;
    experiment_.clients = {8};
    experiment_.view_area = 400.0;
    experiment_.view_margins = {0.0};
    experiment_.delay_ms = 0.0;
    experiment_.duration_s = 1.0;
  }

  void write(const char* name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  /// A scene of the trace `text`, in `file`.
  void write_scene(const char* file, const std::string& text, const std::string& more = "") const {
    write(file, text);
    write("walk.toml",
          std::string("[[population]]\nkind = \"trace\"\nfile = \"") + file + "\"\n" + more);
  }
  PlayedScene played(const Cell& cell) const { return played_scene(choice_of(experiment_, cell)); }
  std::string refusal() const {
    try {
      key_log(cells_of(experiment_).front());
    } catch (const ExperimentError& error) {
      return error.what();
    }
    return "no complaint";
  }
};

}  // namespace rink::loadgen
