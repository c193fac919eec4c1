// The text of one module of a federation object model, and the error of a faulty one.
#pragma once

#include <stdexcept>
#include <string>

#include "rti/hla_error.h"

namespace rink::rti {

/// A FOM or federation file that can't be used; `what` names file, line, element or key, and what
/// is allowed.
class FileError : public std::runtime_error {
 public:
  explicit FileError(const std::string& what, HlaError error = HlaError::error_reading_fdd)
      : std::runtime_error(what), error_(error) {}
  /// CouldNotOpenFDD, ErrorReadingFDD, or InconsistentFDD for modules that contradict each other.
  HlaError error() const { return error_; }

 private:
  HlaError error_;
};

/// The text of one OMT XML module. `source` stands for the file's name in errors; only the
/// standard's own may define names that begin with HLA.
struct FomModule {
  std::string xml;
  std::string source;
  bool is_standard = false;
};
/// Throws `FileError`.
FomModule read_fom_module(const std::string& path);

}  // namespace rink::rti
