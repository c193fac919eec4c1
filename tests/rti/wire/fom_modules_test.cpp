// Modules of an object model: what merges, what contradicts, and who is told.
#include <gtest/gtest.h>

#include "rti/federation_file.h"
#include "rti/fom/fom_digest.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

/// Hangs a lighthouse on the harbour's tree and a tug on its vessels, both by scaffolds.
constexpr const char* lights_xml = R"(<objectModel><objects><objectClass><name>HLAobjectRoot</name>
  <objectClass><name>Vessel</name><objectClass><name>Tug</name>
    <attribute><name>pull</name><dataType>Pull</dataType></attribute></objectClass></objectClass>
  <objectClass><name>Light</name>
    <attribute><name>colour</name><dataType>Colour</dataType><dimensions><dimension>Sector</dimension></dimensions></attribute></objectClass>
</objectClass></objects>
<interactions><interactionClass><name>HLAinteractionRoot</name><interactionClass><name>Hail</name>
  <interactionClass><name>Signal</name><parameter><name>colour</name><dataType>Colour</dataType></parameter></interactionClass></interactionClass></interactionClass></interactions>
<dimensions><dimension><name>X</name></dimension><dimension><name>Sector</name><upperBound>360</upperBound></dimension></dimensions>
<dataTypes>
  <simpleDataTypes><simpleData><name>Pull</name><representation>HLAfloat64BE</representation></simpleData></simpleDataTypes>
  <enumeratedDataTypes><enumeratedData><name>Colour</name><representation>HLAoctet</representation>
    <enumerator><name>red</name><value>1</value></enumerator><enumerator><name>green</name><value>2</value></enumerator></enumeratedData></enumeratedDataTypes>
  <variantRecordDataTypes><variantRecordData><name>Beam</name><discriminant>colour</discriminant><dataType>Colour</dataType>
    <alternative><enumerator>red</enumerator><name>reach</name><dataType>HLAfloat64BE</dataType></alternative></variantRecordData></variantRecordDataTypes>
  <fixedRecordDataTypes><fixedRecordData><name>Position</name><semantics>as the harbour has it</semantics>
    <field><name>x</name><dataType>HLAfloat32LE</dataType></field><field><name>y</name><dataType>HLAfloat32LE</dataType></field></fixedRecordData></fixedRecordDataTypes>
</dataTypes></objectModel>
)";

Fom merged(const std::string& first, const std::string& second) {
  const std::array modules{FomModule{first, "harbour.xml"}, FomModule{second, "lights.xml"}};
  return Fom::parse(modules);
}

TEST(FomModules, ClassesOfSeveralModulesAreOneTreeAndInheritAcrossThem) {
  const Fom fom = merged(harbour_xml, lights_xml);
  const ObjectClassHandle tug = *fom.object_class("Tug");
  EXPECT_TRUE(fom.is_a(tug, *fom.object_class("Vessel")));
  ASSERT_EQ(fom.at(tug).attributes.size(), 3u);
  EXPECT_EQ(fom.at(tug).attributes[2].size, 8u);
  EXPECT_EQ(fom.attribute(tug, "position"), position);
  EXPECT_EQ(fom.parameter(*fom.interaction_class("Signal"), "words"), ParameterHandle{0});
  EXPECT_EQ(fom.at(*fom.dimension("Sector")).upper_bound, 360u);
  EXPECT_EQ(fom.dimensions().size(), 3u);
  EXPECT_EQ(fom.at(*fom.object_class("Light")).attributes[0].dimensions,
            DimensionSet{*fom.dimension("Sector")});
}

TEST(FomModules, AScaffoldMayComeBeforeItsDefinition) {
  const Fom fom = merged(lights_xml, harbour_xml);
  EXPECT_EQ(fom.at(*fom.object_class("Tug")).attributes.size(), 3u);
  EXPECT_EQ(fom.at(*fom.object_class("Vessel")).attributes.size(), 2u);
}

TEST(FomModules, AModuleThatRepeatsAnotherChangesNothing) {
  std::string commented = harbour_xml;
  commented.insert(commented.find("<attribute><name>speed") + 11,
                   "<!-- over ground --><semantics>over ground</semantics>");
  EXPECT_EQ(merged(harbour_xml, commented).hash(), harbour().hash());
}

/// The complaint about two modules after `from` in the second became `to`.
std::string conflict(const std::string& from, const std::string& to,
                     std::string second = harbour_xml) {
  const std::size_t at = second.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  second.replace(at, from.size(), to);
  try {
    merged(harbour_xml, second);
  } catch (const FileError& error) {
    return std::string(error.what()) +
           (error.error() == HlaError::inconsistent_fdd ? "" : " [not InconsistentFDD]");
  }
  return "accepted";
}

TEST(FomModules, ContradictionsNameBothPlaces) {
  EXPECT_EQ(conflict("<dataType>HLAfloat32LE</dataType></attribute>",
                     "<dataType>HLAfloat64LE</dataType></attribute>"),
            "lights.xml:8: InconsistentFDD: <attribute> 'speed' of class 'Vessel' differs in "
            "<dataType> from its definition at harbour.xml:8 (IEEE 1516.2-2010, 4.4)");
  EXPECT_EQ(conflict("<order>TimeStamp</order>", "<order>Receive</order>"),
            "lights.xml:10: InconsistentFDD: <attribute> 'destination' of class 'Ferry' differs in "
            "<order> from its definition at harbour.xml:10 (IEEE 1516.2-2010, 4.4)");
  EXPECT_EQ(conflict("<dimension>Y</dimension>", ""),
            "lights.xml:7: InconsistentFDD: <attribute> 'position' of class 'Vessel' differs in "
            "<dimensions> from its definition at harbour.xml:7 (IEEE 1516.2-2010, 4.6)");
  EXPECT_EQ(conflict("<name>speed</name>", "<name>pace</name>"),
            "lights.xml:6: InconsistentFDD: <attribute> 'speed' of class 'Vessel' is missing here; "
            "it is defined at harbour.xml:8 (IEEE 1516.2-2010, 4.2)");
  EXPECT_EQ(conflict("<attribute><name>speed",
                     "<attribute><name>flag</name><dataType>HLAoctet</dataType></"
                     "attribute><attribute><name>speed"),
            "lights.xml:8: InconsistentFDD: <attribute> 'flag' of class 'Vessel' is missing in the "
            "definition at harbour.xml:6 (IEEE 1516.2-2010, 4.4)");
  EXPECT_EQ(conflict("<field><name>x</name><dataType>HLAfloat32LE",
                     "<field><name>x</name><dataType>HLAfloat32BE"),
            "lights.xml:29: InconsistentFDD: <fixedRecordData> 'Position' differs in <dataType> "
            "from its definition at harbour.xml:28 (IEEE 1516.2-2010, 4.13)");
  EXPECT_EQ(conflict("<name>words</name><dataType>HLAASCIIstring",
                     "<name>words</name><dataType>HLAunicodeString"),
            "lights.xml:20: InconsistentFDD: <parameter> 'words' of class 'Hail' differs in "
            "<dataType> from its definition at harbour.xml:20 (IEEE 1516.2-2010, 4.5)");
  EXPECT_EQ(conflict("<upperBound>360</upperBound></dimension>",
                     "<upperBound>360</upperBound></dimension><dimension><name>Y</"
                     "name><upperBound>5</upperBound></dimension>",
                     lights_xml),
            "lights.xml:9: InconsistentFDD: <dimension> 'Y' differs from its definition at "
            "harbour.xml:25 (IEEE 1516.2-2010, 4.6)");
}

struct Malformed {
  const char *from, *to, *complaint;
};

TEST(FomModules, EveryMalformedModuleIsRefusedByLineAndElement) {
  const std::array table{
      Malformed{"<upperBound>360</upperBound>", "<upperBound>0</upperBound>",
                "lights.xml:9: <dimension> 'Sector' must have an <upperBound> that is a whole "
                "number from 1 to 4294967295"},
      Malformed{"<upperBound>360</upperBound>", "<upperBound>-3</upperBound>",
                "lights.xml:9: <dimension> 'Sector' must have an <upperBound> that is a whole "
                "number from 1 to 4294967295"},
      Malformed{"<dimension>Sector</dimension>", "<dimension>Depth</dimension>",
                "lights.xml:5: <attribute> 'colour' has the unknown dimension 'Depth'; allowed are "
                "those in <dimensions>"},
      Malformed{"<objectClass><name>Light", "<objectClass><name>Vessel",
                "lights.xml:4: <objectClass> 'Vessel' is declared twice"},
      Malformed{
          "<name>Light</name>",
          "<name>Light</name><attribute><name>colour</name><dataType>Colour</dataType></attribute>",
          "lights.xml:5: <attribute> 'colour' is declared twice in class 'Light' or what it "
          "inherits"},
      Malformed{
          "<name>pull</name>", "<name>speed</name>",
          "lights.xml:3: <attribute> 'speed' is declared twice in class 'Tug' or what it inherits"},
      Malformed{"<dataType>Pull</dataType>", "<dataType>Push</dataType>",
                "lights.xml:3: <attribute> 'pull' has the unknown data type 'Push'; allowed are "
                "those in <dataTypes> and the standard's, such as HLAfloat32LE"},
      Malformed{"<representation>HLAfloat64BE", "<representation>Real",
                "lights.xml:11: <simpleData> 'Pull' has the unknown data type 'Real'; allowed are "
                "those in <dataTypes> and the standard's, such as HLAfloat32LE"},
      Malformed{"<representation>HLAfloat64BE</representation>", "",
                "lights.xml:11: <simpleData> 'Pull' lacks <representation>"},
      Malformed{"<representation>HLAfloat64BE", "<representation>Pull",
                "lights.xml:11: data type 'Pull' contains itself"},
      Malformed{"<name>green</name>", "<name>red</name>",
                "lights.xml:13: <enumerator> 'red' of <enumeratedData> 'Colour' is declared twice"},
      Malformed{"<dataType>Colour</dataType>\n    <alternative>",
                "<dataType>Pull</dataType>\n    <alternative>",
                "lights.xml:14: <variantRecordData> 'Beam' must have an enumerated data type as "
                "its discriminant, not 'Pull'"},
      Malformed{"<name>reach</name><dataType>HLAfloat64BE", "<name>reach</name><dataType>Real",
                "lights.xml:15: <alternative> 'reach' has the unknown data type 'Real'; allowed "
                "are those in <dataTypes> and the standard's, such as HLAfloat32LE"},
      Malformed{"<enumerator>red</enumerator>", "",
                "lights.xml:15: <alternative> 'reach' lacks <enumerator>"},
      Malformed{"<simpleDataTypes><simpleData>", "<simpleDataTypes><plainData/><simpleData>",
                "lights.xml:11: <plainData> lacks <name>"},
      Malformed{"<enumeratedDataTypes>",
                "<enumeratedDataTypes><plainData><name>Odd</name></plainData>",
                "lights.xml:12: <dataTypes> holds <plainData> 'Odd'; allowed are basicData, "
                "simpleData, enumeratedData, arrayData, fixedRecordData, variantRecordData"},
      Malformed{"<simpleDataTypes>", "<plainDataTypes/><simpleDataTypes>",
                "lights.xml:11: <dataTypes> holds <plainDataTypes>; allowed are "
                "basicDataRepresentations, simpleDataTypes, enumeratedDataTypes, arrayDataTypes, "
                "fixedRecordDataTypes, variantRecordDataTypes"},
      Malformed{
          "<name>Light</name>", "<name>HLAlight</name>",
          "lights.xml:4: <objectClass> 'HLAlight': names that begin with HLA are the standard's"},
      Malformed{
          "<name>pull</name>", "<name>hlaPull</name>",
          "lights.xml:3: <attribute> 'hlaPull': names that begin with HLA are the standard's"},
      Malformed{"<name>Signal</name>", "<name>HLAsignal</name>",
                "lights.xml:8: <interactionClass> 'HLAsignal': names that begin with HLA are the "
                "standard's"},
      Malformed{"<simpleData><name>Pull</name>", "<simpleData><name>HLAinteger32BE</name>",
                "lights.xml:3: <attribute> 'pull' has the unknown data type 'Pull'"},
      Malformed{
          "<simpleDataTypes>",
          "<simpleDataTypes><simpleData><name>HLAinteger32BE</name><representation>HLAfloat64BE</"
          "representation></simpleData>",
          "lights.xml:11: <simpleData> 'HLAinteger32BE' is the standard's, whose size is 32 bits"},
      Malformed{
          "<simpleDataTypes>",
          "<simpleDataTypes><simpleData><name>HLAclock</name><representation>HLAfloat64BE</"
          "representation></simpleData>",
          "lights.xml:11: <simpleData> 'HLAclock': names that begin with HLA are the standard's"},
      Malformed{"<objectModel>", "<objectModels>",
                "lights.xml:18: no well-formed XML: Start-end tags mismatch"},
      Malformed{
          "<name>Tug</name>", "<name>Tug boat</name>",
          "lights.xml:2: <name> of <objectClass> 'Tug boat' must hold one word, not 'Tug boat'"},
  };
  for (const Malformed& each : table) {
    SCOPED_TRACE(std::string(each.from) + " became " + each.to);
    const std::string complaint = conflict(each.from, each.to, lights_xml);
    EXPECT_EQ(complaint.substr(0, std::string_view(each.complaint).size()), each.complaint);
  }
}

TEST(FomModules, OnlyTheStandardsOwnModuleDefinesNamesThatBeginWithHla) {
  constexpr const char* standard =
      R"(<objectModel><objects><objectClass><name>HLAobjectRoot</name><objectClass><name>HLAmanager</name>
<attribute><name>HLAcount</name><dataType>HLAinteger32BE</dataType></attribute></objectClass></objectClass></objects></objectModel>)";
  constexpr const char* extension =
      R"(<objectModel><objects><objectClass><name>HLAobjectRoot</name><objectClass><name>HLAmanager</name>
<objectClass><name>Own</name></objectClass></objectClass></objectClass></objects></objectModel>)";
  const std::array modules{FomModule{standard, "mim.xml", true}, FomModule{extension, "own.xml"}};
  const Fom fom = Fom::parse(modules);
  EXPECT_EQ(fom.at(*fom.object_class("Own")).attributes.size(), 1u)
      << "a scaffold of the standard's class";
  EXPECT_THROW(Fom::parse(extension, "own.xml"), FileError);
}

TEST(FomModules, AFederateWithAnotherModelIsToldWhichAttributeDiffers) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string xml = harbour_xml;
    xml.replace(xml.find(from), from.size(), to);
    return Fom::parse(xml, "harbour.xml");
  };
  const auto answer = [](const Fom& fom) {
    Rig rig(Carrier::in_process);
    Station& station = rig.connect(fom);
    station.ambassador.join("rink", "stranger", "tester");
    rig.settle();
    EXPECT_EQ(station.heard.refusal, Refusal::wrong_fom);
    const std::string& said = station.heard.log.back();
    return said.substr(said.rfind(": ") + 2);
  };
  EXPECT_EQ(answer(changed("<dataType>HLAfloat32LE</dataType></attribute>",
                           "<dataType>HLAfloat64LE</dataType></attribute>")),
            "attribute 'speed' of object class 'HLAobjectRoot.Vessel' differs");
  EXPECT_EQ(answer(changed("<name>destination</name>", "<name>goal</name>")),
            "attribute 'goal' of object class 'HLAobjectRoot.Vessel.Ferry' is unknown to the "
            "federation (and 1 more)");
  EXPECT_EQ(answer(changed("<dimensions><dimension><name>X</name>",
                           "<dimensions><dimension><name>X</name><upperBound>9</upperBound>")),
            "dimension 'X' differs");
  EXPECT_EQ(answer(merged(harbour_xml, lights_xml)).substr(0, 57),
            "object class 'HLAobjectRoot.Vessel.Tug' is unknown to the");
}

TEST(FomModules, ModelsInAnotherOrderAreToldApart) {
  const Fom one = merged(harbour_xml, lights_xml), other = merged(lights_xml, harbour_xml);
  EXPECT_NE(one.hash(), other.hash());
  EXPECT_EQ(difference(one, digest(one)), "");
  EXPECT_EQ(difference(one, digest(other)),
            "the same elements stand in another order: load the modules in the federation's");
}

TEST(FederationFile, MayListModulesOfTheObjectModel) {
  const auto read = [](const std::string& fom) {
    return parse_federation_file(
        "federation = \"port\"\nfom = " + fom + "\naddress = \"127.0.0.1\"\nport = 7000\n",
        "games/port.toml");
  };
  EXPECT_EQ(read("[\"harbour.xml\", \"/etc/lights.xml\"]").fom,
            (std::vector<std::string>{"games/harbour.xml", "/etc/lights.xml"}));
  const auto complaint = [&](const std::string& fom) {
    try {
      read(fom);
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(complaint("[]"), "games/port.toml:2: key 'fom' must name at least one module");
  EXPECT_EQ(complaint("[\"a.xml\", 3]"),
            "games/port.toml:2: key 'fom' must be a text that is not empty, or a list of such");
  EXPECT_EQ(complaint("[\"a.xml\", \"a.xml\"]"),
            "games/port.toml:2: key 'fom' names 'a.xml' twice");
}

}  // namespace
}  // namespace rink::rti::testing
