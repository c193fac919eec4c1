// The table of keys; each parameter is a key.
#include "loadgen/experiment/cell_key.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "loadgen/experiment/csv_number.h"
#include "loadgen/experiment/csv_text.h"
#include "loadgen/experiment/parameter.h"

namespace rink::loadgen {
namespace {

template <class Number>
bool set_number(Number& into, const std::string& value) {
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), into);
  return error == std::errc() && end == value.data() + value.size();
}

}  // namespace

const std::vector<CellKey>& cell_keys() {
  static const std::vector<CellKey> keys = [] {
    std::vector<CellKey> all{
        {"mode", [](Cell& cell, const std::string& value) { return cell.mode = value, true; }},
        {"scheme", [](Cell& cell, const std::string& value) { return cell.scheme = value, true; }},
        {"policy", [](Cell& cell, const std::string& value) { return cell.policy = value, true; }},
        {"clients",
         [](Cell& cell, const std::string& value) { return set_number(cell.clients, value); }},
        {"pucks",
         [](Cell& cell, const std::string& value) { return set_number(cell.pucks, value); }},
        {"bats", [](Cell& cell, const std::string& value) { return set_number(cell.bats, value); }},
        {"server_cores",
         [](Cell& cell, const std::string& value) { return set_number(cell.server_cores, value); }},
        {"part", [](Cell& cell, const std::string& value) { return cell.part = value, true; }}};
    for (const ParameterKind& kind : parameter_kinds())
      all.push_back({kind.key, [kind](Cell& cell, const std::string& value) {
                       double number = 0.0;
                       if (!set_number(number, value) || !kind.is_allowed(number) ||
                           (kind.is_whole && number != std::floor(number)))
                         return false;
                       kind.set(cell.parameters, number);
                       return true;
                     }});
    return all;
  }();
  return keys;
}

const CellKey* key_called(const std::string& name) {
  const auto key = std::find_if(cell_keys().begin(), cell_keys().end(),
                                [&name](const CellKey& k) { return name == k.name; });
  return key == cell_keys().end() ? nullptr : &*key;
}

std::string cell_csv(const Cell& cell) {
  std::string csv;
  for (const std::string& text : {cell.part, cell.mode, cell.scheme, cell.policy})
    csv += csv_text(text) + ",";
  for (const std::uint32_t count : {cell.clients, cell.pucks, cell.bats, cell.server_cores})
    csv += std::to_string(count) + ",";
  for (const ParameterKind& kind : parameter_kinds())
    csv += csv_number(kind.of(cell.parameters)) + ",";
  csv.pop_back();
  return csv;
}

std::string cell_csv_heading() {
  std::string csv = "part,mode,scheme,policy,clients,pucks,bats,server_cores";
  for (const ParameterKind& kind : parameter_kinds()) csv += std::string(",") + kind.key;
  return csv;
}

}  // namespace rink::loadgen
