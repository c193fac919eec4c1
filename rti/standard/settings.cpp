// Reads local settings and object models.
#include "rti/standard/settings.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "rti/standard/errors.h"
#include "rti/standard/wide_text.h"

namespace rink::standard {

namespace {

[[noreturn]] void refuse_designator(const std::string& what) {
  throw rti1516e::InvalidLocalSettingsDesignator(
      to_wide(what + "; expected HOST:PORT, or address=, port=, key=, fom= and time= parted by ;"));
}

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char letter) { return letter == ' ' || letter == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string> parted(std::string_view text, std::string_view separators) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(separators), text.size());
    if (const std::string_view part = trimmed(text.substr(0, end)); !part.empty())
      parts.emplace_back(part);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

std::uint16_t port_of(const std::string& text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size() || port == 0)
    refuse_designator("'" + text + "' is no port");
  return port;
}

void read_address(Settings& settings, std::string_view text) {
  for (const std::string_view scheme : {"rti://", "tcp://"})
    if (text.starts_with(scheme)) text.remove_prefix(scheme.size());
  while (text.ends_with('/')) text.remove_suffix(1);
  const std::size_t colon = text.rfind(':');
  // Of an IPv6 address without brackets, no colon is that of a port.
  const bool has_port = colon != std::string_view::npos &&
                        (text.find(':') == colon || (colon > 0 && text[colon - 1] == ']'));
  std::string_view host = has_port ? text.substr(0, colon) : text;
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  if (host.empty()) refuse_designator("'" + std::string(text) + "' names no host");
  settings.host = host;
  if (has_port) settings.port = port_of(std::string(text.substr(colon + 1)));
}

void read_pair(Settings& settings, std::string_view key, const std::string& value) {
  if (key == "address" || key == "crcAddress" || key == "host") read_address(settings, value);
  else if (key == "port" || key == "crcPort") settings.port = port_of(value);
  else if (key == "key") settings.key_file = value;
  else if (key == "federation") settings.federation = value;
  else if (key == "fom") settings.fom = parted(value, ",");
  else if (key == "time") settings.time = value;
  else refuse_designator("there is no setting '" + std::string(key) + "'");
}

}  // namespace

Settings read_settings(const std::wstring& designator) {
  Settings settings;
  if (const char* const address = std::getenv("RINK_RTI")) read_address(settings, address);
  if (const char* const fom = std::getenv("RINK_FOM")) settings.fom = parted(fom, ",");
  for (const std::string& part : parted(to_utf8(designator), ";\n")) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos) read_address(settings, part);
    else
      read_pair(settings, trimmed(std::string_view(part).substr(0, equals)),
                std::string(trimmed(std::string_view(part).substr(equals + 1))));
  }
  if (!settings.time.empty() && settings.time != "HLAfloat64Time" &&
      settings.time != "HLAinteger64Time")
    refuse_designator("'" + settings.time + "' is neither HLAfloat64Time nor HLAinteger64Time");
  return settings;
}

std::shared_ptr<const rti::Fom> load_model(const std::vector<std::string>& files) {
  std::vector<std::string> paths;
  for (const std::string& file : files) {
    constexpr std::string_view url = "file://";
    if (file.empty() || file == "HLAstandardMIM") continue;
    paths.push_back(file.starts_with(url) ? file.substr(url.size()) : file);
  }
  if (paths.empty())
    throw rti1516e::CouldNotOpenFDD(
        L"no object model is named: name its modules where the federation execution is created or "
        L"joined, in the local settings (fom=FILE,FILE), or in RINK_FOM");
  try {
    return std::make_shared<const rti::Fom>(rti::Fom::load(paths));
  } catch (const rti::FileError& error) {
    throw_standard(error.error(), error.what());
  }
}

}  // namespace rink::standard
