// Object models and federation files: what they mean, and how they are refused.
#include <gtest/gtest.h>

#include "rti/federation_file.h"
#include "tests/places.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

TEST(Fom, AttributesAreInheritedFirstAndKeepTheirHandles) {
  const Fom& fom = harbour();
  EXPECT_EQ(fom.attribute(vessel, "position"), fom.attribute(ferry, "position"));
  EXPECT_EQ(fom.at(ferry).attributes.size(), 3u);
  EXPECT_TRUE(fom.is_a(ferry, vessel));
  EXPECT_FALSE(fom.is_a(vessel, ferry));
  EXPECT_EQ(fom.object_class("HLAobjectRoot.Vessel.Ferry"), ferry);
  EXPECT_EQ(fom.object_class("Ferry.Vessel"), std::nullopt);
  EXPECT_EQ(fom.object_class("Submarine"), std::nullopt);
  EXPECT_EQ(fom.attribute(vessel, "destination"), std::nullopt);
  EXPECT_EQ(fom.at(ferry).attributes[destination.value].order, Order::timestamp);
  EXPECT_EQ(fom.at(*fom.object_class("Tide")).attributes[0].transportation, Transportation::best_effort);
  EXPECT_EQ(fom.at(vessel).attributes[position.value].dimensions, (DimensionSet{*fom.dimension("X"), *fom.dimension("Y")}));
  EXPECT_TRUE(fom.at(vessel).attributes[speed.value].dimensions.is_empty());
  EXPECT_EQ(fom.dimensions().size(), 2u);
  EXPECT_EQ(fom.parameter(mayday, "words"), ParameterHandle{0});
}

TEST(Fom, ValuesTakeTheSumOfTheirTypesOrVary) {
  EXPECT_EQ(harbour().values_size(vessel, AttributeSet{position}), 8u);
  EXPECT_EQ(harbour().values_size(vessel, AttributeSet{position, speed}), 12u);
  EXPECT_EQ(harbour().values_size(ferry, AttributeSet{speed, destination}), std::nullopt);
  auto values = values_of(1.0f);
  const auto town = varying("Bergen");
  values.insert(values.end(), town.begin(), town.end());
  EXPECT_TRUE(harbour().values_fit(ferry, AttributeSet{speed, destination}, values));
  EXPECT_FALSE(harbour().values_fit(ferry, AttributeSet{speed, destination}, Bytes(values).first(values.size() - 1)));
  EXPECT_EQ(harbour().value(ferry, AttributeSet{speed, destination}, destination, values).size(), town.size());
}

TEST(Fom, HashTellsModelsApartButNotTheirComments) {
  std::string commented = harbour_xml, renamed = harbour_xml;
  commented.insert(commented.find("<objects>"), "<!-- ships -->\n\n");
  renamed.replace(renamed.find("Ferry"), 5, "Barge");
  EXPECT_EQ(Fom::parse(commented, "a").hash(), harbour().hash());
  EXPECT_NE(Fom::parse(renamed, "a").hash(), harbour().hash());
}

TEST(Fom, RinksOwnHasTheSizesThatTheWireCountsOn) {
  const Fom fom = Fom::load(test::source_folder() + "/game/net/rink.fom.xml");
  const ObjectClassHandle entity = *fom.object_class("Entity");
  EXPECT_EQ(fom.values_size(entity, AttributeSet{*fom.attribute(entity, "position")}), 8u);
  EXPECT_TRUE(fom.interaction_class("KeyDown") && fom.interaction_class("KeyUp") && fom.interaction_class("Update"));
}

/// The complaint about `text` after `from` in it became `to`.
template <class Read>
std::string complaint(std::string text, const std::string& from, const std::string& to, Read read) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  try {
    read(text);
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}
std::string fom_complaint(const std::string& from, const std::string& to) {
  return complaint(harbour_xml, from, to, [](const std::string& text) { return Fom::parse(text, "harbour.xml"); });
}

TEST(Fom, ErrorsNameFileLineElementAndWhatIsAllowed) {
  EXPECT_EQ(fom_complaint("<dataType>Position</dataType>", "<dataType>Place</dataType>"),
            "harbour.xml:7: <attribute> 'position' has the unknown data type 'Place'; allowed are those in <dataTypes> and the standard's, such as HLAfloat32LE");
  EXPECT_EQ(fom_complaint("<order>TimeStamp</order>", "<order>Sorted</order>"),
            "harbour.xml:10: <attribute> 'destination' has order 'Sorted'; allowed are Receive, TimeStamp");
  EXPECT_EQ(fom_complaint("HLAbestEffort", "carrierPigeon"),
            "harbour.xml:14: <attribute> 'level' has transportation 'carrierPigeon'; allowed are HLAreliable, HLAbestEffort");
  EXPECT_EQ(fom_complaint("<name>speed</name>", "<name>position</name>"),
            "harbour.xml:8: <attribute> 'position' is declared twice in class 'Vessel' or what it inherits");
  EXPECT_EQ(fom_complaint("<name>speed</name>", ""), "harbour.xml:8: <attribute> lacks <name>");
  EXPECT_EQ(fom_complaint("<dimension>Y</dimension>", "<dimension>Z</dimension>"),
            "harbour.xml:7: <attribute> 'position' has the unknown dimension 'Z'; allowed are those in <dimensions>");
  EXPECT_EQ(fom_complaint("<objectClass><name>Tide", "<objectClass><name>Vessel"), "harbour.xml:13: <objectClass> 'Vessel' is declared twice");
  EXPECT_EQ(fom_complaint("<field><name>x</name><dataType>HLAfloat32LE", "<field><name>x</name><dataType>Position"),
            "harbour.xml:28: data type 'Position' contains itself");
  EXPECT_EQ(fom_complaint("<objectModel>", "<model>").substr(0, 16), "harbour.xml:34: ") << "where the tags cease to match";
  EXPECT_NE(fom_complaint("</field>", "").find("no well-formed XML"), std::string::npos);
}

TEST(Fom, AMissingFileIsNamed) {
  try {
    Fom::load("/nowhere/harbour.xml");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/harbour.xml: can't be read; expected an OMT XML file");
  }
}

constexpr const char* one_address = "federation = \"rink\"\nfom = \"rink.fom.xml\"\naddress = \"127.0.0.1\"\nport = 7000\n";
constexpr const char* two_nodes =
    "federation = \"rink\"\nfom = \"/etc/rink.fom.xml\"\n\n[[node]]\nname = \"a\"\naddress = \"host-a\"\nport = 7000\n\n[[node]]\nname = \"b\"\naddress = "
    "\"host-b\"\nport = 7001\n";

TEST(FederationFile, GivesOneAddressOrTheListOfNodes) {
  const FederationFile one = parse_federation_file(one_address, "games/rink.toml");
  EXPECT_EQ(one.federation, "rink");
  EXPECT_EQ(one.fom, std::vector<std::string>{"games/rink.fom.xml"});
  ASSERT_EQ(one.nodes.size(), 1u);
  EXPECT_EQ(one.nodes[0].port, 7000);
  const FederationFile two = parse_federation_file(two_nodes, "rink.toml");
  EXPECT_EQ(two.fom, std::vector<std::string>{"/etc/rink.fom.xml"});
  ASSERT_EQ(two.nodes.size(), 2u);
  EXPECT_EQ(two.nodes[1].address, "host-b");
  EXPECT_EQ(two.members(), std::vector<std::string>{"b"});
  EXPECT_TRUE(one.members().empty()) << "anybody may join";
}

TEST(FederationFile, ANodeThatOnlyAsksNeedsNoAddressAndTheRtisAloneIsNoList) {
  const std::string head = "federation = \"rink\"\nfom = \"rink.fom.xml\"\n[[node]]\nname = \"server\"\naddress = \"host-a\"\nport = 7000\n";
  const FederationFile file = parse_federation_file(head + "[[node]]\nname = \"bat-0\"\n[[node]]\nname = \"bat-1\"\n", "rink.toml");
  EXPECT_EQ(file.members(), (std::vector<std::string>{"bat-0", "bat-1"}));
  EXPECT_EQ(file.nodes[2].port, 0);
  const auto complaint_of = [](const std::string& text) -> std::string {
    try {
      parse_federation_file(text, "rink.toml");
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint_of(head), "rink.toml:3: key 'node' lists the RTI's node alone; list those that join it, too, or give 'address' and 'port' instead and let anybody join");
  EXPECT_EQ(complaint_of(head + "[[node]]\nname = \"bat-0\"\naddress = \"host-b\"\n"), "rink.toml:7: key 'port' is missing");
}

TEST(FederationFile, ErrorsNameFileLineKeyAndWhatIsAllowed) {
  const auto one = [](const std::string& from, const std::string& to) {
    return complaint(one_address, from, to, [](const std::string& text) { return parse_federation_file(text, "rink.toml"); });
  };
  const auto two = [](const std::string& from, const std::string& to) {
    return complaint(two_nodes, from, to, [](const std::string& text) { return parse_federation_file(text, "rink.toml"); });
  };
  EXPECT_EQ(one("address", "adress"), "rink.toml:3: unknown key 'adress'; allowed are federation, fom, address, port, node");
  EXPECT_EQ(one("7000", "70000"), "rink.toml:4: key 'port' must be a whole number from 1 to 65535");
  EXPECT_EQ(one("7000", "\"7000\""), "rink.toml:4: key 'port' must be a whole number from 1 to 65535");
  EXPECT_EQ(one("\"rink\"", "3"), "rink.toml:1: key 'federation' must be a text that is not empty");
  EXPECT_EQ(one("fom = \"rink.fom.xml\"\n", ""), "rink.toml:1: key 'fom' is missing");
  EXPECT_EQ(one("port = 7000", "port =").find("rink.toml:4: no well-formed TOML"), 0u);
  EXPECT_EQ(two("name = \"b\"", "name = \"a\""), "rink.toml:9: key 'name': two nodes are called 'a'");
  EXPECT_EQ(two("[[node]]", "address = \"x\"\n[[node]]"), "rink.toml:4: key 'address' and a list of [[node]] exclude each other");
  EXPECT_EQ(two("port = 7001", "port = 7001\nspeed = 1"), "rink.toml:13: unknown key 'speed'; allowed are name, address, port");
}

}  // namespace
}  // namespace rink::rti::testing
