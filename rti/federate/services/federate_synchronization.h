// The services by which a federate registers and achieves synchronisation points (IEEE 1516.1-2010,
// 4.11 to 4.15).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rti/federate/ambassador_basis.h"
#include "rti/wire/state_stream.h"
#include "rti/wire/stream.h"

namespace rink::rti {

class FederateSynchronization {
 public:
  explicit FederateSynchronization(const AmbassadorBasis& basis) : basis_(basis) {}

  void register_point(std::string_view label, Bytes tag, std::span<const FederateHandle> members);
  /// Throws SynchronizationPointLabelNotAnnounced.
  void achieve(std::string_view label, bool is_success);

  bool handle_registered(Reader& reader);
  bool handle_announced(Reader& reader);
  bool handle_synchronized(Reader& reader);
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, announced_);
  }

 private:
  AmbassadorBasis basis_;
  std::vector<std::string> announced_;  ///< labels that this federate has not achieved yet
};

}  // namespace rink::rti
