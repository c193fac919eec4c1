// The loop of a federate's program.
#include "rti/transport/tcp_federate.h"

#include <chrono>

#include "rti/transport/staged/guard.h"

namespace rink::rti {

namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

TcpFederate::TcpFederate(const Fom& model, FederateAmbassador& callbacks, const RtiPlace& place)
    : gate_(tcp_), ambassador_(model, callbacks) {
  if (!place.key_file.empty())
    gate_.add<Guard>(SharedKey::load(place.key_file),
                     GuardSettings{.role = Role::federate, .federation = place.federation}, now_s);
  link_.emplace(ambassador_, gate_, tcp_.connect(place.host, place.port));
  links_.add(*link_);
}

/// Bytes wake it at once; the wait is that of heartbeats.
void TcpFederate::exchange() {
  links_.flush(now_s());
  gate_.poll(std::chrono::milliseconds(20), links_);
}

bool TcpFederate::run(const std::function<bool()>& is_done) {
  while (!is_done()) {
    if (link_->is_finished()) return false;
    exchange();
  }
  links_.flush(now_s());
  return true;
}

bool TcpFederate::run_for(double seconds) {
  const double until = now_s() + seconds;
  return run([until] { return now_s() >= until; });
}

void TcpFederate::resign(double longest_s) {
  const double until = now_s() + longest_s;
  if (ambassador_.is_joined()) ambassador_.resign();
  if (!link_->is_finished()) link_->close();
  while (!link_->is_finished() && now_s() < until) exchange();
}

}  // namespace rink::rti
