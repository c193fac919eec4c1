// Reads lists and ranges.
#include "rti/fom/enumerations.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

namespace rink::rti {

namespace {

using XmlNode = pugi::xml_node;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// One word without blanks, brackets or commas.
bool is_word(std::string_view text) {
  return !text.empty() && text.find_first_of(" \t\r\n[],") == std::string_view::npos;
}

std::optional<std::int64_t> whole_number(std::string_view text) {
  const bool is_hexadecimal = text.starts_with("0x") || text.starts_with("0X");
  if (is_hexadecimal) text.remove_prefix(2);
  else if (text.starts_with('+')) text.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, is_hexadecimal ? 16 : 10);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  return is_whole ? std::optional(value) : std::nullopt;
}

struct Values {
  std::int64_t first, last;
};

Values values_of(const FomModules& modules, const XmlNode& node, const ListEntry& entry,
                 std::uint32_t size) {
  const auto first = whole_number(entry.first), last = whole_number(entry.last);
  if (!first || !last || *first > *last)
    modules.fail(node, "<value> of " + FomModules::path(node.parent()) + " holds '" +
                           node.text().get() +
                           "'; allowed are whole numbers, lists of such, and ranges [1..4]");
  const unsigned bits = 8 * size;
  if (bits < 63 && (*first < -(std::int64_t{1} << (bits - 1)) || *last >> bits > 0))
    modules.fail(node, "<value> of " + FomModules::path(node.parent()) + " does not fit the " +
                           std::to_string(size) + " bytes of its representation");
  return {*first, *last};
}

}  // namespace

std::vector<ListEntry> entries_of(const FomModules& modules, const XmlNode& node,
                                  std::string_view list) {
  const auto refuse = [&] {
    modules.fail(node, FomModules::path(node) + " holds the list '" + std::string(list) +
                           "'; expected names or ranges [first..last] with commas between");
  };
  std::vector<ListEntry> entries;
  for (std::string_view left = trimmed(list);;) {
    const bool is_range = left.starts_with('[');
    const std::size_t end = is_range ? left.find(']') : left.find(',');
    if (is_range && end == std::string_view::npos) refuse();
    std::string_view part = left.substr(is_range ? 1 : 0, is_range ? end - 1 : end);
    left = end == std::string_view::npos ? std::string_view()
                                         : trimmed(left.substr(is_range ? end + 1 : end));
    const std::size_t dots = is_range ? part.find("..") : std::string_view::npos;
    const std::string_view first = trimmed(part.substr(0, dots)),
                           last = dots == std::string_view::npos ? first
                                                                 : trimmed(part.substr(dots + 2));
    if (!is_word(first) || !is_word(last)) refuse();
    entries.push_back({std::string(first), std::string(last)});
    if (left.empty()) return entries;
    if (!left.starts_with(',')) refuse();
    left = trimmed(left.substr(1));
  }
}

void check_enumerators(FomModules& modules, const XmlNode& enumeration,
                       std::optional<std::uint32_t> size) {
  if (!size || *size == 0)
    modules.fail(enumeration, FomModules::path(enumeration) +
                                  " has a representation without a size; allowed are numbers, "
                                  "such as HLAinteger32BE");
  std::set<std::string> names;
  std::map<std::int64_t, XmlNode> taken;
  for (const XmlNode& enumerator : enumeration.children("enumerator")) {
    if (!names.insert(modules.text(enumerator, "name")).second)
      modules.fail(enumerator, FomModules::path(enumerator) + " of " +
                                   FomModules::path(enumeration) + " is declared twice");
    for (const XmlNode& value : enumerator.children("value"))
      for (const ListEntry& entry : entries_of(modules, value, value.text().get())) {
        const Values values = values_of(modules, value, entry, *size);
        // The first value of a range stands for it: a range may hold all that a word has.
        const auto [other, is_new] = taken.emplace(values.first, enumerator);
        if (!is_new && other->second != enumerator)
          modules.warn(enumerator, FomModules::path(enumerator) + " of " +
                                       FomModules::path(enumeration) + " has the value of " +
                                       FomModules::path(other->second));
      }
  }
}

void check_alternatives(const FomModules& modules, const XmlNode& variant,
                        const std::vector<std::string>& enumerators) {
  std::set<std::string> named;
  const auto place_of = [&](const XmlNode& node, const std::string& name) {
    const auto found = std::ranges::find(enumerators, name);
    if (found == enumerators.end())
      modules.fail(node, FomModules::path(node) + " of " + FomModules::path(variant) +
                             " names the unknown enumerator '" + name + "'");
    return found;
  };
  for (const XmlNode& alternative : variant.children("alternative")) {
    const XmlNode list = alternative.child("enumerator");
    if (!list) modules.fail(alternative, FomModules::path(alternative) + " lacks <enumerator>");
    const auto add = [&](const std::string& name) {
      if (!named.insert(name).second)
        modules.fail(alternative, FomModules::path(alternative) + " of " +
                                      FomModules::path(variant) + " names '" + name +
                                      "', which another alternative has");
    };
    const std::vector<ListEntry> entries = entries_of(modules, alternative, list.text().get());
    for (const ListEntry& entry : entries) {
      if (entry.first == "HLAother" && entries.size() == 1) {
        add(entry.first);
        continue;
      }
      const auto first = place_of(alternative, entry.first),
                 last = place_of(alternative, entry.last);
      if (first > last)
        modules.fail(alternative, FomModules::path(alternative) + " has the range [" + entry.first +
                                      ".." + entry.last + "], whose ends are the wrong way round");
      std::for_each(first, last + 1, add);
    }
  }
}

}  // namespace rink::rti
