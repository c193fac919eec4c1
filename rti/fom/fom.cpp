// Look-ups in a federation object model, and the hash by which two ends compare theirs.
#include "rti/fom/fom.h"

#include <algorithm>
#include <cassert>

#include "im/basics/fnv_hash.h"
#include "rti/fom/attribute_codec.h"
#include "rti/fom/quantised_codec.h"
#include "rti/wire/stream.h"

namespace rink::rti {

namespace {

template <class Class>
std::string qualified_name(const std::vector<Class>& classes, std::size_t index) {
  std::string name = classes[index].name;
  for (auto parent = classes[index].parent; parent; parent = classes[parent.value].parent)
    name = classes[parent.value].name + "." + name;
  return name;
}

/// The index of the one class that is called so, alone or qualified.
template <class Class>
std::optional<std::uint32_t> find_class(const std::vector<Class>& classes, std::string_view name) {
  const bool is_qualified = name.find('.') != std::string_view::npos;
  std::optional<std::uint32_t> found;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (is_qualified ? qualified_name(classes, i) != name : classes[i].name != name) continue;
    if (found) return std::nullopt;
    found = static_cast<std::uint32_t>(i);
  }
  return found;
}

template <class Named>
std::optional<std::uint32_t> find_named(const std::vector<Named>& members, std::string_view name) {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const Named& member) { return member.name == name; });
  if (found == members.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - members.begin());
}

template <class Class, class Tag>
bool inherits(const std::vector<Class>& classes, Handle<Tag> handle, Handle<Tag> ancestor) {
  assert(!handle || handle.value < classes.size());
  while (handle && handle != ancestor) handle = classes[handle.value].parent;
  return handle == ancestor;
}

/// Of every class, that its parent is before it and what it inherits comes first.
template <class Class, class Members>
void check_inheritance(const std::vector<Class>& classes, Members members) {
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (!classes[i].parent) continue;
    assert(classes[i].parent.value < i);
    [[maybe_unused]] const auto& own = classes[i].*members;
    const auto& inherited = classes[classes[i].parent.value].*members;
    assert(inherited.size() <= own.size());
    for (std::size_t k = 0; k < inherited.size(); ++k) assert(inherited[k].name == own[k].name);
  }
}

}  // namespace

void Fom::check() const {
  check_inheritance(object_classes_, &ObjectClass::attributes);
  check_inheritance(interaction_classes_, &InteractionClass::parameters);
  assert(own_object_classes_ <= object_classes_.size());
  assert(own_interaction_classes_ <= interaction_classes_.size());
  assert(dimensions_.size() <= DimensionSet::capacity);
  for (const ObjectClass& each : object_classes_) {
    assert(each.attributes.size() <= attribute_max);
    assert(each.all == AttributeSet((AttributeBits{1} << each.attributes.size()) - 1)
                           .without(AttributeSet{privilege_to_delete_object}));
    assert(each.attributes.size() <= privilege_to_delete_object.value ||
           each.attributes[privilege_to_delete_object.value].size == 0u);
    for ([[maybe_unused]] const Attribute& attribute : each.attributes)
      assert(attribute.baselines == nullptr || attribute.codec != nullptr);
  }
}

void add_attribute(std::vector<Attribute>& attributes, Attribute attribute) {
  if (attributes.size() == privilege_to_delete_object.value) {
    Attribute& privilege = attributes.emplace_back();
    privilege.name = "HLAprivilegeToDeleteObject";
    privilege.size = 0;
  }
  attributes.push_back(std::move(attribute));
}

std::optional<std::size_t> plain_size(const Attribute& attribute, Bytes values) {
  if (attribute.size)
    return *attribute.size <= values.size() ? std::optional<std::size_t>(*attribute.size)
                                            : std::nullopt;
  std::uint32_t length = 0;
  Reader reader(values);
  if (!reader.number(length) || length > reader.left()) return std::nullopt;
  return sizeof length + length;
}

void Fom::use_codec(std::string_view data_type,
                    const std::shared_ptr<const AttributeCodec>& codec) {
  assert(codec != nullptr);
  bool is_used = false;
  for (ObjectClass& object_class : object_classes_)
    for (Attribute& attribute : object_class.attributes)
      if (attribute.data_type == data_type)
        attribute.codec = codec, attribute.baselines = nullptr, is_used = true;
  if (!is_used)
    throw FileError("object model '" + name_ + "': no attribute is of type '" +
                    std::string(data_type) + "'");
  Fnv64 hash(hash_);
  hash.add("codec " + std::string(data_type) + " " + codec->name() + "\n");
  hash_ = hash.value();
}

std::optional<ObjectClassHandle> Fom::object_class(std::string_view name) const {
  const auto index = find_class(object_classes_, name);
  return index ? std::optional(ObjectClassHandle{*index}) : std::nullopt;
}

std::optional<AttributeHandle> Fom::attribute(ObjectClassHandle object_class,
                                              std::string_view name) const {
  if (name == "HLAprivilegeToDeleteObject") return privilege_to_delete_object;
  const auto index = find_named(at(object_class).attributes, name);
  return index ? std::optional(AttributeHandle{*index}) : std::nullopt;
}

std::optional<InteractionClassHandle> Fom::interaction_class(std::string_view name) const {
  const auto index = find_class(interaction_classes_, name);
  return index ? std::optional(InteractionClassHandle{*index}) : std::nullopt;
}

std::optional<ParameterHandle> Fom::parameter(InteractionClassHandle interaction_class,
                                              std::string_view name) const {
  const auto index = find_named(at(interaction_class).parameters, name);
  return index ? std::optional(ParameterHandle{*index}) : std::nullopt;
}

std::optional<DimensionHandle> Fom::dimension(std::string_view name) const {
  const auto index = find_named(dimensions_, name);
  return index ? std::optional(DimensionHandle{*index}) : std::nullopt;
}

bool Fom::is_for_rti(InteractionClassHandle handle) const {
  if (!is_management(handle) || !at(handle).parent) return false;
  const std::string& parent = at(at(handle).parent).name;
  return parent == "HLAadjust" || parent == "HLArequest";
}

std::optional<AttributeHandle> Fom::periodic_attribute(ObjectClassHandle handle) const {
  const std::vector<Attribute>& attributes = at(handle).attributes;
  for (std::uint32_t i = 0; i < attributes.size(); ++i)
    if (attributes[i].baselines) return AttributeHandle{i};
  return std::nullopt;
}

AttributeSet Fom::attributes(ObjectClassHandle handle) const { return at(handle).all; }

bool Fom::is_a(ObjectClassHandle handle, ObjectClassHandle ancestor) const {
  return inherits(object_classes_, handle, ancestor);
}
bool Fom::is_a(InteractionClassHandle handle, InteractionClassHandle ancestor) const {
  return inherits(interaction_classes_, handle, ancestor);
}

std::optional<std::uint32_t> Fom::values_size(ObjectClassHandle handle, AttributeSet set) const {
  std::uint32_t size = 0;
  for (const AttributeHandle each : set) {
    const Attribute& attribute = at(handle).attributes[each.value];
    if (!attribute.size) return std::nullopt;
    size += *attribute.size;
  }
  return size;
}

bool Fom::values_fit(ObjectClassHandle handle, AttributeSet set, Bytes values) const {
  if (!attributes(handle).includes(set)) return false;
  const ObjectClass& object_class = at(handle);
  const bool is_whole = set.all_of([&](AttributeHandle each) {
    const auto size = plain_size(object_class.attributes[each.value], values);
    if (size) values = values.subspan(*size);
    return size.has_value();
  });
  return is_whole && values.empty();
}

Bytes Fom::value(ObjectClassHandle handle, AttributeSet set, AttributeHandle attribute,
                 Bytes values) const {
  for (const AttributeHandle each : set) {
    const std::size_t size = plain_size(at(handle).attributes[each.value], values).value_or(0);
    if (each == attribute) return values.first(size);
    values = values.subspan(size);
  }
  return {};
}

Fom Fom::parse(std::string_view xml, const std::string& source) {
  const FomModule module{std::string(xml), source};
  return parse(std::span(&module, 1));
}

Fom Fom::load(const std::string& path) { return load(std::span(&path, 1)); }

Fom Fom::load(std::span<const std::string> paths) {
  std::vector<FomModule> modules;
  for (const std::string& path : paths) modules.push_back(read_fom_module(path));
  return parse(modules);
}

}  // namespace rink::rti
