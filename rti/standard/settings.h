// Where the RTI is and what object model to use, as a federate's local settings say it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rti/fom/fom.h"

namespace rink::standard {

struct Settings {
  std::string host = "127.0.0.1";
  std::uint16_t port = 7000;
  std::string key_file{};           ///< empty: the RTI asks for no key
  std::string federation = "rink";  ///< that the proof of the key names
  std::vector<std::string>
      fom{};           ///< files; where given, used in place of those the federate names
  std::string time{};  ///< logical time implementation of executions it did not create
};

/// Settings from a designator: empty, HOST, HOST:PORT, rti://HOST:PORT, or KEY=VALUE parted by
/// semicolons or line ends: address (or crcAddress, host), port, key, federation (which the key is
/// for), fom (files parted by commas), time. What it leaves out say the environment's RINK_RTI
/// (address) and RINK_FOM. Throws InvalidLocalSettingsDesignator.
Settings read_settings(const std::wstring& designator);

/// The model of these files, of which one may be a file:// URL; empty names and HLAstandardMIM are
/// left out. Throws CouldNotOpenFDD, ErrorReadingFDD or InconsistentFDD.
std::shared_ptr<const rti::Fom> load_model(const std::vector<std::string>& files);

}  // namespace rink::standard
