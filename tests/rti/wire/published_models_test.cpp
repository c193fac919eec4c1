// Object models as large and as mixed as the published ones: what they mean, and what of them is
// only warned of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rti/fom/fom_lookup.h"
#include "rti/fom/module_summary.h"
#include "tests/rti/rig.h"
#include "tests/rti/scenes/published_models.h"

namespace rink::rti::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::size_t own_classes(const Fom& fom) {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < fom.object_classes().size(); ++i)
    count += fom.is_management(ObjectClassHandle{i}) ? 0u : 1u;
  return count;
}

std::size_t widest(const Fom& fom) {
  std::size_t most = 0;
  for (std::uint32_t i = 0; i < fom.object_classes().size(); ++i)
    if (!fom.is_management(ObjectClassHandle{i}))
      most = std::max(most, fom.attributes({i}).count());
  return most;
}

std::vector<FomModule> rpr_modules() {
  ModuleWriter writer(1);
  std::vector<FomModule> modules;
  for (const ModuleShape& shape : rpr_shapes) modules.push_back(writer.write(shape));
  return modules;
}

TEST(PublishedModels, FourteenModulesLikeThoseOfRprAreOneModel) {
  std::vector<FomModule> modules = rpr_modules();
  ASSERT_EQ(modules.size(), 14u);
  const Fom fom = Fom::parse(modules);
  std::size_t classes = 1;  // the root
  for (const ModuleShape& shape : rpr_shapes) classes += static_cast<std::size_t>(shape.classes);
  EXPECT_EQ(own_classes(fom), classes);
  EXPECT_EQ(widest(fom), 51u);
  EXPECT_THAT(fom.warnings(), ElementsAre(HasSubstr("<conveyProducingFederate> stays on")));
  const ObjectClassHandle deepest = *fom.object_class("PhysicalClass3");
  EXPECT_EQ(fom.attributes(deepest).count(), 41u);
  EXPECT_EQ(fom.attribute(deepest, "PhysicalAttribute40"), AttributeHandle{41});
  const ModuleSummary enumerations = summarize(modules[1]);
  EXPECT_EQ(enumerations.text(), "89 data types with 3952 enumerators");
  EXPECT_EQ(summarize(modules[4]).text().substr(0, 41),
            "19 object classes with 41 attributes, 4 i");
}

TEST(PublishedModels, AClassOf88AttributesAmong110IsOneOfManyLikeIt) {
  ModuleWriter writer(2);
  const FomModule module = writer.write(netn_shape);
  const Fom fom = Fom::parse(std::span(&module, 1));
  EXPECT_EQ(own_classes(fom), 110u);
  EXPECT_EQ(widest(fom), 88u);
  EXPECT_EQ(fom.interaction_classes().size() - 194u, harbour().interaction_classes().size() - 3u)
      << "beside the management classes";
}

TEST(PublishedModels, TheStandardsOwnModuleMayBeGivenAndChangesNothing) {
  std::vector<FomModule> modules{tavern_module()};
  const Fom alone = Fom::parse(modules);
  for (const bool is_first : {true, false}) {
    std::vector<FomModule> both = modules;
    both.insert(is_first ? both.begin() : both.end(), management_module());
    const Fom fom = Fom::parse(both);
    EXPECT_EQ(fom.hash(), alone.hash());
    EXPECT_EQ(fom.object_classes().size(), alone.object_classes().size());
    EXPECT_TRUE(fom.is_management(*fom.object_class("HLAmanager")));
    EXPECT_TRUE(fom.attribute(*fom.object_class("HLAfederate"), "HLAfederateName"));
  }
  const ModuleSummary summary = summarize(management_module());
  EXPECT_TRUE(summary.is_standard);
  EXPECT_THAT(summary.text(), HasSubstr("the standard's management and initialization module"));
}

TEST(PublishedModels, WhatOnlyTheSampleHasIsUnderstood) {
  const FomModule module = tavern_module();
  const Fom fom = Fom::parse(std::span(&module, 1));
  const ObjectClassHandle cook = *fom.object_class("Cook");
  const std::vector<Attribute>& attributes = fom.at(cook).attributes;
  ASSERT_EQ(attributes.size(), 3u) << "the privilege to delete is every class's";
  EXPECT_EQ(attributes[0].transportation, Transportation::best_effort) << "its own, not reliable";
  EXPECT_EQ(attributes[0].order, Order::timestamp);
  EXPECT_EQ(attributes[1].data_type, "");
  EXPECT_EQ(attributes[1].size, std::nullopt) << "octets that only federates understand";
  EXPECT_EQ(attributes[2].dimensions, DimensionSet{*fom.dimension("Stove")});
  EXPECT_EQ(fom.at(*fom.interaction_class("Served")).order, Order::timestamp);
  EXPECT_EQ(fom.at(*fom.interaction_class("HLAinteractionRoot")).order, Order::receive);
  EXPECT_THAT(fom.warnings(), ElementsAre(HasSubstr("<updateRates>"),
                                          HasSubstr("<timeStamp> is HLAinteger64Time")));
  for (const std::string& each : fom.warnings())
    EXPECT_THAT(each, AllOf(HasSubstr("tavern.xml:"), HasSubstr("IEEE 1516.2-2010, 4.")));
}

/// Modules of one table alone are models too.
TEST(PublishedModels, AModuleMayHaveInteractionsOrDimensionsAlone) {
  const Fom interactions = Fom::parse(
      "<objectModel><interactions><interactionClass><name>HLAinteractionRoot</name>"
      "<interactionClass><name>Hail</name><parameter><name>words</name></parameter>"
      "</interactionClass></interactionClass></interactions></objectModel>",
      "hail.xml");
  EXPECT_TRUE(interactions.interaction_class("Hail"));
  EXPECT_TRUE(interactions.object_class("HLAobjectRoot.HLAmanager"));
  const Fom dimensions = Fom::parse(
      "<objectModel><dimensions><dimension><name>Depth</name><upperBound>9</upperBound></dimension>"
      "</dimensions></objectModel>",
      "depth.xml");
  EXPECT_EQ(dimensions.at(*dimensions.dimension("Depth")).upper_bound, 9u);
  EXPECT_TRUE(dimensions.object_class("HLAmanager"));
}

/// IEEE 1516.2-2025 lets modules add members to a class; 2010 does not.
TEST(PublishedModels, AModuleOf2025AddsAttributesToTheClassOfAnother) {
  const auto module = [](const std::string& year, const std::string& attribute) {
    return FomModule{"<objectModel xmlns=\"http://standards.ieee.org/IEEE1516-" + year +
                         "\"><objects><objectClass><name>HLAobjectRoot</name><objectClass><name>"
                         "Ship</name><attribute><name>" +
                         attribute +
                         "</name><dataType>HLAoctet</dataType></attribute></objectClass>"
                         "</objectClass></objects></objectModel>",
                     attribute + ".xml"};
  };
  const std::array extended{module("2010", "speed"), module("2025", "colour"),
                            module("2025", "speed")};
  const Fom fom = Fom::parse(extended);
  const ObjectClassHandle ship = *fom.object_class("Ship");
  EXPECT_EQ(fom.attribute(ship, "speed"), AttributeHandle{0});
  EXPECT_EQ(fom.attribute(ship, "colour"), AttributeHandle{1});
  EXPECT_EQ(fom.attributes(ship).count(), 2u);
  const std::array refused{module("2010", "speed"), module("2010", "colour")};
  EXPECT_THROW(Fom::parse(refused), FileError);
}

std::string tavern_complaint(const std::string& from, const std::string& to) {
  FomModule module = tavern_module();
  const std::size_t at = module.xml.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  module.xml.replace(at, from.size(), to);
  try {
    Fom::parse(std::span(&module, 1));
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PublishedModels, EachFaultIsNamedByFileLineElementAndClause) {
  struct Fault {
    const char *from, *to, *complaint;
  };
  const std::array faults{
      Fault{"<transportation>Swift", "<transportation>Slow",
            "tavern.xml:7: <attribute> 'pay' has transportation 'Slow'; allowed are HLAreliable, "
            "HLAbestEffort and those in <transportations> (IEEE 1516.2-2010, 4.4)"},
      Fault{"<reliable>No", "<reliable>Maybe",
            "tavern.xml:20: <transportation> 'Swift' has <reliable> 'Maybe'; allowed are Yes, No "
            "(IEEE 1516.2-2010, 4.10)"},
      Fault{"[1..3], 7", "[3..1]",
            "tavern.xml:26: <value> of <enumerator> 'Small' holds '[3..1]'; allowed are whole "
            "numbers, lists of such, and ranges [1..4] (IEEE 1516.2-2010, 4.13)"},
      Fault{"[1..3], 7", "1,,2",
            "tavern.xml:26: <value> holds the list '1,,2'; expected names or ranges [first..last] "
            "with commas between (IEEE 1516.2-2010, 4.13)"},
      Fault{"[1..3], 7", "256",
            "tavern.xml:26: <value> of <enumerator> 'Small' does not fit the 1 bytes of its "
            "representation (IEEE 1516.2-2010, 4.13)"},
      Fault{"<representation>HLAoctet", "<representation>HLAunicodeString",
            "tavern.xml:25: <enumeratedData> 'StoveKind' has a representation without a size; "
            "allowed are numbers, such as HLAinteger32BE (IEEE 1516.2-2010, 4.13)"},
      Fault{"[Hand .. Mate], Master", "[Mate .. Hand]",
            "tavern.xml:32: <alternative> 'stars' has the range [Mate..Hand], whose ends are the "
            "wrong way round (IEEE 1516.2-2010, 4.13)"},
      Fault{"[Hand .. Mate], Master", "Hand, Cook",
            "tavern.xml:32: <alternative> 'stars' of <variantRecordData> 'Rating' names the "
            "unknown enumerator 'Cook' (IEEE 1516.2-2010, 4.13)"},
      Fault{"[Hand .. Mate], Master", "[Hand .. Mate], Hand",
            "tavern.xml:32: <alternative> 'stars' of <variantRecordData> 'Rating' names 'Hand', "
            "which another alternative has (IEEE 1516.2-2010, 4.13)"},
      Fault{"[Hand .. Mate], Master", "[Hand .. Mate, Master",
            "tavern.xml:32: <alternative> 'stars' holds the list '[Hand .. Mate, Master'; expected "
            "names or ranges [first..last] with commas between (IEEE 1516.2-2010, 4.13)"},
      Fault{"<objectModel xmlns=\"http://standards.ieee.org/IEEE1516-2010\">",
            "<objectModel DTDversion=\"1516.2\">",
            "tavern.xml:2: <objectModel> is of IEEE 1516.2-2000; expected a model of 2010, with "
            "names in elements of their own (IEEE 1516.2-2010, 4)"},
      Fault{"<upperBound>3", "<upperBound>three",
            "tavern.xml:15: <dimension> 'Stove' must have an <upperBound> that is a whole number "
            "from 1 to 4294967295 (IEEE 1516.2-2010, 4.6)"},
  };
  for (const Fault& each : faults) EXPECT_EQ(tavern_complaint(each.from, each.to), each.complaint);
}

}  // namespace
}  // namespace rink::rti::testing
