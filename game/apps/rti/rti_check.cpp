// Reads the files one by one, then together.
#include "game/apps/rti/rti_check.h"

#include <cstdint>
#include <cstdio>

#include "game/apps/command.h"
#include "im/basics/hexadecimal.h"
#include "rti/fom/fom.h"
#include "rti/fom/fom_lookup.h"
#include "rti/fom/module_summary.h"

namespace rink::game {
namespace {

void print_whole(const rti::Fom& fom) {
  const rti::FomLookup names(fom);
  rti::ObjectClassHandle widest;
  std::size_t own_objects = 0, own_interactions = 0, most = 0;
  for (std::uint32_t i = 0; i < fom.object_classes().size(); ++i) {
    if (fom.is_management(rti::ObjectClassHandle{i})) continue;
    ++own_objects;
    const std::size_t count = fom.attributes({i}).count();
    if (widest && count <= most) continue;
    widest = {i}, most = count;
  }
  for (std::uint32_t i = 0; i < fom.interaction_classes().size(); ++i)
    own_interactions += fom.is_management(rti::InteractionClassHandle{i}) ? 0u : 1u;
  std::printf("together: %zu object classes, %zu interaction classes, %zu dimensions; hash %s\n",
              own_objects, own_interactions, fom.dimensions().size(),
              hexadecimal(fom.hash()).c_str());
  if (widest)
    std::printf("the widest class, %s, has %zu attributes\n",
                names.get_object_class_name(widest).c_str(), most);
}

}  // namespace

bool check_model(const std::vector<std::string>& files) {
  std::vector<rti::FomModule> modules;
  bool is_sound = true;
  for (const std::string& file : files) try {
      modules.push_back(rti::read_fom_module(file));
      const rti::ModuleSummary summary = rti::summarize(modules.back());
      std::printf("%s: %s\n", file.c_str(), summary.text().c_str());
    } catch (const rti::FileError& error) {
      complain(error.what());
      is_sound = false;
    }
  if (!is_sound) return false;
  try {
    const rti::Fom fom = rti::Fom::parse(modules);
    print_whole(fom);
    for (const std::string& warning : fom.warnings()) warn(warning);
  } catch (const rti::FileError& error) {
    complain(error.what());
    return false;
  }
  return true;
}

}  // namespace rink::game
