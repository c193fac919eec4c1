// What the standard says of look-ups, sentence by sentence (IEEE 1516.1-2010, clause 10).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rti/errors.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

struct Lookup : ::testing::Test {
  Recorder heard;
  Ambassador ambassador{harbour(), heard};
};

TEST_F(Lookup, NamesAndHandlesOfTheObjectModelLeadToEachOther) {
  const Fom& fom = harbour();
  for (std::uint32_t c = 0; c < fom.object_classes().size(); ++c) {
    const std::string name = ambassador.get_object_class_name({c});
    EXPECT_EQ(ambassador.get_object_class_handle(name).value, c) << name;
    for (std::uint32_t a = 0; a < fom.at(ObjectClassHandle{c}).attributes.size(); ++a)
      EXPECT_EQ(ambassador.get_attribute_handle({c}, ambassador.get_attribute_name({c}, {a})).value,
                a);
  }
  for (std::uint32_t c = 0; c < fom.interaction_classes().size(); ++c) {
    EXPECT_EQ(
        ambassador.get_interaction_class_handle(ambassador.get_interaction_class_name({c})).value,
        c);
    for (std::uint32_t p = 0; p < fom.at(InteractionClassHandle{c}).parameters.size(); ++p)
      EXPECT_EQ(ambassador.get_parameter_handle({c}, ambassador.get_parameter_name({c}, {p})).value,
                p);
  }
  for (std::uint32_t d = 0; d < fom.dimensions().size(); ++d)
    EXPECT_EQ(ambassador.get_dimension_handle(ambassador.get_dimension_name({d})).value, d);
  for (const Transportation each : {Transportation::reliable, Transportation::best_effort})
    EXPECT_EQ(Ambassador::get_transportation_type(Ambassador::get_transportation_type_name(each)),
              each);
  for (const Order each : {Order::receive, Order::timestamp})
    EXPECT_EQ(Ambassador::get_order_type(Ambassador::get_order_name(each)), each);
}

TEST_F(Lookup, AClassIsToldByItsQualifiedNameAndFoundByEither) {
  EXPECT_EQ(ambassador.get_object_class_name(ferry), "HLAobjectRoot.Vessel.Ferry");
  EXPECT_EQ(ambassador.get_object_class_handle("Ferry"), ferry);
  EXPECT_EQ(ambassador.get_interaction_class_name(mayday), "HLAinteractionRoot.Hail.Mayday");
}

TEST_F(Lookup, ANameOfNothingIsNotFound) {
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_object_class_handle("Submarine"); }),
            HlaError::name_not_found);
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_attribute_handle(vessel, "destination"); }),
            HlaError::name_not_found)
      << "an attribute of a subclass only";
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_interaction_class_handle(""); }),
            HlaError::name_not_found);
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_parameter_handle(hail, "volume"); }),
            HlaError::name_not_found);
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_dimension_handle("Z"); }),
            HlaError::name_not_found);
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_federate_handle("nobody"); }),
            HlaError::name_not_found);
  EXPECT_EQ(error_thrown_by([&] { Ambassador::get_transportation_type("HLApigeon"); }),
            HlaError::name_not_found);
  EXPECT_EQ(error_thrown_by([&] { Ambassador::get_order_type("Alphabetical"); }),
            HlaError::name_not_found);
}

TEST_F(Lookup, AHandleOfNothingIsRefusedByWhatItShouldHaveBeen) {
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_object_class_name({99}); }),
            HlaError::object_class_not_defined);
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_attribute_name(vessel, destination); }),
            HlaError::attribute_not_defined);
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_interaction_class_name({}); }),
            HlaError::interaction_class_not_defined);
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_parameter_name(hail, {1}); }),
            HlaError::interaction_parameter_not_defined);
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_dimension_name({9}); }),
            HlaError::invalid_dimension_handle);
  EXPECT_EQ(error_thrown_by([&] { ambassador.get_known_object_class_handle({5}); }),
            HlaError::object_instance_not_known);
}

TEST(LookupOfFederates, KnowsOneselfAndAfterWatchingThoseWhoAreThere) {
  Rig rig(Carrier::in_process);
  Station &a = rig.join("a"), &b = rig.join("b");
  EXPECT_EQ(a.ambassador.get_federate_handle("a"), a.ambassador.federate());
  EXPECT_EQ(error_thrown_by([&] { a.ambassador.get_federate_handle("b"); }),
            HlaError::name_not_found);
  a.ambassador.watch_federates();
  rig.settle();
  EXPECT_EQ(a.ambassador.get_federate_handle("b"), b.ambassador.federate());
  EXPECT_EQ(a.ambassador.get_federate_name(b.ambassador.federate()), "b");
  b.ambassador.resign();
  rig.settle();
  EXPECT_EQ(error_thrown_by([&] { a.ambassador.get_federate_name(b.ambassador.federate()); }),
            HlaError::name_not_found);
}

}  // namespace
}  // namespace rink::rti::testing
