// Object models and federation files: what they mean, and how they are refused.
#include <gtest/gtest.h>

#include "rti/federation_file.h"
#include "rti/fom/quantised_codec.h"
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
  EXPECT_EQ(fom.at(*fom.object_class("Tide")).attributes[0].transportation,
            Transportation::best_effort);
  EXPECT_EQ(fom.at(vessel).attributes[position.value].dimensions,
            (DimensionSet{*fom.dimension("X"), *fom.dimension("Y")}));
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
  EXPECT_FALSE(harbour().values_fit(ferry, AttributeSet{speed, destination},
                                    Bytes(values).first(values.size() - 1)));
  EXPECT_EQ(harbour().value(ferry, AttributeSet{speed, destination}, destination, values).size(),
            town.size());
}

/// A model whose only attribute is of type Value, which `types` declare.
Fom model_with(const std::string& types) {
  return Fom::parse(
      "<objectModel><modelIdentification><name>Types</name></"
      "modelIdentification><objects><objectClass><name>HLAobjectRoot</"
      "name><objectClass><name>Thing</name>"
      "<attribute><name>value</name><dataType>Value</dataType></attribute></objectClass></"
      "objectClass></objects><dataTypes>" +
          types +
          "</dataTypes>"
          "<notes><note><label>small</label><semantics>range 0 "
          "255</semantics></note></notes></objectModel>",
      "types.xml");
}
std::string record(const std::string& name, const std::vector<std::string>& fields,
                   const std::string& encoding = "") {
  std::string text = "<fixedRecordData><name>" + name + "</name>" +
                     (encoding.empty() ? "" : "<encoding>" + encoding + "</encoding>");
  for (std::size_t i = 0; i < fields.size(); ++i)
    text += "<field><name>f" + std::to_string(i) + "</name><dataType>" + fields[i] +
            "</dataType></field>";
  return text + "</fixedRecordData>";
}
std::string records(const std::string& all) {
  return "<fixedRecordDataTypes>" + all + "</fixedRecordDataTypes>";
}
std::string array(const std::string& name, const std::string& element,
                  const std::string& cardinality, const std::string& encoding = "") {
  return "<arrayDataTypes><arrayData><name>" + name + "</name><dataType>" + element +
         "</dataType><cardinality>" + cardinality + "</cardinality>" +
         (encoding.empty() ? "" : "<encoding>" + encoding + "</encoding>") +
         "</arrayData></arrayDataTypes>";
}
std::optional<std::uint32_t> value_size(const std::string& types) {
  const Fom fom = model_with(types);
  return fom.values_size(*fom.object_class("Thing"), AttributeSet{AttributeHandle{0}});
}

TEST(Fom, FieldsOfARecordBeginAtTheirOctetBoundariesAndNothingLiesBehindTheLast) {
  // IEEE 1516.2-2010, 4.13.9: P bytes after a field so that (offset + size + P) mod V = 0, V being
  // the next field's octet boundary value.
  EXPECT_EQ(value_size(records(
                record("Value", {"HLAoctet", "HLAfloat64BE", "HLAoctet"}, "HLAfixedRecord"))),
            1u + 7 + 8 + 1);
  EXPECT_EQ(value_size(records(record("Value", {"HLAoctet", "HLAfloat64BE", "HLAoctet"}))), 17u)
      << "HLAfixedRecord where the model says nothing";
  EXPECT_EQ(value_size(records(
                record("Value", {"HLAoctet", "HLAinteger16BE", "HLAoctet", "HLAinteger32LE"}))),
            1u + 1 + 2 + 1 + 3 + 4);
  EXPECT_EQ(value_size(records(record("Value", {"HLAfloat64LE", "HLAoctet"}))), 9u);
  EXPECT_EQ(value_size(records(record("Value", {"HLAoctet", "HLAboolean"}))), 1u + 3 + 4)
      << "an HLAboolean is an HLAinteger32BE";
  EXPECT_EQ(value_size(records(record("Value", {"HLAoctet", "HLAunicodeChar"}))), 1u + 1 + 2);
}

TEST(Fom, ARecordsBoundaryIsTheGreatestOfItsFields) {
  const std::string inner = record(
      "Inner", {"HLAoctet", "HLAinteger32BE", "HLAoctet"});  // 1 + 3 + 4 + 1, at multiples of 4
  EXPECT_EQ(value_size(records(inner + record("Value", {"HLAinteger16BE", "Inner", "Inner"}))),
            2u + 2 + 9 + 3 + 9);
  EXPECT_EQ(value_size(records(inner + record("Value", {"HLAoctet", "Inner", "HLAfloat64BE"}))),
            1u + 3 + 9 + 3 + 8);
}

TEST(Fom, SimpleAndEnumeratedTypesHaveTheBoundaryOfWhatRepresentsThem) {
  const std::string basic =
      "<basicDataRepresentations><basicData><name>Triple</name><size>24</size></basicData></"
      "basicDataRepresentations>";  // 3 bytes at multiples of 4: 8 * 2^2 >= 24
  const std::string others =
      "<simpleDataTypes><simpleData><name>Weight</name><representation>Triple</representation></"
      "simpleData></simpleDataTypes>"
      "<enumeratedDataTypes><enumeratedData><name>Colour</name><representation>HLAinteger16LE</"
      "representation></enumeratedData></enumeratedDataTypes>";
  EXPECT_EQ(value_size(basic + others +
                       records(record("Value", {"HLAoctet", "Weight", "HLAoctet", "Colour"}))),
            1u + 3 + 3 + 1 + 2);
}

TEST(Fom, ElementsOfAnArrayBeginAtTheirOctetBoundaries) {
  const std::string place =
      records(record("Place", {"HLAfloat64BE", "HLAoctet"}));  // 9 bytes at multiples of 8
  EXPECT_EQ(value_size(place + array("Value", "Place", "3", "HLAfixedArray")), 2u * (9 + 7) + 9);
  EXPECT_EQ(value_size(place + array("Value", "Place", "3")), 41u);
  EXPECT_EQ(value_size(array("Value", "HLAoctet", "5", "HLAfixedArray")), 5u);
  EXPECT_EQ(value_size(place + array("Value", "Place", "0", "HLAfixedArray")), 0u);
  // 4.13.9.4: behind the number of elements, an HLAinteger32BE, the first element begins at a
  // multiple of its boundary.
  EXPECT_EQ(value_size(place + array("Value", "Place", "3", "HLAvariableArray")),
            4u + 4 + 2 * (9 + 7) + 9);
  EXPECT_EQ(value_size(array("Value", "HLAoctet", "5", "HLAvariableArray")), 4u + 5);
  EXPECT_EQ(value_size(array("Value", "HLAoctet", "Dynamic", "HLAvariableArray")), std::nullopt)
      << "its length travels";
  const std::string row = array("Row", "HLAinteger16BE", "3"),
                    list = array("List", "HLAoctet", "2", "HLAvariableArray");
  EXPECT_EQ(value_size(row + records(record("Value", {"HLAoctet", "Row"}))), 1u + 1 + 6)
      << "an array has the boundary of its elements";
  EXPECT_EQ(value_size(list + records(record("Value", {"HLAoctet", "List"}))), 1u + 3 + 4 + 2)
      << "or at least that of its count";
}

TEST(Fom, AnEncodingOfTheModelsOwnLaysFieldsSideBySide) {
  EXPECT_EQ(value_size(records(record("Value", {"HLAoctet", "HLAfloat64BE", "HLAoctet"},
                                      "packed, as our devices write it"))),
            10u);
  EXPECT_EQ(value_size(records(record("Place", {"HLAfloat64BE", "HLAoctet"})) +
                       array("Value", "Place", "3", "packed")),
            27u);
}

TEST(Fom, PaddingDoesNotTravelWithQuantisedValues) {
  const std::string small =
      "<simpleDataTypes><simpleData "
      "notes=\"small\"><name>Small</name><representation>HLAfloat32LE</"
      "representation><resolution>1</resolution></simpleData></simpleDataTypes>";
  const Fom fom = model_with(small + records(record("Inner", {"Small", "HLAoctet"}) +
                                             record("Value", {"HLAoctet", "Inner", "Small"})));
  const Attribute& value = fom.at(*fom.object_class("Thing")).attributes[0];
  ASSERT_TRUE(value.codec);
  EXPECT_EQ(value.size, 1u + 3 + 4 + 1 + 3 + 4);
  for (const auto& [second, bits] :
       {std::pair{200.0f, 1 + 8 + 8 + 8 + 8},
        std::pair{300.0f,
                  1 + 8 + 32 + 8 + 32}}) {  // 300 is out of its range: all bits of all fields
    std::vector<std::byte> plain, coded, decoded;
    const auto add = [&plain](const auto& part) {
      const auto bytes = values_of(part);
      plain.insert(plain.end(), bytes.begin(), bytes.end());
    };
    add(std::uint8_t{7}), plain.resize(4), add(second), add(std::uint8_t{9}), plain.resize(12),
        add(42.0f);
    value.codec->encode(plain, 0.0, coded);
    EXPECT_EQ(coded.size(), (static_cast<unsigned>(bits) + 7u) / 8u);
    EXPECT_EQ(value.codec->size(coded), coded.size());
    ASSERT_TRUE(value.codec->decode(coded, 0.0, decoded));
    EXPECT_EQ(decoded, plain);
  }
  EXPECT_EQ(value.codec->name(), "rink-quantised-1 0l1 1l4:0:0:255+3 0l1 1l4:0:0:255+3");
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
  EXPECT_TRUE(fom.interaction_class("KeyDown") && fom.interaction_class("KeyUp") &&
              fom.interaction_class("Update"));
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
  return complaint(harbour_xml, from, to,
                   [](const std::string& text) { return Fom::parse(text, "harbour.xml"); });
}

TEST(Fom, ErrorsNameFileLineElementAndWhatIsAllowed) {
  EXPECT_EQ(
      fom_complaint("<dataType>Position</dataType>", "<dataType>Place</dataType>"),
      "harbour.xml:7: <attribute> 'position' has the unknown data type 'Place'; allowed are "
      "those in <dataTypes> and the standard's, such as HLAfloat32LE (IEEE 1516.2-2010, 4.4)");
  EXPECT_EQ(fom_complaint("<order>TimeStamp</order>", "<order>Sorted</order>"),
            "harbour.xml:10: <attribute> 'destination' has order 'Sorted'; allowed are Receive, "
            "TimeStamp (IEEE 1516.2-2010, 4.4)");
  EXPECT_EQ(fom_complaint("HLAbestEffort", "carrierPigeon"),
            "harbour.xml:14: <attribute> 'level' has transportation 'carrierPigeon'; allowed are "
            "HLAreliable, HLAbestEffort and those in <transportations> (IEEE 1516.2-2010, 4.4)");
  EXPECT_EQ(fom_complaint("<name>speed</name>", "<name>position</name>"),
            "harbour.xml:8: <attribute> 'position' is declared twice in class 'Vessel' or what it "
            "inherits (IEEE 1516.2-2010, 4.4)");
  EXPECT_EQ(fom_complaint("<name>speed</name>", ""),
            "harbour.xml:8: <attribute> lacks <name> (IEEE 1516.2-2010, 4.4)");
  EXPECT_EQ(fom_complaint("<dimension>Y</dimension>", "<dimension>Z</dimension>"),
            "harbour.xml:7: <attribute> 'position' has the unknown dimension 'Z'; allowed are "
            "those in <dimensions> (IEEE 1516.2-2010, 4.6)");
  EXPECT_EQ(fom_complaint("<objectClass><name>Tide", "<objectClass><name>Vessel"),
            "harbour.xml:13: <objectClass> 'Vessel' is declared twice (IEEE 1516.2-2010, 4.2)");
  EXPECT_EQ(fom_complaint("<field><name>x</name><dataType>HLAfloat32LE",
                          "<field><name>x</name><dataType>Position"),
            "harbour.xml:28: data type 'Position' contains itself (IEEE 1516.2-2010, 4.13)");
  EXPECT_EQ(fom_complaint("<objectModel>", "<model>").substr(0, 16), "harbour.xml:34: ")
      << "where the tags cease to match";
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

constexpr const char* one_address =
    "federation = \"rink\"\nfom = \"rink.fom.xml\"\naddress = \"127.0.0.1\"\nport = 7000\n";
constexpr const char* two_nodes =
    "federation = \"rink\"\nfom = \"/etc/rink.fom.xml\"\n\n[[node]]\nname = \"a\"\naddress = "
    "\"host-a\"\nport = 7000\n\n[[node]]\nname = \"b\"\naddress = "
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
  const std::string head =
      "federation = \"rink\"\nfom = \"rink.fom.xml\"\n[[node]]\nname = \"server\"\naddress = "
      "\"host-a\"\nport = 7000\n";
  const FederationFile file = parse_federation_file(
      head + "[[node]]\nname = \"bat-0\"\n[[node]]\nname = \"bat-1\"\n", "rink.toml");
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
  EXPECT_EQ(complaint_of(head),
            "rink.toml:3: key 'node' lists the RTI's node alone; list those that join it, too, or "
            "give 'address' and 'port' instead and let anybody join");
  EXPECT_EQ(complaint_of(head + "[[node]]\nname = \"bat-0\"\naddress = \"host-b\"\n"),
            "rink.toml:7: key 'port' is missing");
}

TEST(FederationFile, ErrorsNameFileLineKeyAndWhatIsAllowed) {
  const auto one = [](const std::string& from, const std::string& to) {
    return complaint(one_address, from, to, [](const std::string& text) {
      return parse_federation_file(text, "rink.toml");
    });
  };
  const auto two = [](const std::string& from, const std::string& to) {
    return complaint(two_nodes, from, to, [](const std::string& text) {
      return parse_federation_file(text, "rink.toml");
    });
  };
  EXPECT_EQ(one("address", "adress"),
            "rink.toml:3: unknown key 'adress'; allowed are federation, fom, address, port, node");
  EXPECT_EQ(one("7000", "70000"), "rink.toml:4: key 'port' must be a whole number from 1 to 65535");
  EXPECT_EQ(one("7000", "\"7000\""),
            "rink.toml:4: key 'port' must be a whole number from 1 to 65535");
  EXPECT_EQ(one("\"rink\"", "3"), "rink.toml:1: key 'federation' must be a text that is not empty");
  EXPECT_EQ(one("fom = \"rink.fom.xml\"\n", ""), "rink.toml:1: key 'fom' is missing");
  EXPECT_EQ(one("port = 7000", "port =").find("rink.toml:4: no well-formed TOML"), 0u);
  EXPECT_EQ(two("name = \"b\"", "name = \"a\""),
            "rink.toml:9: key 'name': two nodes are called 'a'");
  EXPECT_EQ(two("[[node]]", "address = \"x\"\n[[node]]"),
            "rink.toml:4: key 'address' and a list of [[node]] exclude each other");
  EXPECT_EQ(two("port = 7001", "port = 7001\nspeed = 1"),
            "rink.toml:13: unknown key 'speed'; allowed are name, address, port");
}

}  // namespace
}  // namespace rink::rti::testing
