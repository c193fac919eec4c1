// Values, parameters and time stamps that cannot be: the service throws, nothing is sent, and the
// federate goes on.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rti/wire/message.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

/// A pilot with a ferry, who may publish less than the class has.
struct Harbour {
  Rig rig{Carrier::in_process};
  Station& pilot = rig.join("pilot");
  Ambassador& ambassador = pilot.ambassador;
  ObjectHandle object;

  explicit Harbour(AttributeSet published = {position, speed, destination}) {
    ambassador.publish_object_class_attributes(ferry, published);
    ambassador.publish_interaction_class(hail);
    object = ambassador.register_object_instance(ferry);
    rig.settle();
  }
  /// Expects `service` to throw `error` and to send nothing; the federate stays joined.
  template <class Service>
  void expect(HlaError error, const Service& service) {
    const std::size_t said = ambassador.outgoing().size();
    try {
      service();
      ADD_FAILURE() << to_string(error) << " was not thrown";
    } catch (const RtiException& exception) {
      EXPECT_EQ(exception.error(), error) << exception.what();
    }
    EXPECT_EQ(ambassador.outgoing().size(), said);
    rig.settle();
    EXPECT_TRUE(ambassador.is_joined());
    EXPECT_EQ(pilot.heard.lost, "");
  }
};

TEST(ConformanceValues, AnUpdateWhoseValuesAreShorterOrLongerThanItsAttributesIsRefused) {
  Harbour harbour;
  const AttributeSet both{position, speed};
  for (const std::size_t size : {0u, 1u, 11u, 13u, 400u})
    harbour.expect(HlaError::rti_internal_error, [&] {
      harbour.ambassador.update_attribute_values(harbour.object, both, std::vector<std::byte>(size),
                                                 {});
    });
  harbour.ambassador.update_attribute_values(harbour.object, both, std::vector<std::byte>(12), {});
  harbour.rig.settle();
  EXPECT_TRUE(harbour.ambassador.is_joined());
}

TEST(ConformanceValues, ATextWhoseLengthGoesBeyondTheValuesIsRefused) {
  Harbour harbour;
  const std::vector<std::byte> beyond = values_of(std::uint32_t{100}, 'a', 'b');
  harbour.expect(HlaError::rti_internal_error, [&] {
    harbour.ambassador.update_attribute_values(harbour.object, AttributeSet{destination}, beyond,
                                               {});
  });
}

TEST(ConformanceValues, MoreThanAnUpdateCarriesIsRefused) {
  Harbour harbour;
  const std::vector<std::byte> most = varying(std::string(values_max - 4, 'x')),
                               more = varying(std::string(values_max - 3, 'x'));
  harbour.expect(HlaError::rti_internal_error, [&] {
    harbour.ambassador.update_attribute_values(harbour.object, AttributeSet{destination}, more, {});
  });
  harbour.ambassador.update_attribute_values(harbour.object, AttributeSet{destination}, most, {});
  harbour.rig.settle();
  EXPECT_TRUE(harbour.ambassador.is_joined());
}

TEST(ConformanceValues, AnAttributeThatTheClassLacksOrTheFederateDoesNotPublishIsRefused) {
  Harbour harbour({position});
  harbour.expect(HlaError::attribute_not_defined, [&] {
    harbour.ambassador.update_attribute_values(harbour.object, AttributeSet(1u << 20),
                                               values_of(1.0), {});
  });
  harbour.expect(HlaError::attribute_not_owned, [&] {
    harbour.ambassador.update_attribute_values(harbour.object, AttributeSet{speed}, values_of(1.0f),
                                               {});
  });
}

TEST(ConformanceValues, AnUpdateOfNothingSendsNothing) {
  Harbour harbour;
  harbour.ambassador.update_attribute_values(harbour.object, AttributeSet(), {}, {});
  EXPECT_TRUE(harbour.ambassador.outgoing().empty());
}

TEST(ConformanceValues, ParametersLongerThanAnInteractionCarriesAreRefused) {
  Harbour harbour;
  const std::vector<std::byte> most(parameters_max), more(parameters_max + 1);
  harbour.expect(HlaError::rti_internal_error,
                 [&] { harbour.ambassador.send_interaction(hail, more, Stamp{}); });
  harbour.ambassador.send_interaction(hail, most, Stamp{});
  harbour.rig.settle();
  EXPECT_TRUE(harbour.ambassador.is_joined());
}

TEST(ConformanceValues, ATimeStampThatIsNoFiniteNumberIsRefused) {
  Harbour harbour;
  for (const double time : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL}) {
    harbour.expect(HlaError::invalid_logical_time, [&] {
      harbour.ambassador.update_attribute_values(harbour.object, AttributeSet{speed},
                                                 values_of(1.0f), Stamp{time, 0});
    });
    harbour.expect(HlaError::invalid_logical_time, [&] {
      harbour.ambassador.send_interaction(hail, {}, Stamp{time, 0});
    });
  }
}

TEST(ConformanceValues, InTimeStampOrderTheSameIsRefused) {
  Harbour harbour;
  harbour.ambassador.enable_time_regulation(1.0);
  harbour.rig.settle();
  harbour.expect(HlaError::rti_internal_error, [&] {
    harbour.ambassador.update_attribute_values(harbour.object, AttributeSet{destination},
                                               std::vector<std::byte>(2), LogicalTime(5.0));
  });
  harbour.expect(HlaError::rti_internal_error, [&] {
    harbour.ambassador.send_interaction(hail, std::vector<std::byte>(parameters_max + 1),
                                        LogicalTime(5.0));
  });
}

}  // namespace
}  // namespace rink::rti::testing
