// A federation without transports whose members are of the test's own kind: services in, callbacks
// out.
#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "tests/rti/errors.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {

/// `Heard` is a `Recorder` that writes what matters to the test into `told`.
template <class Heard>
class Company : private Outlet {
 public:
  struct Member {
    Heard heard;
    Ambassador ambassador{harbour(), heard};
  };
  FederationExecution execution{harbour(), settings()};
  std::deque<Member> members;
  std::size_t dropped = 0;
  Ambassador &pilot = join("pilot"), &coast = join("coast");
  Heard &pilot_heard = members[0].heard, &coast_heard = members[1].heard;

  Ambassador& join(const std::string& name) {
    Member& member = members.emplace_back();
    execution.connect(static_cast<ConnectionId>(members.size() - 1));
    member.ambassador.join("rink", name, "tester");
    settle();
    return member.ambassador;
  }
  void settle() {
    for (int round = 0; round < 3; ++round) {
      for (ConnectionId id = 0; id < members.size(); ++id) {
        execution.receive(id, members[id].ambassador.outgoing());
        members[id].ambassador.clear_outgoing();
      }
      execution.match();
      execution.flush(*this);
    }
  }
  /// What it was told since it was last asked.
  std::vector<std::string> told(Heard& heard) {
    settle();
    return std::exchange(heard.told, {});
  }

 private:
  static FederationSettings settings() {
    FederationSettings settings;
    settings.filter = "region";
    return settings;
  }
  void send(ConnectionId id, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) EXPECT_TRUE(members[id].ambassador.receive(part));
  }
  void drop(ConnectionId, std::string_view) override { ++dropped; }
};

}  // namespace rink::rti::testing
