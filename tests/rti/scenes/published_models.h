// Object models with the counts, widths and syntax of those that are published: RPR 2.0, NETN 4,
// the standard's Restaurant sample and its management and initialization module. Names are made up,
// and what varies is drawn from a seed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "rti/fom/fom.h"

namespace rink::rti::testing {

/// How much of what one module has. Widths are the members of its widest class, its own scaffolds
/// included.
struct ModuleShape {
  const char* name;
  int classes = 0, width = 0, interactions = 0, parameter_width = 0;
  int basic = 0, simple = 0, enumerated = 0, enumerators = 0, arrays = 0, records = 0, variants = 0;
  bool has_switches = false;
};

inline constexpr std::array rpr_shapes = {
    ModuleShape{"Foundation", 0, 0, 0, 0, 4, 0, 1, 2, 2, 0, 0},
    ModuleShape{"Enumerations", 0, 0, 0, 0, 0, 0, 89, 3952, 0, 0, 0},
    ModuleShape{"Switches", 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, true},
    ModuleShape{"Base", 2, 5, 0, 0, 0, 32, 0, 0, 21, 26, 3},
    ModuleShape{"Physical", 18, 41, 3, 15, 0, 2, 0, 0, 3, 4, 0},
    ModuleShape{"Aggregate", 1, 12, 0, 0, 0, 0, 0, 0, 4, 3, 0},
    ModuleShape{"Communication", 3, 17, 6, 7, 0, 3, 1, 2, 3, 5, 3},
    ModuleShape{"Emission", 14, 51, 0, 0, 0, 2, 0, 0, 1, 1, 0},
    ModuleShape{"Logistics", 0, 0, 7, 4, 0, 0, 0, 0, 1, 1, 0},
    ModuleShape{"Minefield", 8, 18, 9, 22, 0, 2, 0, 0, 10, 3, 0},
    ModuleShape{"Environment", 19, 17, 16, 19, 0, 0, 1, 2, 7, 32, 3},
    ModuleShape{"Management", 0, 0, 43, 9, 0, 0, 0, 0, 6, 4, 0},
    ModuleShape{"Acoustics", 6, 9, 2, 4, 0, 1, 0, 0, 1, 1, 0},
    ModuleShape{"Warfare", 0, 0, 3, 14, 0, 0, 0, 0, 0, 0, 0},
};
/// NETN 4 merged with RPR, as one module.
inline constexpr ModuleShape netn_shape{"Merged", 109,  88,  193, 23, 4,   74,
                                        155,      4822, 100, 177, 18, true};

/// Writes modules whose types build on those of the modules before.
class ModuleWriter {
 public:
  explicit ModuleWriter(unsigned seed) : random_(seed) {}

  FomModule write(const ModuleShape& shape) {
    name_ = shape.name;
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n<objectModel "
        "xsi:schemaLocation=\"http://standards.ieee.org/IEEE1516-2010 schema.xsd\" "
        "xmlns=\"http://standards.ieee.org/IEEE1516-2010\" "
        "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\">\n<modelIdentification><name>" +
        name_ + " module</name><type>FOM</type></modelIdentification>\n";
    const std::string types = data_types(shape);
    if (shape.classes > 0) text += "<objects>" + objects(shape) + "</objects>\n";
    if (shape.interactions > 0)
      text += "<interactions>" + interactions(shape) + "</interactions>\n";
    if (shape.has_switches) text += switches();
    if (!types.empty()) text += "<dataTypes>" + types + "</dataTypes>\n";
    text += "<notes><note><label>note</label><semantics>none</semantics></note></notes>\n";
    return {text + "</objectModel>\n", name_ + ".xml"};
  }

 private:
  static std::string tag(const std::string& name, const std::string& content) {
    return "<" + name + ">" + content + "</" + name + ">";
  }
  std::string own(const char* kind, int number) const {
    return name_ + kind + std::to_string(number);
  }
  std::string any(const std::vector<std::string>& of) { return of[random_() % of.size()]; }
  std::string any_type() { return types_.empty() ? "HLAoctet" : any(types_); }

  /// Basic representations, then what builds on them: the first types of a model are standard.
  std::string data_types(const ModuleShape& shape) {
    std::string basic, simple, enumerated, arrays, records, variants;
    for (int i = 0; i < shape.basic; ++i) {
      const std::string name = own("Unsigned", 8 << i);
      basic += tag("basicData", tag("name", name) + tag("size", std::to_string(8 << i)) +
                                    tag("interpretation", "Integer") + tag("endian", "Big") +
                                    tag("encoding", "An unsigned integer."));
      representations_.push_back(name);
    }
    for (int i = 0; i < shape.enumerated; ++i) {
      const int count = std::max(1, shape.enumerators / shape.enumerated +
                                        (i < shape.enumerators % shape.enumerated ? 1 : 0));
      enumerated += enumeration(own("Kind", i), count);
    }
    for (int i = 0; i < shape.simple; ++i)
      simple += tag("simpleData", tag("name", note(own("Measure", i))) +
                                      tag("representation", any(representations_)) +
                                      "<units>m</units><resolution/><accuracy/>");
    for (int i = 0; i < shape.arrays; ++i) arrays += array(own("List", i));
    for (int i = 0; i < shape.records; ++i) records += record(own("Record", i));
    for (int i = 0; i < shape.variants; ++i) variants += variant(own("Choice", i));
    const auto section = [](const char* name, const std::string& content) {
      return content.empty() ? "" : tag(name, content);
    };
    return section("basicDataRepresentations", basic) + section("simpleDataTypes", simple) +
           section("enumeratedDataTypes", enumerated) + section("arrayDataTypes", arrays) +
           section("fixedRecordDataTypes", records) + section("variantRecordDataTypes", variants);
  }
  /// Makes a type known to what comes later.
  std::string note(const std::string& name) {
    types_.push_back(name);
    return name;
  }
  std::string enumeration(const std::string& name, int count) {
    std::string text = tag("name", note(name)) + tag("representation", "HLAinteger32BE");
    for (int i = 0; i < count; ++i)
      text +=
          tag("enumerator", tag("name", "E" + std::to_string(i)) + tag("value", std::to_string(i)));
    enumerations_.emplace_back(name, count);
    return tag("enumeratedData", text);
  }
  std::string array(const std::string& name) {
    static const std::vector<std::string> cardinalities{"Dynamic", "Dynamic", "[2..4]", "3", "16"},
        encodings{"HLAvariableArray", "HLAfixedArray", "OwnLengthlessArray", "OwnPaddingTo32Array"};
    const std::string element = any_type();
    return tag("arrayData", tag("name", note(name)) + tag("dataType", element) +
                                tag("cardinality", any(cardinalities)) +
                                tag("encoding", any(encodings)));
  }
  std::string record(const std::string& name) {
    std::string fields;
    for (int i = 0, count = 2 + static_cast<int>(random_() % 3); i < count; ++i)
      fields += tag("field", tag("name", "F" + std::to_string(i)) + tag("dataType", small_type()) +
                                 tag("semantics", "None."));
    small_.push_back(name);
    return tag("fixedRecordData",
               tag("name", note(name)) + tag("encoding", "HLAfixedRecord") + fields);
  }
  /// Not too long, however deep records lie in each other.
  std::string small_type() {
    static const std::vector<std::string> leaves{"HLAoctet", "HLAfloat64BE", "HLAinteger32BE",
                                                 "HLAunicodeString", "HLAboolean"};
    return small_.size() < 4 || random_() % 3 != 0 ? any(leaves) : small_[random_() % 4];
  }
  /// Alternatives by lists and ranges of the enumerators, HLAother where some are left.
  std::string variant(const std::string& name) {
    const auto& [kind, count] = enumerations_[random_() % enumerations_.size()];
    std::string text =
        tag("name", note(name)) + tag("discriminant", "Kind") + tag("dataType", kind);
    int next = 0;
    for (int i = 0; next < count && i < 4; ++i) {
      const int taken = std::min(count - next, 1 + static_cast<int>(random_() % 6));
      std::string list;
      if (taken > 2 && random_() % 2 == 0) {
        list = "[E" + std::to_string(next) + " .. E" + std::to_string(next + taken - 2) + "], E" +
               std::to_string(next + taken - 1);
      } else {
        for (int k = 0; k < taken; ++k) list += (k > 0 ? ", E" : "E") + std::to_string(next + k);
      }
      next += taken;
      text += alternative(list, i);
    }
    if (next < count) text += alternative("HLAother", 9);
    return tag("variantRecordData", text + tag("encoding", "HLAvariantRecord"));
  }
  std::string alternative(const std::string& list, int number) {
    return tag("alternative", tag("enumerator", list) + tag("name", "A" + std::to_string(number)) +
                                  tag("dataType", number == 2 ? "HLAtoken" : small_type()));
  }

  static std::string travel(bool is_reliable) {
    return tag("transportation", is_reliable ? "HLAreliable" : "HLAbestEffort") +
           tag("order", "Receive");
  }
  std::string attributes(int from, int count) {
    std::string text;
    for (int i = from; i < from + count; ++i)
      text += tag("attribute", tag("name", own("Attribute", i)) + tag("dataType", any_type()) +
                                   "<updateType>Conditional</updateType><updateCondition>On "
                                   "change.</updateCondition><ownership>DivestAcquire</ownership>"
                                   "<sharing>PublishSubscribe</sharing><dimensions/>" +
                                   travel(i % 4 == 0) + tag("semantics", "None."));
    return text;
  }
  /// A base class, then a chain that grows to the full width, then siblings without members below
  /// the base.
  std::string objects(const ModuleShape& shape) {
    const int chain = std::min(shape.classes, 4), per_class = shape.width / chain;
    std::string inner;
    for (int i = chain; i-- > 0;) {
      std::string text =
          tag("name", own("Class", i)) + tag("sharing", "PublishSubscribe") +
          attributes(i * per_class, per_class + (i == chain - 1 ? shape.width % chain : 0));
      if (i == 0)
        for (int k = chain; k < shape.classes; ++k)
          inner += tag("objectClass", tag("name", own("Class", k)) + tag("sharing", "Neither"));
      inner = tag("objectClass", text + inner);
    }
    return tag("objectClass", tag("name", "HLAobjectRoot") + tag("sharing", "Neither") + inner);
  }
  std::string interactions(const ModuleShape& shape) {
    std::string all;
    for (int k = 0; k < shape.interactions; ++k) {
      std::string text = tag("name", own("Message", k)) + tag("sharing", "PublishSubscribe") +
                         "<dimensions/>" + travel(k % 2 == 0);
      for (int i = 0; i < (k == 0 ? shape.parameter_width : k % 5); ++i)
        text += tag("parameter", tag("name", own("Parameter", i)) + tag("dataType", any_type()));
      all += tag("interactionClass", text);
    }
    return tag("interactionClass", tag("name", "HLAinteractionRoot") + all);
  }
  static std::string switches() {
    std::string text;
    for (const char* each :
         {"autoProvide", "conveyRegionDesignatorSets", "conveyProducingFederate",
          "attributeScopeAdvisory", "attributeRelevanceAdvisory", "objectClassRelevanceAdvisory",
          "interactionRelevanceAdvisory", "serviceReporting", "exceptionReporting",
          "delaySubscriptionEvaluation"})
      text += std::string("<") + each + " isEnabled=\"false\"/>";
    return tag("switches",
               text + "<automaticResignAction resignAction=\"CancelThenDeleteThenDivest\"/>");
  }

  std::mt19937 random_;
  std::string name_;
  std::vector<std::string> representations_{"HLAinteger32BE", "HLAoctet", "HLAfloat32BE"};
  std::vector<std::string> types_{"HLAunicodeString", "HLAboolean", "HLAfloat64BE"}, small_;
  std::vector<std::pair<std::string, int>> enumerations_;
};

/// A module like the standard's own: 33 attributes of HLAfederate, 85 interaction classes, types,
/// dimensions and the order of the root of interactions.
inline FomModule management_module() {
  std::string attributes =
                  "<attribute><name>HLAfederateHandle</name><dataType>HLAhandle</dataType>"
                  "</attribute>",
              reports;
  for (int i = 1; i < 33; ++i)
    attributes += "<attribute><name>HLAcount" + std::to_string(i) +
                  "</name><dataType>HLAcount</dataType></attribute>";
  for (int i = 0; i < 83; ++i)
    reports += "<interactionClass><name>HLAreport" + std::to_string(i) +
               "</name><parameter><name>HLAlist" + std::to_string(i) +
               "</name><dataType>HLAhandleList</dataType></parameter></interactionClass>";
  return {
      "<objectModel xmlns=\"http://standards.ieee.org/IEEE1516-2010\"><modelIdentification>"
      "<name>Management</name></modelIdentification><objects><objectClass><name>HLAobjectRoot"
      "</name><attribute><name>HLAprivilegeToDeleteObject</name><dataType>HLAtoken</dataType>"
      "</attribute><objectClass><name>HLAmanager</name><objectClass><name>HLAfederate</name>" +
          attributes +
          "</objectClass></objectClass></objectClass></objects><interactions>"
          "<interactionClass><name>HLAinteractionRoot</name><transportation>HLAreliable"
          "</transportation><order>TimeStamp</order><interactionClass><name>HLAmanager</name>" +
          reports +
          "</interactionClass></interactionClass></interactions><dimensions><dimension><name>"
          "HLAfederate</name><upperBound>65536</upperBound></dimension><dimension><name>"
          "HLAserviceGroup</name><upperBound>7</upperBound></dimension></dimensions>"
          "<transportations><transportation><name>HLAreliable</name><reliable>Yes</reliable>"
          "</transportation></transportations><dataTypes><basicDataRepresentations><basicData>"
          "<name>HLAinteger32BE</name><size>32</size><encoding>its own words</encoding>"
          "</basicData></basicDataRepresentations><simpleDataTypes><simpleData><name>HLAcount"
          "</name><representation>HLAinteger32BE</representation></simpleData>"
          "</simpleDataTypes><enumeratedDataTypes><enumeratedData><name>HLAboolean</name>"
          "<representation>HLAinteger32BE</representation><enumerator><name>HLAfalse</name>"
          "<value>0</value></enumerator><enumerator><name>HLAtrue</name><value>1</value>"
          "</enumerator></enumeratedData></enumeratedDataTypes><arrayDataTypes><arrayData>"
          "<name>HLAhandle</name><dataType>HLAbyte</dataType><cardinality>Dynamic"
          "</cardinality><encoding>HLAvariableArray</encoding></arrayData><arrayData><name>"
          "HLAtoken</name><dataType>HLAbyte</dataType><cardinality>0</cardinality><encoding>"
          "HLAfixedArray</encoding></arrayData></arrayDataTypes></dataTypes></objectModel>\n",
      "management.xml"};
}

/// What the Restaurant sample has that others have not: a transportation type and times of its own,
/// update rates, lists and ranges of enumerators, dimensions, attributes and parameters without a
/// data type.
inline FomModule tavern_module() {
  return {R"(<?xml version="1.0"?>
<objectModel xmlns="http://standards.ieee.org/IEEE1516-2010">
<modelIdentification><name>Tavern</name></modelIdentification>
<objects><objectClass><name>HLAobjectRoot</name><sharing>Neither</sharing>
  <attribute><name>HLAprivilegeToDeleteObject</name><dataType>NA</dataType></attribute>
  <objectClass><name>Cook</name>
    <attribute><name>pay</name><dataType>Coins</dataType><dimensions/><transportation>Swift</transportation><order>TimeStamp</order></attribute>
    <attribute><name>mood</name></attribute>
    <attribute><name>rank</name><dataType>Rating</dataType><dimensions><dimension>Stove</dimension></dimensions></attribute>
  </objectClass></objectClass></objects>
<interactions><interactionClass><name>HLAinteractionRoot</name>
  <interactionClass><name>Served</name><sharing>Publish</sharing><dimensions><dimension>Stove</dimension></dimensions>
    <transportation>HLAreliable</transportation><order>TimeStamp</order>
    <parameter><name>dish</name></parameter></interactionClass></interactionClass></interactions>
<dimensions><dimension><name>Stove</name><dataType>StoveKind</dataType><upperBound>3</upperBound>
  <normalization>linearEnumerated (Stove, [Small, Large])</normalization><value>[0..3)</value></dimension></dimensions>
<time><timeStamp><dataType>HLAinteger64Time</dataType></timeStamp><lookahead><dataType>NA</dataType></lookahead></time>
<tags><updateReflectTag><dataType>NA</dataType></updateReflectTag></tags>
<synchronizations><synchronizationPoint><label>Opened</label><dataType>NA</dataType><capability>Achieve</capability></synchronizationPoint></synchronizations>
<transportations><transportation><name>Swift</name><reliable>No</reliable></transportation></transportations>
<updateRates><updateRate><name>Low</name><rate>10.5</rate></updateRate></updateRates>
<dataTypes>
  <simpleDataTypes><simpleData><name>Coins</name><representation>HLAinteger16BE</representation></simpleData></simpleDataTypes>
  <enumeratedDataTypes>
    <enumeratedData><name>StoveKind</name><representation>HLAoctet</representation>
      <enumerator><name>Small</name><value>[1..3], 7</value></enumerator><enumerator><name>Large</name><value>4</value><value>5</value></enumerator></enumeratedData>
    <enumeratedData><name>Rank</name><representation>HLAinteger32BE</representation>
      <enumerator><name>Boy</name><value>-1</value></enumerator><enumerator><name>Hand</name><value>0x10</value></enumerator>
      <enumerator><name>Mate</name><value>17</value></enumerator><enumerator><name>Master</name><value>18</value></enumerator></enumeratedData>
  </enumeratedDataTypes>
  <variantRecordDataTypes><variantRecordData><name>Rating</name><discriminant>rank</discriminant><dataType>Rank</dataType>
    <alternative><enumerator>[Hand .. Mate], Master</enumerator><name>stars</name><dataType>HLAoctet</dataType></alternative>
    <alternative><enumerator>HLAother</enumerator><name>none</name><dataType>HLAtoken</dataType></alternative>
    <encoding>HLAvariantRecord</encoding></variantRecordData></variantRecordDataTypes>
</dataTypes></objectModel>
)",
          "tavern.xml"};
}

}  // namespace rink::rti::testing
