// Reads IEEE 1516.2 OMT XML modules into one model; every error names file, line and element.
#include <algorithm>
#include <array>
#include <map>
#include <pugixml.hpp>

#include "im/basics/fnv_hash.h"
#include "rti/fom/data_types.h"
#include "rti/fom/fom.h"
#include "rti/fom/fom_modules.h"
#include "rti/fom/management_classes.h"
#include "rti/fom/quantisation_reader.h"

namespace rink::rti {

namespace {

constexpr std::size_t class_max = 4096, parameter_max = 64;

}  // namespace

/// One reading of one or several modules.
class FomReader {
 public:
  explicit FomReader(std::span<const FomModule> modules) : modules_(modules) {}
  Fom read();

 private:
  using Node = pugi::xml_node;
  using Group = FomModules::Group;

  [[noreturn]] void fail(const Node& node, const std::string& what) const {
    modules_.fail(node, what);
  }
  static std::string path(const Node& node) { return FomModules::path(node); }
  std::string text(const Node& node, const char* child) const { return modules_.text(node, child); }
  std::string text_or(const Node& node, const char* child, const char* otherwise) const {
    return modules_.text_or(node, child, otherwise);
  }

  void read_dimensions();
  void read_object_class(const Group& group, ObjectClassHandle parent);
  void require_same_members(const Node& first, const Node& second, const char* element) const;
  Attribute read_attribute(const Node& node, const ObjectClass& owner);
  void read_interaction_class(const Group& group, InteractionClassHandle parent);
  void quantise(Attribute& attribute, bool is_periodic);
  template <class Member>
  Member read_member(const Node& node, const std::vector<Member>& others, const std::string& owner);
  template <class Member>
  void add_member(std::vector<Member>& members, Member member, const Node& node,
                  const Node& owner) const;
  template <class Handle, class Class>
  Handle add_class(std::vector<Class>& classes, Class read, const Node& node,
                   const char* kind) const;
  void read_transportations();
  void warn_of_absent();
  std::vector<Group> members_of(const Group& group, const char* element) const;
  Node transport_of(const Group& group) const;
  Transportation transportation(const Node& node) const;
  Order order(const Node& node) const;
  DimensionSet dimensions_of(const Node& node) const;
  std::optional<std::uint32_t> upper_bound(const Node& node) const;
  std::uint64_t hash() const;

  FomModules modules_;
  DataTypes types_{modules_};
  std::map<std::string, std::shared_ptr<const QuantisedCodec>> codecs_;
  std::map<std::string, Transportation> transportations_;
  Fom fom_;
};

Fom FomReader::read() {
  for (const Node& model : modules_.models())
    if (fom_.name_.empty())
      fom_.name_ = model.child("modelIdentification").child("name").text().get();
  types_.read();
  read_dimensions();
  read_transportations();
  const std::vector<Node> objects = modules_.sections("objects"),
                          interactions = modules_.sections("interactions");
  for (const Group& group : modules_.groups(objects, "objectClass")) read_object_class(group, {});
  for (const Group& group : modules_.groups(interactions, "interactionClass"))
    read_interaction_class(group, {});
  types_.check();
  fom_.switches_ = read_switches(modules_);
  warn_of_absent();
  fom_.warnings_ = modules_.warnings();
  fom_.hash_ = hash();
  fom_.own_object_classes_ = fom_.object_classes_.size();
  fom_.own_interaction_classes_ = fom_.interaction_classes_.size();
  const bool brings_its_own =
      std::ranges::any_of(fom_.object_classes_, [](const ObjectClass& each) {
        return each.name == "HLAmanager";
      });  // a module of the standard's
  if (!brings_its_own) append_management_classes(fom_.object_classes_, fom_.interaction_classes_);
  for (ObjectClass& each : fom_.object_classes_)
    for (std::uint32_t i = 0; i < each.attributes.size(); ++i)
      if (i != privilege_to_delete_object.value) each.all.insert({i});
  fom_.check();
  return std::move(fom_);
}

void FomReader::read_dimensions() {
  for (const Group& group : modules_.groups(modules_.sections("dimensions"), "dimension")) {
    const Node& node = group.nodes.front();
    modules_.require_unreserved(group);
    for (const Node& other : group.nodes) modules_.require_same(node, other, "");
    if (fom_.dimensions_.size() == dimension_max)
      fail(node, "more than " + std::to_string(dimension_max) + " dimensions");
    fom_.dimensions_.push_back({group.name, upper_bound(node)});
  }
}

/// A model's own type of transportation is one of the standard's two: that which is as reliable.
void FomReader::read_transportations() {
  transportations_ = {{"HLAreliable", Transportation::reliable},
                      {"HLAbestEffort", Transportation::best_effort}};
  for (const Group& group :
       modules_.groups(modules_.sections("transportations"), "transportation")) {
    const Node& node = group.nodes.front();
    if (transportations_.contains(group.name)) continue;
    modules_.require_unreserved(group);
    for (const Node& other : group.nodes) modules_.require_same(node, other, "");
    const std::string reliable = text(node, "reliable");
    if (reliable != "Yes" && reliable != "No")
      fail(node.child("reliable"),
           path(node) + " has <reliable> '" + reliable + "'; allowed are Yes, No");
    transportations_[group.name] =
        reliable == "Yes" ? Transportation::reliable : Transportation::best_effort;
  }
}

/// Tables that ask for what this RTI does not do.
void FomReader::warn_of_absent() {
  for (const Node& rates : modules_.sections("updateRates"))
    if (rates.child("updateRate"))
      modules_.warn(rates,
                    "<updateRates>: updates reach each subscriber at the rate at which they "
                    "are made");
  for (const Node& time : modules_.sections("time"))
    for (const char* kind : {"timeStamp", "lookahead"}) {
      const Node node = time.child(kind);
      if (modules_.text_or(node, "dataType", "NA") == "HLAinteger64Time")
        modules_.warn(node, std::string("<") + kind +
                                "> is HLAinteger64Time: logical time is an "
                                "HLAfloat64Time here");
    }
}

std::optional<std::uint32_t> FomReader::upper_bound(const Node& node) const {
  if (!node.child("upperBound")) return std::nullopt;
  const std::string number = text(node, "upperBound");
  const bool is_number =
      number.find_first_not_of("0123456789") == std::string::npos && number.size() <= 10;
  const std::uint64_t value = is_number ? std::stoull(number) : 0;
  if (value == 0 || value > 0xffffffffu)
    fail(node.child("upperBound"),
         path(node) + " must have an <upperBound> that is a whole number from 1 to 4294967295");
  return static_cast<std::uint32_t>(value);
}

DimensionSet FomReader::dimensions_of(const Node& node) const {
  DimensionSet set;
  for (const Node& dimension : node.child("dimensions").children("dimension")) {
    const std::string name = dimension.text().get();
    const auto handle = fom_.dimension(name);
    if (!handle)
      fail(dimension, path(node) + " has the unknown dimension '" + name +
                          "'; allowed are those in <dimensions>");
    set.insert(*handle);
  }
  return set;
}

Transportation FomReader::transportation(const Node& node) const {
  const std::string name = text_or(node, "transportation", "HLAreliable");
  if (const auto found = transportations_.find(name); found != transportations_.end())
    return found->second;
  fail(node.child("transportation"), path(node) + " has transportation '" + name +
                                         "'; allowed are HLAreliable, HLAbestEffort and those in "
                                         "<transportations>");
}

Order FomReader::order(const Node& node) const {
  const std::string name = text_or(node, "order", "Receive");
  if (name == "Receive") return Order::receive;
  if (name == "TimeStamp") return Order::timestamp;
  fail(node.child("order"),
       path(node) + " has order '" + name + "'; allowed are Receive, TimeStamp");
}

/// Members of a class that two modules define in full must be the same, in whatever order; the
/// first module's order counts.
void FomReader::require_same_members(const Node& first, const Node& second,
                                     const char* element) const {
  const std::array both{first, second};
  const std::string of = " of class '" + text(first, "name") + "'";
  for (const Group& group : modules_.groups(both, element)) {
    const Node& node = group.nodes.front();
    if (group.nodes.size() == 2) modules_.require_same(node, group.nodes.back(), of);
    else if (node.parent() == second)
      modules_.conflict(node, path(node) + of + " is missing in the definition", first);
    else modules_.conflict(second, path(node) + of + " is missing here; it is defined", node);
  }
}

/// The attributes or parameters of one class, as the first module that has some defines them, and
/// those that later modules of IEEE 1516.2-2025 add. Other modules name the class without any, as a
/// scaffold, or repeat them.
std::vector<FomReader::Group> FomReader::members_of(const Group& group, const char* element) const {
  std::vector<Node> definitions;
  Node first;
  for (const Node& node : group.nodes) {
    if (!node.child(element)) continue;
    const bool is_repeated = first && !modules_.may_extend(node);
    if (is_repeated) require_same_members(first, node, element);
    else definitions.push_back(node);
    if (!first && !modules_.may_extend(node)) first = node;
  }
  const std::string of = " of class '" + group.name + "'";
  std::vector<Group> members =
      modules_.groups(definitions, element, " in class '" + group.name + "' or what it inherits");
  for (const Group& member : members)
    for (const Node& node : member.nodes) modules_.require_same(member.nodes.front(), node, of);
  return members;
}

/// The module's part that says how interactions of a class travel; modules that say so must agree.
FomReader::Node FomReader::transport_of(const Group& group) const {
  Node definition;
  for (const Node& node : group.nodes) {
    if (!node.child("parameter") && !node.child("transportation") && !node.child("order") &&
        !node.child("dimensions"))
      continue;  // a scaffold
    if (definition && !modules_.may_extend(node))
      for (const char* element : {"transportation", "order", "dimensions"})
        modules_.require_same_child(definition, node, element);
    if (!definition) definition = node;
  }
  return definition ? definition : group.nodes.front();
}

void FomReader::read_object_class(const Group& group, ObjectClassHandle parent) {
  const Node& front = group.nodes.front();
  if (parent || group.name != "HLAobjectRoot") modules_.require_unreserved(group);
  ObjectClass object_class;
  object_class.name = group.name;
  object_class.parent = parent;
  if (parent) object_class.attributes = fom_.at(parent).attributes;
  for (const Group& attribute : members_of(group, "attribute")) {
    const Node& node = attribute.nodes.front();
    modules_.require_unreserved(attribute);
    add_member(object_class.attributes, read_attribute(node, object_class), node, front);
  }
  const auto handle = add_class<ObjectClassHandle>(fom_.object_classes_, std::move(object_class),
                                                   front, "object classes");
  for (const Group& child : modules_.groups(group.nodes, "objectClass"))
    read_object_class(child, handle);
}

Attribute FomReader::read_attribute(const Node& node, const ObjectClass& owner) {
  Attribute attribute = read_member(node, owner.attributes, owner.name);
  attribute.transportation = transportation(node);
  attribute.order = order(node);
  attribute.dimensions = dimensions_of(node);
  const bool is_first = std::ranges::none_of(
      owner.attributes, [](const Attribute& other) { return other.baselines != nullptr; });
  attribute.is_static = text_or(node, "updateType", "NA") == "Static";
  quantise(attribute, is_first && text_or(node, "updateType", "NA") == "Periodic");
  return attribute;
}

/// Periodic state travels as differences to baselines, unless some of it is not quantised.
void FomReader::quantise(Attribute& attribute, bool is_periodic) {
  if (!attribute.size) return;
  const auto known = codecs_.find(attribute.data_type);
  const auto codec = known != codecs_.end()
                         ? known->second
                         : quantised_codec_of(attribute.data_type, types_, modules_);
  codecs_[attribute.data_type] = codec;
  attribute.codec = codec;
  if (codec && is_periodic && codec->is_all_quantised()) attribute.baselines = codec;
}

void FomReader::read_interaction_class(const Group& group, InteractionClassHandle parent) {
  const Node& front = group.nodes.front();
  if (parent || group.name != "HLAinteractionRoot") modules_.require_unreserved(group);
  InteractionClass interaction_class;
  interaction_class.name = group.name;
  interaction_class.parent = parent;
  if (parent) interaction_class.parameters = fom_.at(parent).parameters;
  if (parent) {  // the standard says how interactions of the root travel, and nobody sends any
    const Node definition = transport_of(group);
    interaction_class.transportation = transportation(definition);
    interaction_class.order = order(definition);
    interaction_class.dimensions = dimensions_of(definition);
  }
  for (const Group& parameter : members_of(group, "parameter")) {
    const Node& node = parameter.nodes.front();
    modules_.require_unreserved(parameter);
    add_member(interaction_class.parameters,
               read_member(node, interaction_class.parameters, group.name), node, front);
  }
  const auto handle = add_class<InteractionClassHandle>(
      fom_.interaction_classes_, std::move(interaction_class), front, "interaction classes");
  for (const Group& child : modules_.groups(group.nodes, "interactionClass"))
    read_interaction_class(child, handle);
}

/// What attributes and parameters have in common; `others` are the members of class `owner` so far,
/// inherited ones included.
template <class Member>
Member FomReader::read_member(const Node& node, const std::vector<Member>& others,
                              const std::string& owner) {
  Member member;
  member.name = text(node, "name");
  for (const Member& other : others)
    if (other.name == member.name)
      fail(node, path(node) + " is declared twice in class '" + owner + "' or what it inherits");
  member.data_type = modules_.text_or(node, "dataType", "NA");
  if (member.data_type == "NA") member.data_type.clear();  // octets that only federates understand
  else member.size = types_.size_of(member.data_type, node);
  return member;
}

template <class Member>
void FomReader::add_member(std::vector<Member>& members, Member member, const Node& node,
                           const Node& owner) const {
  constexpr bool is_attribute = std::is_same_v<Member, Attribute>;
  constexpr std::size_t most = is_attribute ? named_attribute_max : parameter_max;
  if constexpr (is_attribute) add_attribute(members, std::move(member));
  else members.push_back(std::move(member));
  if (members.size() > (is_attribute ? attribute_max : parameter_max))
    fail(node, path(owner) + " has more than " + std::to_string(most) +
                   (is_attribute ? " attributes" : " parameters"));
}

template <class Handle, class Class>
Handle FomReader::add_class(std::vector<Class>& classes, Class read, const Node& node,
                            const char* kind) const {
  const Handle handle{static_cast<std::uint32_t>(classes.size())};
  if (handle.value == class_max) fail(node, "more than " + std::to_string(class_max) + " " + kind);
  classes.push_back(std::move(read));
  return handle;
}

std::uint64_t FomReader::hash() const {
  Fnv64 hash;
  const auto mix = [&](const std::string& word) { hash.add(word + "\n"); };
  const auto mix_number = [&](std::uint64_t number) { mix(std::to_string(number)); };
  const auto mix_member = [&](const auto& member) {
    mix(member.name), mix(member.data_type), mix_number(member.size.value_or(0xffffffffu));
  };
  for (const ObjectClass& each : fom_.object_classes_) {
    mix("object " + each.name), mix_number(each.parent.value);
    for (const Attribute& attribute : each.attributes) {
      mix_member(attribute);
      mix_number(static_cast<std::uint64_t>(attribute.transportation)),
          mix_number(static_cast<std::uint64_t>(attribute.order)),
          mix_number(attribute.dimensions.bits);
    }
  }
  for (const InteractionClass& each : fom_.interaction_classes_) {
    mix("interaction " + each.name), mix_number(each.parent.value);
    mix_number(static_cast<std::uint64_t>(each.transportation)),
        mix_number(static_cast<std::uint64_t>(each.order)), mix_number(each.dimensions.bits);
    for (const Parameter& parameter : each.parameters) mix_member(parameter);
  }
  for (const Dimension& dimension : fom_.dimensions_)
    mix("dimension " + dimension.name), mix_number(dimension.upper_bound.value_or(0));
  for (const auto& [type, codec] : codecs_)
    if (codec) mix("codec " + type + " " + codec->name());
  for (const ObjectClass& each : fom_.object_classes_)
    for (const Attribute& attribute : each.attributes)
      if (attribute.baselines) mix("baselines " + each.name + " " + attribute.name);
  if (const std::string switches = fom_.switches_.text(); !switches.empty())
    mix("switches " + switches);
  return hash.value();
}

Fom Fom::parse(std::span<const FomModule> modules) {
  if (modules.empty())
    throw FileError("a federation object model needs at least one module",
                    HlaError::could_not_open_fdd);
  return FomReader(modules).read();
}

}  // namespace rink::rti
