// Reads ranges and rates from notes, and lays records flat.
#include "rti/fom/quantisation_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace rink::rti {

namespace {

using Node = pugi::xml_node;
using Form = QuantisedField::Form;

struct Representation {
  const char* name;
  Form form;
  std::uint32_t size;
  bool is_big_endian;
};
constexpr std::array representations = {
    Representation{"HLAfloat32LE", Form::float32, 4, false},
    Representation{"HLAfloat32BE", Form::float32, 4, true},
    Representation{"HLAfloat64LE", Form::float64, 8, false},
    Representation{"HLAfloat64BE", Form::float64, 8, true},
    Representation{"HLAinteger16LE", Form::integer16, 2, false},
    Representation{"HLAinteger16BE", Form::integer16, 2, true},
    Representation{"HLAinteger32LE", Form::integer32, 4, false},
    Representation{"HLAinteger32BE", Form::integer32, 4, true},
};

std::string named(const Node& node) {
  return std::string("<")
      .append(node.name())
      .append("> '")
      .append(node.child("name").text().get())
      .append("'");
}

/// The rest of the note of `node` that begins with `words`; nothing if it has none.
std::optional<std::string> note(const Node& node, const std::string& words) {
  std::istringstream labels(node.attribute("notes").value());
  const Node model =
      node.root().find_child([](const Node& each) { return each.type() == pugi::node_element; });
  for (std::string label; labels >> label;)
    for (const Node& each : model.child("notes").children("note")) {
      if (each.child("label").text().get() != label) continue;
      std::istringstream text(each.child("semantics").text().get());
      std::string words_read;
      for (std::string word; text >> word;) words_read += (words_read.empty() ? "" : " ") + word;
      if (words_read.starts_with(words + " ")) return words_read.substr(words.size() + 1);
    }
  return std::nullopt;
}

/// True if `form` holds each value of the grid exactly.
bool holds(Form form, const Quantisation& grid) {
  constexpr double float_multiple_max = 1 << 24;
  const auto is_within = [&](double low, double high) {
    return grid.step >= 1.0 && grid.low() >= low && grid.high() <= high;
  };
  switch (form) {
    case Form::float32:
      return std::max(std::abs(grid.low()), std::abs(grid.high())) / grid.step <=
             float_multiple_max;
    case Form::float64:
      return true;
    case Form::integer16:
      return is_within(std::numeric_limits<std::int16_t>::min(),
                       std::numeric_limits<std::int16_t>::max());
    case Form::integer32:
      return is_within(std::numeric_limits<std::int32_t>::min(),
                       std::numeric_limits<std::int32_t>::max());
    case Form::octets:
      break;
  }
  return false;
}

QuantisedField ranged_field(const Node& node, const FomModules& modules) {
  QuantisedField field;
  const std::string_view representation = node.child("representation").text().get();
  for (const Representation& each : representations)
    if (representation == each.name)
      field = {.form = each.form, .is_big_endian = each.is_big_endian, .size = each.size};
  const std::string range = *note(node, "range");
  std::istringstream bounds(range), resolution(node.child("resolution").text().get());
  double low = 0.0, high = 0.0, step = 0.0;
  std::string rest;
  if (!(bounds >> low >> high) || bounds >> rest)
    modules.fail(node, named(node) + " has a note 'range " + range +
                           "'; expected 'range LOW HIGH', two numbers");
  if (!(resolution >> step) || resolution >> rest || !(step > 0.0))
    modules.fail(node, named(node) + " has a range, so its <resolution> must be a number above 0");
  if (field.form == Form::octets)
    modules.fail(node, named(node) +
                           " has a range, so its <representation> must be HLAfloat32, "
                           "HLAfloat64, HLAinteger16 or HLAinteger32, LE or BE");
  field.grid = Quantisation::of(low, high, 0.5 * step);
  if (!field.grid || !holds(field.form, *field.grid))
    modules.fail(node,
                 named(node) + " has a range and resolution that its representation cannot hold");
  return field;
}

class Flattening {
 public:
  Flattening(DataTypes& types, const FomModules& modules) : types_(types), modules_(modules) {}

  /// Appends the fields of `type`, whose size is known and which thus does not contain itself, the
  /// first of them behind `padding` bytes.
  void add(const std::string& type, std::uint32_t padding, const std::string& name) {
    const auto found = types_.declared().find(type);
    const std::string_view kind = found == types_.declared().end() ? "" : found->second.name();
    if (kind == "fixedRecordData") return add_record(found->second, padding, name);
    if (kind == "simpleData" && note(found->second, "range"))
      fields.push_back(ranged_field(found->second, modules_));
    else fields.push_back({.size = types_.size_of(type, {}).value_or(0)});
    fields.back().padding = padding;
    fields.back().name = name;
  }

  std::vector<QuantisedField> fields;

 private:
  void add_record(const Node& record, std::uint32_t outer_padding, const std::string& outer) {
    std::map<std::string, std::size_t> places;
    auto padding = types_.padding_of(record);
    if (!padding.empty()) padding.front() += outer_padding;
    auto before = padding.begin();
    for (const Node& field : record.children("field")) {
      const std::string name = field.child("name").text().get();
      places[name] = fields.size();
      add(field.child("dataType").text().get(), *before++,
          outer.empty() ? name : std::string(outer).append(".").append(name));
    }
    for (const Node& field : record.children("field")) {
      const std::optional<std::string> rated = note(field, "rate of");
      if (!rated) continue;
      const auto of = places.find(*rated);
      const std::size_t self = places[field.child("name").text().get()];
      if (of == places.end() || of->second == self || !fields[self].grid ||
          !fields[of->second].grid)
        modules_.fail(field, named(field) + " is the rate of '" + *rated +
                                 "'; both must be fields of " + named(record) +
                                 " with a range and a resolution");
      fields[self].rate_of = static_cast<std::uint32_t>(of->second);
    }
  }

  DataTypes& types_;
  const FomModules& modules_;
};

}  // namespace

std::shared_ptr<const QuantisedCodec> quantised_codec_of(const std::string& data_type,
                                                         DataTypes& types,
                                                         const FomModules& modules) {
  Flattening flat(types, modules);
  flat.add(data_type, 0, {});
  const auto has_grid = [](const QuantisedField& field) { return field.grid.has_value(); };
  if (flat.fields.size() > QuantisedCodec::field_max || std::ranges::none_of(flat.fields, has_grid))
    return nullptr;
  return std::make_shared<QuantisedCodec>(std::move(flat.fields));
}

}  // namespace rink::rti
