// A federate of the core with its connection to the RTI over TCP.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "rti/ambassador.h"
#include "rti/standard/settings.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/staged/staged_transport.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::standard {

/// Joins one federation execution at most: a core has one object model for life. Not thread safe.
class Connection {
 public:
  /// The callbacks must outlive it. Throws `TransportError` if the host has no such address,
  /// std::runtime_error for a key file.
  Connection(std::shared_ptr<const rti::Fom> model, rti::FederateAmbassador& callbacks,
             const Settings& settings);

  rti::Ambassador& core() { return core_; }
  const rti::Fom& model() const { return *model_; }
  bool is_open() const { return link_->is_open(); }
  bool is_finished() const { return link_->is_finished(); }
  /// Why it is finished.
  std::string end() const { return rti::to_string(link_->close_reason()); }
  /// Sends what waits.
  void flush();
  /// The same, and calls back what has arrived.
  void exchange();
  /// A file that can be read when something has arrived.
  int wait_file() const { return tcp_.wait_file(); }
  /// More may have arrived than the last `exchange` has read.
  bool is_behind() const { return gate_.is_behind(); }
  /// Sent, but not yet taken by the operating system [bytes].
  std::size_t unsent_bytes() const { return gate_.queued_bytes(link_->connection()); }

 private:
  std::shared_ptr<const rti::Fom> model_;
  rti::TcpTransport tcp_;
  rti::StagedTransport gate_;
  rti::Ambassador core_;
  std::optional<rti::FederateLink> link_;
  rti::FederateLinks links_;
};

}  // namespace rink::standard
