// Strangers' own bytes against an execution without any transport, beside a good federate that must
// never be harmed.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rti/wire/declaration_messages.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/message.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {

inline const auto vessel_number = static_cast<std::uint16_t>(vessel.value);

/// Frames as a stranger would make them.
template <class... Messages>
std::vector<std::byte> frame_of(Messages... messages) {
  FrameWriter frame(frame_max_to_rti);
  const auto add = [&](auto& message) {
    write(frame.begin_message(measure(message)), message);
    frame.appended();
  };
  (add(messages), ...);
  return {frame.bytes().begin(), frame.bytes().end()};
}

inline JoinMessage join_of(std::string_view name) {
  JoinMessage message;
  message.fom_hash = harbour().hash();
  message.federation = "rink";
  message.name = name;
  message.type = "tester";
  return message;
}

/// An execution without any transport, which keeps what it sends.
struct Bare final : Outlet {
  FederationExecution execution;
  std::map<ConnectionId, std::vector<std::byte>> sent;
  std::map<ConnectionId, std::string> dropped;
  std::map<ConnectionId, int> sends;
  std::size_t witness_bytes = 0;  ///< sent to it
  Recorder witness_heard;
  Ambassador witness{
      harbour(), witness_heard};  ///< a good federate that must never be harmed, on connection 0
  std::size_t datagram_size =
      0;  ///< what connections but the witness's carry; their datagrams are lost

  explicit Bare(const FederationSettings& settings = {}) : execution(harbour(), settings) {
    execution.connect(0);
    witness.join("rink", "witness", "tester");
    tick();
    witness.watch_federates();
    witness.subscribe_object_class_attributes(vessel, AttributeSet{position, speed});
    witness.publish_object_class_attributes(vessel, AttributeSet{position, speed});
    tick();
  }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    ++sends[connection];
    for (const Bytes part : parts) {
      if (connection == 0) witness_bytes += part.size();
      if (connection == 0) EXPECT_TRUE(witness.receive(part));
      else sent[connection].insert(sent[connection].end(), part.begin(), part.end());
    }
  }
  std::size_t datagram_max(ConnectionId connection) const override {
    return connection == 0 ? 0 : datagram_size;
  }
  void drop(ConnectionId connection, std::string_view why) override { dropped[connection] = why; }
  void tick() {
    execution.receive(0, witness.outgoing());
    witness.clear_outgoing();
    execution.match();
    execution.flush(*this);
  }
  /// The witness gives a sign of life.
  void pass(double now) {
    witness.advance_clock(now);
    execution.receive(0, witness.outgoing());
    witness.clear_outgoing();
    execution.advance_clock(now);
    tick();
  }
  void enter(ConnectionId connection, std::string_view name) {
    execution.connect(connection);
    execution.receive(connection, frame_of(join_of(name)));
    tick();
  }
  std::uint64_t drops(Violation violation) {
    return execution.counters().drops[static_cast<std::size_t>(violation)];
  }
};

}  // namespace rink::rti::testing
