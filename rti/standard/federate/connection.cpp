// Connects a federate of the core.
#include "rti/standard/federate/connection.h"

#include <chrono>

#include "rti/transport/staged/guard.h"

namespace rink::standard {

namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A service waits before so much is unsent (Federate::send_later), but for its own bytes.
constexpr std::size_t queue_max = 64u << 20;

}  // namespace

Connection::Connection(std::shared_ptr<const rti::Fom> model, rti::FederateAmbassador& callbacks,
                       const Settings& settings)
    : model_(std::move(model)),
      tcp_({.queue_max = queue_max}),
      gate_(tcp_),
      core_(*model_, callbacks) {
  if (!settings.key_file.empty())
    gate_.add<rti::Guard>(
        rti::SharedKey::load(settings.key_file),
        rti::GuardSettings{.role = rti::Role::federate, .federation = settings.federation}, now_s);
  link_.emplace(core_, gate_, tcp_.connect(settings.host, settings.port));
  links_.add(*link_);
}

void Connection::flush() { links_.flush(now_s()); }

void Connection::exchange() {
  flush();
  gate_.poll(std::chrono::nanoseconds(0), links_);
  if (!core_.outgoing().empty()) flush();
}

}  // namespace rink::standard
