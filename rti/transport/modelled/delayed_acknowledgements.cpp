// Counts pairs of full segments, and what a timer would acknowledge.
#include "rti/transport/modelled/delayed_acknowledgements.h"

namespace rink::rti {

void DelayedAcknowledgements::received(std::size_t bytes, std::int64_t now_ns) {
  settle(now_ns);
  const std::size_t full = bytes / full_segment + (is_odd_ ? 1 : 0);
  count_ += full / 2;
  is_odd_ = full % 2 != 0;
  if (full >= 2) is_waiting_ = false;  // all before the last pair is acknowledged with it
  if (is_waiting_ || (!is_odd_ && bytes % full_segment == 0)) return;
  is_waiting_ = true;
  due_ns_ = now_ns + delay_ns;
}

void DelayedAcknowledgements::sent(std::int64_t now_ns) {
  settle(now_ns);
  is_waiting_ = is_odd_ = false;
}

void DelayedAcknowledgements::settle(std::int64_t now_ns) {
  count_ = count(now_ns);
  if (is_waiting_ && now_ns >= due_ns_) is_waiting_ = is_odd_ = false;
}

}  // namespace rink::rti
