// Every kind of transport as a pair of ends, so that one suite can hold them all to the contract.
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "rti/transport/transport.h"

namespace rink::rti::testing {

/// A server's end, a client's end, and how the second reaches the first.
class TransportKit {
 public:
  virtual ~TransportKit() = default;
  virtual Transport& server() = 0;
  virtual Transport& client() = 0;
  virtual ConnectionId connect() = 0;
  virtual ConnectionId connect_to_nobody() = 0;
  /// Ends the server and starts another one at the same address.
  virtual void restart_server() = 0;
  /// Lets what was sent arrive, where a clock of the kit's own decides that.
  virtual void pass_time() {}
  /// Has the server's side queue no more than so much from the next restart on; false if the kind
  /// knows no limit.
  virtual bool limit_queue(std::size_t /*queue_max*/) { return true; }

  bool can_wait = true;           ///< `poll` waits, and another thread's sending wakes it
  std::size_t connections = 500;  ///< a crowd that it must carry
};

struct KitChoice {
  std::string name;
  std::function<std::unique_ptr<TransportKit>()> make;
  friend std::ostream& operator<<(std::ostream& out, const KitChoice& choice) {
    return out << choice.name;
  }
};
std::vector<KitChoice> transport_kits();

}  // namespace rink::rti::testing
