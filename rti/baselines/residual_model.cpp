// Finds the attributes that residuals need, and walks through sets of them.
#include "rti/baselines/residual_model.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace rink::rti {

namespace {

/// The first attribute of `data_type` and fixed size.
std::optional<std::uint32_t> attribute_of_type(const ObjectClass& object_class,
                                               std::string_view data_type) {
  const auto found = std::ranges::find_if(object_class.attributes, [&](const Attribute& each) {
    return each.data_type == data_type && each.size;
  });
  if (found == object_class.attributes.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - object_class.attributes.begin());
}

}  // namespace

ResidualModel::ResidualModel(const Fom& fom) : fom_(fom) {
  for (const ObjectClass& object_class : fom.object_classes()) {
    Class& of = classes_.emplace_back();
    of.attributes.resize(object_class.attributes.size());
    for (std::uint32_t k = 0; k < object_class.attributes.size(); ++k) {
      const Attribute& attribute = object_class.attributes[k];
      if (!attribute.codec || !attribute.codec->has_residuals() || !attribute.size) continue;
      // A datagram may be lost, and what follows it would refer to nothing.
      if (attribute.transportation == Transportation::best_effort) continue;
      const std::string_view needed = attribute.codec->context_type();
      const auto context = needed.empty() ? std::nullopt : attribute_of_type(object_class, needed);
      if (!needed.empty() && !context) continue;
      of.attributes[k].context = context;
      of.residual.insert({k});
      of.kept.insert({k});
      if (context) of.kept.insert({*context});
    }
    of.kept.for_each([&](AttributeHandle each) {
      of.attributes[each.value].offset = of.size;
      of.attributes[each.value].size = *object_class.attributes[each.value].size;
      of.size += of.attributes[each.value].size;
    });
  }
}

void ResidualModel::keep(std::uint16_t object_class, AttributeSet set, Bytes values,
                         FormerValues& former) const {
  const Class& of = classes_[object_class];
  if ((set & of.kept).is_empty()) return;
  former.bytes.resize(of.size);
  set.for_each([&](AttributeHandle each) {
    const Attribute& attribute = fom_.object_classes()[object_class].attributes[each.value];
    const std::size_t size = plain_size(attribute, values).value_or(0);
    assert(size <= values.size());
    if (of.kept.contains(each)) {
      assert(size == of.attributes[each.value].size);
      std::memcpy(former.bytes.data() + of.attributes[each.value].offset, values.data(), size);
      former.held.insert(each);
    }
    values = values.subspan(size);
  });
}

std::optional<ResidualBasis> ResidualModel::basis(const Class& of, std::uint32_t attribute,
                                                  const FormerValues& former) {
  const Kept& kept = of.attributes[attribute];
  if (!former.held.contains({attribute})) return std::nullopt;
  if (kept.context && !former.held.contains({*kept.context})) return std::nullopt;
  const auto value = [&](const Kept& each) {
    return Bytes(former.bytes).subspan(each.offset, each.size);
  };
  return ResidualBasis{value(kept), kept.context ? value(of.attributes[*kept.context]) : Bytes()};
}

std::optional<ResidualChange> ResidualModel::change(const Class& of, std::uint32_t attribute,
                                                    const FormerChange* companion) {
  if (companion == nullptr || !companion->attributes.contains({attribute})) return std::nullopt;
  const std::optional<ResidualBasis> known = basis(of, attribute, companion->before);
  if (!known) return std::nullopt;
  const Kept& kept = of.attributes[attribute];
  return ResidualChange{known->former, known->context,
                        Bytes(companion->after).subspan(kept.offset, kept.size)};
}

bool ResidualModel::append(std::uint16_t object_class, AttributeSet set, const FormerValues& former,
                           std::vector<std::byte>& values) const {
  const Class& of = classes_[object_class];
  if (!former.held.includes(set)) return false;
  for (const AttributeHandle each : set) {
    const Kept& kept = of.attributes[each.value];
    const Bytes value = Bytes(former.bytes).subspan(kept.offset, kept.size);
    values.insert(values.end(), value.begin(), value.end());
  }
  return true;
}

std::optional<std::uint64_t> ResidualModel::companion_key(std::uint16_t object_class,
                                                          AttributeSet set, Bytes values) const {
  const Class& of = classes_[object_class];
  assert(of.residual.includes(set));
  for (const AttributeHandle handle : set) {
    const std::uint32_t each = handle.value;
    const std::uint32_t size = of.attributes[each].size;
    if (const auto key = codec(object_class, each).companion_key(values.first(size))) return key;
    values = values.subspan(size);
  }
  return std::nullopt;
}

bool ResidualModel::encode(const ResidualUpdate& update, Bytes values, const FormerValues& former,
                           BitWriter& bits) const {
  const Class& of = classes_[update.object_class];
  assert(of.residual.includes(update.attributes));
  for (const AttributeHandle handle : update.attributes) {
    const std::uint32_t each = handle.value;
    const std::uint32_t size = of.attributes[each].size;
    std::optional<ResidualBasis> known = basis(of, each, former);
    const std::optional<ResidualChange> other = change(of, each, update.companion);
    if (known && other) known->companion = &*other;
    if (!known || !codec(update.object_class, each)
                       .encode_residual(*known, values.first(size), update.time, bits))
      return false;
    values = values.subspan(size);
  }
  return true;
}

bool ResidualModel::decode(const ResidualUpdate& update, FormerValues& former, BitReader& bits,
                           std::vector<std::byte>& values) const {
  const Class& of = classes_[update.object_class];
  if (!of.residual.includes(update.attributes)) return false;
  for (const AttributeHandle handle : update.attributes) {
    const std::uint32_t each = handle.value;
    std::optional<ResidualBasis> known = basis(of, each, former);
    const std::optional<ResidualChange> other = change(of, each, update.companion);
    if (known && other) known->companion = &*other;
    const std::size_t before = values.size();
    if (!known ||
        !codec(update.object_class, each).decode_residual(*known, update.time, bits, values) ||
        values.size() - before != of.attributes[each].size)
      return false;
    std::memcpy(former.bytes.data() + of.attributes[each].offset, values.data() + before,
                of.attributes[each].size);
  }
  return true;
}

}  // namespace rink::rti
