// Ticks whenever something has come, so that an answer waits for nothing.
#include "game/apps/rti/rti_host.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>

#include "game/apps/command.h"
#include "game/net/address.h"
#include "game/net/gate.h"
#include "rti/save/save_directory.h"

namespace rink::game {
namespace {

rti::DirectorySettings settings_of(const RtiOptions& options) {
  rti::DirectorySettings settings;
  settings.federation.filter = options.scheme;
  settings.federation.federate_max = options.federates_max;
  settings.execution_max = options.executions_max;
  if (!options.save.empty())
    settings.services.save_store = std::make_shared<rti::SaveDirectory>(options.save);
  return settings;
}

/// Names are not trusted, so what controls a terminal is replaced: also U+0080 to U+009F, which are
/// C2 80 to C2 9F in UTF-8.
std::string shown(std::string name) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto at = [&](std::size_t k) { return static_cast<unsigned char>(name[k]); };
    const bool is_c1 = at(i) == 0xc2 && i + 1 < name.size() && at(i + 1) < 0xa0;
    if (at(i) < 32 || at(i) == 127 || is_c1) name[i] = '?';
    if (is_c1) name[i + 1] = '?';
  }
  return name;
}

void print(const char* what, const rti::FederateReport& federate, const std::string& federation) {
  std::printf("federate %s (%s) has %s federation %s\n", shown(federate.name).c_str(),
              shown(federate.type).c_str(), what, shown(federation).c_str());
}

/// `all` ascend by handle.
bool has(const std::vector<rti::FederateReport>& all, const rti::FederateReport& federate) {
  return std::ranges::binary_search(all, federate.federate, {}, &rti::FederateReport::federate);
}

}  // namespace

RtiHost::RtiHost(const RtiOptions& options, const rti::Fom& fom)
    : options_(options),
      directory_(settings_of(options)),
      sockets_(options.transport),
      gate_(sockets_.get()),
      host_(directory_) {
  if (!options.key_file.empty() && options.federations.size() != 1)
    throw std::runtime_error(
        "--key-file: proofs name one federation: give one --federation with it");
  add_gate(gate_,
           {.key_file = options.key_file,
            .federation = options.federations.empty() ? "rink" : options.federations.front(),
            .rate_limit = {options.rate_limit_bytes_per_s, options.frame_limit_per_s},
            .address_limit = options.address_limit},
           now_s);
  directory_.offer(fom);
  for (const std::string& federation : options.federations)
    if (const rti::HlaError error = directory_.create(federation, fom.hash());
        error != rti::HlaError::none)
      throw std::runtime_error("--federation: '" + federation + "': " + to_string(error));
  host_.add(gate_);
  directory_.advance_clock(now_s());
}

std::uint16_t RtiHost::listen() {
  const auto [address, port] = address_and_port("--listen", options_.listen, 0);
  return sockets_.listen(address, port);
}

void RtiHost::serve(double seconds) {
  host_.poll(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(seconds)));
  host_.advance_clock(now_s());
  host_.match();
  host_.flush();
  constexpr double look_s = 0.25;
  if (now_s() < printed_s_ + look_s) return;
  print_changes();
  printed_s_ = now_s();
}

/// Compares who is joined with who was: what came and went within a look is not told.
void RtiHost::print_changes() {
  Joined now;
  for (const auto& each : directory_.list())
    std::ranges::sort(now[each.federation] = directory_.find(each.federation)->report().federates,
                      {}, &rti::FederateReport::federate);
  for (const auto& [federation, federates] : joined_) {
    const auto found = now.find(federation);
    for (const rti::FederateReport& each : federates)
      if (found == now.end() || !has(found->second, each)) print("left", each, federation);
    if (found == now.end()) std::printf("federation %s is destroyed\n", shown(federation).c_str());
  }
  for (const auto& [federation, federates] : now) {
    const auto before = joined_.find(federation);
    if (before == joined_.end())
      std::printf("federation %s is created\n", shown(federation).c_str());
    for (const rti::FederateReport& each : federates)
      if (before == joined_.end() || !has(before->second, each)) print("joined", each, federation);
  }
  joined_ = std::move(now);
  std::fflush(stdout);
}

void RtiHost::end() {
  print_changes();
  host_.close_all("the RTI has ended");
}

}  // namespace rink::game
