// Whoever claims attributes that it does not own, by bytes that no ambassador sends, is dropped and
// named; what it never owned stays where it is.
#include <gtest/gtest.h>

#include "rti/wire/object_block.h"
#include "rti/wire/ownership_messages.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

/// The owner of a vessel on connection 0, a villain who knows it on connection 1.
struct Scene final : Outlet {
  FederationExecution execution{harbour(), {}};
  Recorder heard[2];
  Ambassador owner{harbour(), heard[0]}, villain{harbour(), heard[1]};
  bool is_dropped[2] = {};
  ObjectHandle vessel_1;

  Scene() {
    for (ConnectionId each : {0u, 1u}) execution.connect(each);
    owner.join("rink", "owner", "tester");
    tick();
    owner.publish_object_class_attributes(vessel, motion);
    vessel_1 = owner.register_object_instance(vessel);
    tick();
    villain.join("rink", "villain", "tester");
    tick();
    villain.subscribe_object_class_attributes(vessel, motion);
    tick();
  }
  Ambassador& federate(ConnectionId connection) { return connection == 0 ? owner : villain; }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) EXPECT_TRUE(federate(connection).receive(part));
  }
  void drop(ConnectionId connection, std::string_view) override { is_dropped[connection] = true; }
  void tick() {
    for (ConnectionId each : {0u, 1u}) {
      execution.receive(each, federate(each).outgoing());
      federate(each).clear_outgoing();
    }
    execution.match();
    execution.flush(*this);
  }
  /// One frame of one message about one object, or without an object.
  template <class Message>
  void say(Message message, std::optional<ObjectHandle> object) {
    FrameWriter frame(frame_max_to_rti);
    std::vector<std::byte>& bytes = frame.begin_message(measure(message) + object_record_max);
    if (object) ObjectBlockWriter().append(bytes, message, object->value);
    else write(bytes, message);
    frame.appended();
    execution.receive(1, frame.bytes());
    tick();
  }
};

OwnershipRequestMessage asking(OwnershipRequest request, AttributeSet attributes) {
  return {static_cast<std::uint8_t>(request), attributes.bits, {}};
}

struct OwnershipCrime {
  const char* name;
  Violation violation;
  OwnershipRequest request;
  AttributeSet attributes = motion;
  std::uint32_t object = 0;
  bool is_publisher = true;
};

class OwnershipCrimes : public ::testing::TestWithParam<OwnershipCrime> {};

TEST_P(OwnershipCrimes, IsNamedCountedAndDroppedAndTakesNothing) {
  Scene scene;
  const OwnershipCrime& crime = GetParam();
  if (crime.is_publisher) scene.villain.publish_object_class_attributes(vessel, motion);
  scene.tick();
  scene.say(asking(crime.request, crime.attributes), ObjectHandle{crime.object});
  EXPECT_TRUE(scene.is_dropped[1]);
  EXPECT_FALSE(scene.is_dropped[0]);
  EXPECT_EQ(scene.execution.counters().drops[static_cast<std::size_t>(crime.violation)], 1u);
  scene.owner.query_attribute_ownership(scene.vessel_1, position);
  scene.tick();
  EXPECT_EQ(scene.heard[0].owners.at({scene.vessel_1.value, position.value}),
            scene.owner.federate().value);
}

INSTANTIATE_TEST_SUITE_P(
    Of, OwnershipCrimes,
    ::testing::Values(OwnershipCrime{"DivestitureOfForeignAttributes", Violation::not_owned,
                                     OwnershipRequest::divest},
                      OwnershipCrime{"OfferOfForeignAttributes", Violation::not_owned,
                                     OwnershipRequest::offer},
                      OwnershipCrime{"ConfirmationForSomebodyElse", Violation::not_owned,
                                     OwnershipRequest::confirm},
                      OwnershipCrime{"DenialForSomebodyElse", Violation::not_owned,
                                     OwnershipRequest::deny_release},
                      OwnershipCrime{"GiftOfForeignAttributes", Violation::not_owned,
                                     OwnershipRequest::give_if_wanted},
                      OwnershipCrime{"WithdrawalOfAForeignOffer", Violation::not_owned,
                                     OwnershipRequest::withdraw_offer},
                      OwnershipCrime{"AcquisitionOfWhatItDoesNotPublish", Violation::undeclared,
                                     OwnershipRequest::acquire, motion, 0, false},
                      OwnershipCrime{"AcquisitionOfAnUnknownAttribute", Violation::unknown_name,
                                     OwnershipRequest::acquire, AttributeSet(1u << 20)},
                      OwnershipCrime{"AcquisitionOfAnUnknownObject", Violation::unknown_name,
                                     OwnershipRequest::acquire_if_available, motion, 77}),
    [](const auto& crime) { return std::string(crime.param.name); });

TEST(OwnershipBytes, ThatAreMalformedDropTheirSender) {
  const auto is_dropped_for = [](auto message, std::optional<ObjectHandle> object) {
    Scene scene;
    scene.say(message, object);
    return scene.is_dropped[1] &&
           scene.execution.counters().drops[static_cast<std::size_t>(Violation::malformed)] == 1;
  };
  EXPECT_TRUE(is_dropped_for(asking(OwnershipRequest::divest, motion), std::nullopt))
      << "a block without an end";
  for (const std::vector<std::byte>& bytes :
       {values_of(std::uint8_t{36}, std::uint8_t{9}, std::uint8_t{3}, std::uint16_t{0},
                  std::uint8_t{0}),  // a request that isn't
        values_of(std::uint8_t{36}, std::uint8_t{0}, std::uint8_t{0}, std::uint16_t{0},
                  std::uint8_t{0}),  // no attributes
        values_of(std::uint8_t{36}, std::uint8_t{0}, std::uint8_t{3}, std::uint16_t{2000},
                  std::uint8_t{0}),  // a tag too long
        values_of(std::uint8_t{37}, std::uint8_t{0}, std::uint8_t{127}),
        values_of(std::uint8_t{38}, std::uint8_t{6})}) {
    Scene scene;
    std::vector<std::byte> framed = values_of(static_cast<std::uint32_t>(bytes.size()));
    framed.insert(framed.end(), bytes.begin(), bytes.end());
    scene.execution.receive(1, framed);
    scene.tick();
    EXPECT_TRUE(scene.is_dropped[1]);
    EXPECT_EQ(scene.execution.counters().drops[static_cast<std::size_t>(Violation::malformed)], 1u);
  }
}

}  // namespace
}  // namespace rink::rti::testing
