// The names in experiments and their reports.
#include "loadgen/experiment/experiment.h"

#include "game/replication/update_policy.h"
#include "im/basics/fnv_hash.h"
#include "im/basics/hexadecimal.h"

namespace rink::loadgen {

const char* to_string(TransportKind kind) {
  switch (kind) {
    case TransportKind::tcp:
      return "tcp";
    case TransportKind::udp:
      return "udp";
    case TransportKind::shared_memory:
      return "shm";
    case TransportKind::bundle:
      return "bundle";
    case TransportKind::virtual_time:
      return "virtual";
  }
  return "unknown transport";
}

std::string kept_log_name(const std::string& as_named) {
  return "recorded-" + hexadecimal(hash_of(as_named)) + ".keys";
}

std::vector<std::string> known_policies() { return game::update_policy_names(); }

}  // namespace rink::loadgen
