// Declares, sizes and checks data types.
#include "rti/fom/data_types.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <sstream>

#include "rti/fom/enumerations.h"
#include "rti/fom/standard_types.h"

namespace rink::rti {

namespace {

constexpr std::uint32_t count_size = 4;  ///< of the HLAinteger32BE that begins an HLAvariableArray

/// The first multiple of `boundary` that is not before `at`.
std::uint64_t at_boundary(std::uint64_t at, std::uint32_t boundary) {
  assert(boundary > 0);
  return (at + boundary - 1) / boundary * boundary;
}

/// The first word of <encoding>; a model may describe one of its own in several.
std::string encoding_of(const pugi::xml_node& node, const char* otherwise) {
  std::istringstream text(node.child("encoding").text().get());
  std::string name;
  return text >> name ? name : otherwise;
}

}  // namespace

void DataTypes::declare(const Node& node) {
  const std::string name = text(node, "name");
  const auto [known, is_new] = declared_.emplace(name, node);
  if (!is_new && known->second.root() == node.root())
    fail(node, "data type '" + name + "' is declared twice");
  if (standard_type(name)) return;  // models copy these with words of their own
  if (!is_new) modules_.require_same(known->second, node, "");
  modules_.require_unreserved({name, {known->second, node}});
}

void DataTypes::read() {
  for (const Node& section : modules_.sections("dataTypes"))
    for (const Node& group : section.children()) {
      const std::string_view name = group.name();
      if (name != "basicDataRepresentations" && name != "simpleDataTypes" &&
          name != "enumeratedDataTypes" && name != "arrayDataTypes" &&
          name != "fixedRecordDataTypes" && name != "variantRecordDataTypes")
        fail(group,
             "<dataTypes> holds <" + std::string(name) +
                 ">; allowed are basicDataRepresentations, simpleDataTypes, enumeratedDataTypes, "
                 "arrayDataTypes, fixedRecordDataTypes, variantRecordDataTypes");
      for (const Node& node : group.children()) declare(node);
    }
}

void DataTypes::check() {
  for (const auto& [name, node] : declared_) {
    const Size size = size_of(name, node);
    const auto standard = standard_type(name);
    if (standard && size != standard->size)
      fail(node,
           path(node) + " is the standard's, whose size " +
               (standard->size ? "is " + std::to_string(8 * *standard->size) + " bits" : "varies"));
    if (std::string_view(node.name()) == "variantRecordData") check_variants(node);
    if (std::string_view(node.name()) == "enumeratedData") check_enumerators(modules_, node, size);
  }
}

void DataTypes::check_variants(const Node& node) {
  const std::string discriminant = text(node, "dataType");
  const std::vector<std::string> enumerators = enumerators_of(discriminant);
  if (enumerators.empty())
    fail(node.child("dataType"),
         path(node) + " must have an enumerated data type as its discriminant, not '" +
             discriminant + "'");
  check_alternatives(modules_, node, enumerators);
  for (const Node& alternative : node.children("alternative"))
    if (modules_.text_or(alternative, "dataType", "NA") != "NA")
      size_of(text(alternative, "dataType"), alternative);
}

/// In their order; none if the type is no enumeration.
std::vector<std::string> DataTypes::enumerators_of(const std::string& type) const {
  const auto found = declared_.find(type);
  std::vector<std::string> names;
  if (found == declared_.end())
    return type == "HLAboolean" ? std::vector<std::string>{"HLAfalse", "HLAtrue"} : names;
  for (const Node& enumerator : found->second.children("enumerator"))
    names.push_back(text(enumerator, "name"));
  return names;
}

DataTypes::Size DataTypes::size_of(const std::string& type, const Node& user) {
  if (const auto known = sizes_.find(type); known != sizes_.end()) return known->second;
  const auto declared = declared_.find(type);
  if (declared == declared_.end()) {
    if (const auto standard = standard_type(type)) return standard->size;
    fail(user, path(user) + " has the unknown data type '" + type +
                   "'; allowed are those in <dataTypes> and the standard's, such as HLAfloat32LE");
  }
  if (!being_sized_.insert(type).second)
    fail(declared->second, "data type '" + type + "' contains itself");
  constexpr std::size_t depth_max = 64;
  if (being_sized_.size() > depth_max)
    fail(declared->second,
         "data type '" + type + "' is within more than " + std::to_string(depth_max) + " others");
  const Node node = declared->second;
  const std::string_view kind = node.name();
  Size size;
  if (kind == "basicData") {
    const int bits = node.child("size").text().as_int();
    if (bits < 8 || bits > 1 << 20 || bits % 8 != 0)
      fail(node,
           path(node) + " must have a <size> in bits that is a multiple of 8, at most 1048576");
    size = static_cast<std::uint32_t>(bits / 8);
  } else if (kind == "simpleData" || kind == "enumeratedData") {
    size = size_of(text(node, "representation"), node);
  } else if (kind == "arrayData") {
    size = size_of_array(node);
  } else if (kind == "fixedRecordData") {
    size = size_of_record(node);
  } else if (kind != "variantRecordData") {  // whose size varies
    fail(node, "<dataTypes> holds " + path(node) +
                   "; allowed are basicData, simpleData, enumeratedData, arrayData, "
                   "fixedRecordData, variantRecordData");
  }
  being_sized_.erase(type);
  sizes_[type] = size;
  return size;
}

/// The number of elements, that of each dimension multiplied; nothing if one is a range or Dynamic.
std::optional<std::uint64_t> DataTypes::cardinality_of(const Node& node) const {
  const Node list = node.child("cardinality");
  if (!list) fail(node, path(node) + " lacks <cardinality>");
  std::optional<std::uint64_t> product = 1;
  for (const ListEntry& each : entries_of(modules_, node, list.text().get())) {
    if (each.first == "Dynamic" && each.last == each.first) {
      product.reset();
      continue;
    }
    for (const std::string& bound : {each.first, each.last})
      if (bound.find_first_not_of("0123456789") != std::string::npos)
        fail(node, path(node) + " must have a <cardinality> of counts, [ranges] or Dynamic");
    const bool is_count = each.first == each.last;
    if (is_count && each.first.size() > 6)
      fail(node, path(node) + " has more than 999999 elements");
    if (!is_count || !product) product.reset();
    else product = std::min<std::uint64_t>(*product * std::stoull(each.first), 1u << 20);
  }
  return product;
}

/// As the standard lays arrays out: each element begins at a multiple of its octet boundary value,
/// after the number of elements if the encoding has one; nothing lies behind the last. In an
/// encoding of the model's own the elements stand side by side.
DataTypes::Size DataTypes::size_of_array(const Node& node) {
  const std::optional<std::uint64_t> cardinality = cardinality_of(node);
  const Size element = size_of(text(node, "dataType"), node);
  if (!cardinality || !element) return std::nullopt;
  const std::uint64_t count = *cardinality;
  const std::string encoding = encoding_of(node, "HLAfixedArray");
  const bool is_counted = encoding == "HLAvariableArray";
  const std::uint32_t boundary =
      is_counted || encoding == "HLAfixedArray" ? boundary_of(text(node, "dataType"), node) : 1;
  std::uint64_t size = is_counted ? count_size : 0;
  if (count > 0)
    size = at_boundary(size, boundary) + (count - 1) * at_boundary(*element, boundary) + *element;
  if (size > 1u << 20) fail(node, path(node) + " is longer than 1 MiB");
  return static_cast<std::uint32_t>(size);
}

DataTypes::Size DataTypes::size_of_record(const Node& node) {
  std::uint64_t size = 0;
  bool is_fixed = true;
  for (const Node& field : node.children("field")) {
    const Size part = size_of(text(field, "dataType"), field);
    is_fixed = is_fixed && part;
    size += part.value_or(0);
  }
  if (!is_fixed) return std::nullopt;
  for (const std::uint32_t padding : padding_of(node)) size += padding;
  if (size > 1u << 20) fail(node, path(node) + " is longer than 1 MiB");
  return static_cast<std::uint32_t>(size);
}

std::vector<std::uint32_t> DataTypes::padding_of(const Node& record) {
  const bool is_aligned = encoding_of(record, "HLAfixedRecord") == "HLAfixedRecord";
  std::vector<std::uint32_t> paddings;
  std::uint64_t at = 0;
  for (const Node& field : record.children("field")) {
    const std::string type = text(field, "dataType");
    const std::uint64_t begin = is_aligned ? at_boundary(at, boundary_of(type, field)) : at;
    paddings.push_back(static_cast<std::uint32_t>(begin - at));
    at = begin + size_of(type, field).value();
  }
  return paddings;
}

/// The octet boundary value of IEEE 1516.2-2010, 4.13, of a type of fixed size: of a basic type the
/// least power of two that is not below its size, of records and arrays the greatest of what they
/// hold.
std::uint32_t DataTypes::boundary_of(const std::string& type, const Node& user) {
  const auto found = declared_.find(type);
  const Node node = found == declared_.end() ? Node() : found->second;
  const std::string_view kind = node.name();
  if (kind == "simpleData" || kind == "enumeratedData")
    return boundary_of(text(node, "representation"), node);
  if (kind == "arrayData") {
    const std::uint32_t element = boundary_of(text(node, "dataType"), node);
    return encoding_of(node, "HLAfixedArray") == "HLAvariableArray" ? std::max(count_size, element)
                                                                    : element;
  }
  if (kind != "fixedRecordData") return std::bit_ceil(size_of(type, user).value());
  std::uint32_t greatest = 1;
  for (const Node& field : node.children("field"))
    greatest = std::max(greatest, boundary_of(text(field, "dataType"), field));
  assert(std::has_single_bit(greatest));
  return greatest;
}

}  // namespace rink::rti
