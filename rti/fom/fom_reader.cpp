// Reads an IEEE 1516.2 OMT XML file; every complaint names file, line and element.
#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "rti/fom/fom.h"
#include "rti/fom/quantisation_reader.h"

namespace rink::rti {

namespace {

constexpr std::size_t class_max = 4096, parameter_max = 64;

struct BasicType {
  const char* name;
  std::uint32_t size;
};
/// The fixed-size representations of IEEE 1516.2, with its predefined HLAbyte, HLAASCIIchar, HLAunicodeChar and HLAboolean.
constexpr std::array basic_types = {
    BasicType{"HLAoctet", 1},        BasicType{"HLAbyte", 1},         BasicType{"HLAASCIIchar", 1},    BasicType{"HLAoctetPairBE", 2},
    BasicType{"HLAoctetPairLE", 2},  BasicType{"HLAunicodeChar", 2},  BasicType{"HLAinteger16BE", 2},  BasicType{"HLAinteger16LE", 2},
    BasicType{"HLAinteger32BE", 4},  BasicType{"HLAinteger32LE", 4},  BasicType{"HLAinteger64BE", 8},  BasicType{"HLAinteger64LE", 8},
    BasicType{"HLAfloat32BE", 4},    BasicType{"HLAfloat32LE", 4},    BasicType{"HLAfloat64BE", 8},    BasicType{"HLAfloat64LE", 8},
    BasicType{"HLAboolean", 4},
};
/// Types of the standard whose size varies.
constexpr std::array varying_types = {"HLAASCIIstring", "HLAunicodeString", "HLAopaqueData", "HLAtoken"};

}  // namespace

/// One reading of one file.
class FomReader {
 public:
  FomReader(std::string_view xml, const std::string& source) : xml_(xml), source_(source) {}
  Fom read();

 private:
  using Node = pugi::xml_node;
  using Size = std::optional<std::uint32_t>;  ///< nothing: it varies

  [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& what) const;
  [[noreturn]] void fail(const Node& node, const std::string& what) const { fail(node.offset_debug(), what); }
  static std::string path(const Node& node);
  std::string text(const Node& node, const char* child) const;
  std::string text_or(const Node& node, const char* child, const char* otherwise) const;

  void read_types(const Node& model);
  void declare(const Node& node);
  Size size_of(const std::string& type, const Node& user);
  Size size_of_array(const Node& node);
  Size size_of_record(const Node& node);
  void read_dimensions(const Node& model);
  void read_object_class(const Node& node, ObjectClassHandle parent);
  Attribute read_attribute(const Node& node, const ObjectClass& owner);
  void read_interaction_class(const Node& node, InteractionClassHandle parent);
  void quantise(Attribute& attribute, bool is_periodic);
  Parameter read_parameter(const Node& node, const InteractionClass& owner);
  Transportation transportation(const Node& node) const;
  Order order(const Node& node) const;
  DimensionSet dimensions_of(const Node& node) const;
  std::optional<std::uint32_t> upper_bound(const Node& node) const;
  std::uint64_t hash() const;

  std::string_view xml_;
  std::string source_;
  pugi::xml_document document_;
  std::map<std::string, Node> declared_types_;
  std::map<std::string, Size> sizes_;
  std::set<std::string> being_sized_;
  std::map<std::string, std::shared_ptr<const QuantisedCodec>> codecs_;
  Fom fom_;
};

void FomReader::fail(std::ptrdiff_t offset, const std::string& what) const {
  const auto end = xml_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(xml_.size()));
  throw FileError(source_ + ":" + std::to_string(1 + std::count(xml_.begin(), end, '\n')) + ": " + what);
}

std::string FomReader::path(const Node& node) {
  const char* name = node.child("name").text().get();
  return "<" + std::string(node.name()) + ">" + (*name != 0 ? " '" + std::string(name) + "'" : std::string());
}

std::string FomReader::text(const Node& node, const char* child) const {
  const Node found = node.child(child);
  std::istringstream words(found.text().get());
  std::string word, rest;
  if (!found) fail(node, path(node) + " lacks <" + child + ">");
  if (!(words >> word) || words >> rest) fail(found, std::string("<") + child + "> of " + path(node) + " must hold one word, not '" + found.text().get() + "'");
  return word;
}

std::string FomReader::text_or(const Node& node, const char* child, const char* otherwise) const { return node.child(child) ? text(node, child) : otherwise; }

Fom FomReader::read() {
  const pugi::xml_parse_result result = document_.load_buffer(xml_.data(), xml_.size());
  if (!result) fail(result.offset, std::string("no well-formed XML: ") + result.description());
  const Node model = document_.document_element();
  if (std::string_view(model.name()) != "objectModel") fail(model, "the outermost element must be <objectModel>, not <" + std::string(model.name()) + ">");
  fom_.name_ = model.child("modelIdentification").child("name").text().get();
  read_types(model);
  read_dimensions(model);
  const Node objects = model.child("objects"), interactions = model.child("interactions");
  if (!objects) fail(model, "<objectModel> lacks <objects>");
  for (const Node& node : objects.children("objectClass")) read_object_class(node, {});
  for (const Node& node : interactions.children("interactionClass")) read_interaction_class(node, {});
  fom_.hash_ = hash();
  return std::move(fom_);
}

void FomReader::declare(const Node& node) {
  const std::string name = text(node, "name");
  if (!declared_types_.emplace(name, node).second) fail(node, "data type '" + name + "' is declared twice");
}

void FomReader::read_types(const Node& model) {
  for (const Node& group : model.child("dataTypes").children()) {
    const std::string_view name = group.name();
    if (name != "basicDataRepresentations" && name != "simpleDataTypes" && name != "enumeratedDataTypes" && name != "arrayDataTypes" &&
        name != "fixedRecordDataTypes" && name != "variantRecordDataTypes")
      fail(group, "<dataTypes> holds <" + std::string(name) +
                      ">; allowed are basicDataRepresentations, simpleDataTypes, enumeratedDataTypes, arrayDataTypes, fixedRecordDataTypes, variantRecordDataTypes");
    for (const Node& node : group.children()) declare(node);
  }
}

FomReader::Size FomReader::size_of(const std::string& type, const Node& user) {
  if (const auto known = sizes_.find(type); known != sizes_.end()) return known->second;
  const auto declared = declared_types_.find(type);
  if (declared == declared_types_.end()) {
    for (const BasicType& basic : basic_types)
      if (type == basic.name) return basic.size;
    if (std::find(varying_types.begin(), varying_types.end(), type) != varying_types.end()) return std::nullopt;
    fail(user, path(user) + " has the unknown data type '" + type + "'; allowed are those in <dataTypes> and the standard's, such as HLAfloat32LE");
  }
  if (!being_sized_.insert(type).second) fail(declared->second, "data type '" + type + "' contains itself");
  const Node node = declared->second;
  const std::string_view kind = node.name();
  Size size;
  if (kind == "basicData") {
    const int bits = node.child("size").text().as_int();
    if (bits < 8 || bits > 1 << 20 || bits % 8 != 0) fail(node, path(node) + " must have a <size> in bits that is a multiple of 8, at most 1048576");
    size = static_cast<std::uint32_t>(bits / 8);
  } else if (kind == "simpleData" || kind == "enumeratedData") {
    size = size_of(text(node, "representation"), node);
  } else if (kind == "arrayData") {
    size = size_of_array(node);
  } else if (kind == "fixedRecordData") {
    size = size_of_record(node);
  }  // a variant record's size varies
  being_sized_.erase(type);
  sizes_[type] = size;
  return size;
}

FomReader::Size FomReader::size_of_array(const Node& node) {
  const std::string cardinality = text(node, "cardinality");
  const Size element = size_of(text(node, "dataType"), node);
  if (cardinality.find_first_not_of("0123456789") != std::string::npos) {
    if (cardinality != "Dynamic" && cardinality.front() != '[') fail(node, path(node) + " must have a <cardinality> that is a count, a [range] or Dynamic");
    return std::nullopt;
  }
  if (cardinality.size() > 6) fail(node, path(node) + " has more than 999999 elements");
  if (!element) return std::nullopt;
  const std::uint64_t size = std::stoull(cardinality) * *element;
  if (size > 1u << 20) fail(node, path(node) + " is longer than 1 MiB");
  return static_cast<std::uint32_t>(size);
}

FomReader::Size FomReader::size_of_record(const Node& node) {
  Size size = 0;
  for (const Node& field : node.children("field")) {
    const Size part = size_of(text(field, "dataType"), field);
    size = size && part ? Size(*size + *part) : std::nullopt;
  }
  if (size && *size > 1u << 20) fail(node, path(node) + " is longer than 1 MiB");
  return size;
}

void FomReader::read_dimensions(const Node& model) {
  for (const Node& node : model.child("dimensions").children("dimension")) {
    const std::string name = text(node, "name");
    if (fom_.dimension(name)) fail(node, "dimension '" + name + "' is declared twice");
    if (fom_.dimensions_.size() == dimension_max) fail(node, "more than " + std::to_string(dimension_max) + " dimensions");
    fom_.dimensions_.push_back({name, upper_bound(node)});
  }
}

std::optional<std::uint32_t> FomReader::upper_bound(const Node& node) const {
  if (!node.child("upperBound")) return std::nullopt;
  const std::string number = text(node, "upperBound");
  const bool is_number = number.find_first_not_of("0123456789") == std::string::npos && number.size() <= 10;
  const std::uint64_t value = is_number ? std::stoull(number) : 0;
  if (value == 0 || value > 0xffffffffu) fail(node.child("upperBound"), path(node) + " must have an <upperBound> that is a whole number from 1 to 4294967295");
  return static_cast<std::uint32_t>(value);
}

DimensionSet FomReader::dimensions_of(const Node& node) const {
  DimensionSet set;
  for (const Node& dimension : node.child("dimensions").children("dimension")) {
    const std::string name = dimension.text().get();
    const auto handle = fom_.dimension(name);
    if (!handle) fail(dimension, path(node) + " has the unknown dimension '" + name + "'; allowed are those in <dimensions>");
    set.insert(*handle);
  }
  return set;
}

Transportation FomReader::transportation(const Node& node) const {
  const std::string name = text_or(node, "transportation", "HLAreliable");
  if (name == "HLAreliable") return Transportation::reliable;
  if (name == "HLAbestEffort") return Transportation::best_effort;
  fail(node.child("transportation"), path(node) + " has transportation '" + name + "'; allowed are HLAreliable, HLAbestEffort");
}

Order FomReader::order(const Node& node) const {
  const std::string name = text_or(node, "order", "Receive");
  if (name == "Receive") return Order::receive;
  if (name == "TimeStamp") return Order::timestamp;
  fail(node.child("order"), path(node) + " has order '" + name + "'; allowed are Receive, TimeStamp");
}

void FomReader::read_object_class(const Node& node, ObjectClassHandle parent) {
  ObjectClass object_class;
  object_class.name = text(node, "name");
  object_class.parent = parent;
  if (parent) object_class.attributes = fom_.at(parent).attributes;
  for (const ObjectClass& other : fom_.object_classes_)
    if (other.parent == parent && other.name == object_class.name) fail(node, path(node) + " is declared twice");
  for (const Node& attribute : node.children("attribute")) {
    if (text(attribute, "name") == "HLAprivilegeToDeleteObject") continue;  // every object has it
    object_class.attributes.push_back(read_attribute(attribute, object_class));
    if (object_class.attributes.size() > named_attribute_max) fail(attribute, path(node) + " has more than " + std::to_string(named_attribute_max) + " attributes");
  }
  const ObjectClassHandle handle{static_cast<std::uint32_t>(fom_.object_classes_.size())};
  if (handle.value == class_max) fail(node, "more than " + std::to_string(class_max) + " object classes");
  fom_.object_classes_.push_back(std::move(object_class));
  for (const Node& child : node.children("objectClass")) read_object_class(child, handle);
}

Attribute FomReader::read_attribute(const Node& node, const ObjectClass& owner) {
  Attribute attribute;
  attribute.name = text(node, "name");
  for (const Attribute& other : owner.attributes)
    if (other.name == attribute.name) fail(node, path(node) + " is declared twice in class '" + owner.name + "' or what it inherits");
  attribute.data_type = text(node, "dataType");
  attribute.size = size_of(attribute.data_type, node);
  attribute.transportation = transportation(node);
  attribute.order = order(node);
  attribute.dimensions = dimensions_of(node);
  const bool is_first = std::ranges::none_of(owner.attributes, [](const Attribute& other) { return other.baselines != nullptr; });
  quantise(attribute, is_first && text_or(node, "updateType", "NA") == "Periodic");
  return attribute;
}

/// State that is told periodically travels as differences to baselines, unless some of it is not quantised.
void FomReader::quantise(Attribute& attribute, bool is_periodic) {
  if (!attribute.size) return;
  try {
    const auto known = codecs_.find(attribute.data_type);
    const auto size_of_type = [this](const std::string& type) { return size_of(type, {}).value_or(0); };
    const auto codec = known != codecs_.end() ? known->second : QuantisationReader::codec_of(attribute.data_type, declared_types_, size_of_type);
    codecs_[attribute.data_type] = codec;
    attribute.codec = codec;
    if (codec && is_periodic && codec->is_all_quantised()) attribute.baselines = codec;
  } catch (const QuantisationError& error) {
    fail(error.node, error.what);
  }
}

void FomReader::read_interaction_class(const Node& node, InteractionClassHandle parent) {
  InteractionClass interaction_class;
  interaction_class.name = text(node, "name");
  interaction_class.parent = parent;
  if (parent) interaction_class.parameters = fom_.at(parent).parameters;
  for (const InteractionClass& other : fom_.interaction_classes_)
    if (other.parent == parent && other.name == interaction_class.name) fail(node, path(node) + " is declared twice");
  interaction_class.transportation = transportation(node);
  interaction_class.order = order(node);
  interaction_class.dimensions = dimensions_of(node);
  for (const Node& parameter : node.children("parameter")) {
    interaction_class.parameters.push_back(read_parameter(parameter, interaction_class));
    if (interaction_class.parameters.size() > parameter_max) fail(parameter, path(node) + " has more than " + std::to_string(parameter_max) + " parameters");
  }
  const InteractionClassHandle handle{static_cast<std::uint32_t>(fom_.interaction_classes_.size())};
  if (handle.value == class_max) fail(node, "more than " + std::to_string(class_max) + " interaction classes");
  fom_.interaction_classes_.push_back(std::move(interaction_class));
  for (const Node& child : node.children("interactionClass")) read_interaction_class(child, handle);
}

Parameter FomReader::read_parameter(const Node& node, const InteractionClass& owner) {
  Parameter parameter;
  parameter.name = text(node, "name");
  for (const Parameter& other : owner.parameters)
    if (other.name == parameter.name) fail(node, path(node) + " is declared twice in class '" + owner.name + "' or what it inherits");
  parameter.data_type = text(node, "dataType");
  parameter.size = size_of(parameter.data_type, node);
  return parameter;
}

std::uint64_t FomReader::hash() const {
  std::uint64_t value = 14695981039346656037ull;
  const auto mix = [&](const std::string& word) {
    for (const char letter : word + "\n") value = (value ^ static_cast<unsigned char>(letter)) * 1099511628211ull;
  };
  const auto mix_number = [&](std::uint64_t number) { mix(std::to_string(number)); };
  const auto mix_member = [&](const auto& member) {
    mix(member.name), mix(member.data_type), mix_number(member.size.value_or(0xffffffffu));
  };
  for (const ObjectClass& each : fom_.object_classes_) {
    mix("object " + each.name), mix_number(each.parent.value);
    for (const Attribute& attribute : each.attributes) {
      mix_member(attribute);
      mix_number(static_cast<std::uint64_t>(attribute.transportation)), mix_number(static_cast<std::uint64_t>(attribute.order)), mix_number(attribute.dimensions.bits);
    }
  }
  for (const InteractionClass& each : fom_.interaction_classes_) {
    mix("interaction " + each.name), mix_number(each.parent.value);
    mix_number(static_cast<std::uint64_t>(each.transportation)), mix_number(static_cast<std::uint64_t>(each.order)), mix_number(each.dimensions.bits);
    for (const Parameter& parameter : each.parameters) mix_member(parameter);
  }
  for (const Dimension& dimension : fom_.dimensions_) mix("dimension " + dimension.name), mix_number(dimension.upper_bound.value_or(0));
  for (const auto& [type, codec] : codecs_)
    if (codec) mix("codec " + type + " " + codec->name());
  for (const ObjectClass& each : fom_.object_classes_)
    for (const Attribute& attribute : each.attributes)
      if (attribute.baselines) mix("baselines " + each.name + " " + attribute.name);
  return value;
}

Fom Fom::parse(std::string_view xml, const std::string& source) { return FomReader(xml, source).read(); }

Fom Fom::load(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) throw FileError(path + ": can't be read; expected an OMT XML file");
  return parse(text.str(), path);
}

}  // namespace rink::rti
