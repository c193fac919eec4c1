// What the host of a federation execution tells federates itself, beside what the RTI tells them.
#include <gtest/gtest.h>

#include "tests/rti/bare.h"

namespace rink::rti::testing {
namespace {

struct Listener final : Recorder {
  std::vector<std::string> told;
  void receive_host_message(Bytes content) override { told.push_back(text_of(content)); }
};

/// A federate on connection 1 beside the witness.
struct Served {
  Bare bare;
  Listener heard;
  Ambassador guest{harbour(), heard};
  Served() {
    bare.execution.connect(1);
    guest.join("rink", "guest", "tester");
    pass_on();
    guest.subscribe_object_class_attributes(vessel, motion);
    pass_on();
  }
  bool pass_on() {
    bare.execution.receive(1, guest.outgoing());
    guest.clear_outgoing();
    bare.tick();
    const std::vector<std::byte> bytes = std::move(bare.sent[1]);
    bare.sent[1].clear();
    return guest.receive(bytes);
  }
};

TEST(HostMessages, ReachTheirFederateAloneBehindAllElse) {
  Served served;
  served.bare.execution.send_host_message(served.guest.federate(), bytes_of("one"));
  served.bare.execution.send_host_message(served.guest.federate(), bytes_of(""));
  served.bare.execution.send_host_message(FederateHandle{99}, bytes_of("nobody"));
  EXPECT_TRUE(served.pass_on());
  EXPECT_EQ(served.heard.told, (std::vector<std::string>{"one", ""}));
  EXPECT_TRUE(served.pass_on());
  EXPECT_EQ(served.heard.told.size(), 2u);
}

TEST(HostMessages, ANoticeIsTakenOnce) {
  Served served;
  EXPECT_FALSE(served.bare.execution.take_notice(served.guest.federate()));
  served.guest.notify_host(), served.guest.notify_host();
  served.pass_on();
  EXPECT_TRUE(served.bare.execution.take_notice(served.guest.federate()));
  EXPECT_FALSE(served.bare.execution.take_notice(served.guest.federate()));
  EXPECT_FALSE(served.bare.execution.take_notice(FederateHandle{99}));
  Recorder outside;
  Ambassador stranger(harbour(), outside);
  EXPECT_THROW(stranger.notify_host(), RtiException);
}

TEST(HostMessages, WhoIsServedByTheHostHasAScopeAndIsToldNothingOfIt) {
  Served served;
  const FederateHandle guest = served.guest.federate();
  served.bare.execution.serve_by_host(guest, vessel);
  const ObjectHandle ship = served.bare.witness.register_object_instance(vessel, "ship");
  served.bare.witness.update_attribute_values(ship, motion, values_of(1.0f, 2.0f, 3.0f), {});
  EXPECT_TRUE(served.pass_on());
  EXPECT_TRUE(served.heard.objects.empty());
  EXPECT_TRUE(served.bare.execution.scope(guest)->contains(served.bare.execution.slot_of(ship)));
  std::vector<FederateHandle> subscribers;
  served.bare.execution.list_subscribers(vessel, speed, subscribers);
  EXPECT_EQ(subscribers, (std::vector{served.bare.witness.federate(), guest}));
  served.bare.witness.update_attribute_values(ship, motion, values_of(4.0f, 5.0f, 6.0f), {});
  EXPECT_TRUE(served.pass_on());
  EXPECT_TRUE(served.heard.objects.empty());
  served.bare.execution.serve_by_host(guest, {});
  EXPECT_TRUE(served.pass_on());
  ASSERT_TRUE(served.heard.objects.contains(ship.value));
  EXPECT_TRUE(served.heard.objects[ship.value].is_in_scope);
  EXPECT_EQ(served.heard.objects[ship.value].values[speed.value], values_of(6.0f));
  EXPECT_EQ(served.bare.execution.scope(FederateHandle{99}), nullptr);
}

TEST(HostMessages, OfAWrongSizeEndTheConnection) {
  for (const std::string wrong : {"\x7a\x05shor", "\x7a\x81\x80\x80\x08x", "\x7a"}) {
    Served served;
    std::vector<std::byte> bytes = values_of(static_cast<std::uint32_t>(wrong.size()));
    const std::vector<std::byte> content = bytes_of(wrong);
    bytes.insert(bytes.end(), content.begin(), content.end());
    EXPECT_FALSE(served.guest.receive(bytes)) << wrong.size();
    EXPECT_NE(served.heard.lost, "");
  }
}

}  // namespace
}  // namespace rink::rti::testing
