// Reads a module's file.
#include "rti/fom/fom_module.h"

#include <fstream>
#include <sstream>

namespace rink::rti {

FomModule read_fom_module(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    throw FileError(path + ": can't be read; expected an OMT XML file",
                    HlaError::could_not_open_fdd);
  return {text.str(), path};
}

}  // namespace rink::rti
