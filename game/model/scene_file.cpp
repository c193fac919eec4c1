// Reads the tables of a scene file in the order in which docs/scenes.md describes them.
#include "game/model/scene_file.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "game/model/listed.h"
#include "game/model/scene_table.h"

namespace rink::game {
namespace {

using physics::BodyKind;
using physics::MaterialId;

constexpr std::uint64_t body_max = 10'000'000;

class SceneReader {
 public:
  SceneReader(const toml::table& root, const std::string& file)
      : file_(file), root_(root, file, "the scene") {}

  Scene read() {
    root_.text("name", scene_.name);
    root_.whole("seed", scene_.seed, 0, std::numeric_limits<std::int64_t>::max());
    root_.truth("allow_overlap", scene_.world.allow_overlap);
    root_.number("network_grid", scene_.network_grid, limit::ticks);
    read_materials();
    read_field();
    read_drag();
    read_friction();
    read_match();
    for (SceneTable& table : root_.tables("post")) read_post(table);
    for (SceneTable& table : root_.tables("bat")) read_bat(table);
    for (SceneTable& table : root_.tables("puck")) read_puck(table);
    for (SceneTable& table : root_.tables("population")) read_population(table);
    std::vector<SceneTable> keys = root_.tables("key");
    root_.finish();
    populate_by_line();
    for (SceneTable& table : keys) read_key(table);
    std::stable_sort(scene_.keys.begin(), scene_.keys.end(),
                     [](const InputEvent& a, const InputEvent& b) { return a.time < b.time; });
    assert(lines_.size() == scene_.placed.posts.size() + scene_.placed.bats.size() +
                                scene_.placed.pucks.size() + scene_.populations.size() &&
           "each body and each population has a name and a line of its own");
    return std::move(scene_);
  }

 private:
  void read_materials() {
    std::optional<SceneTable> table = root_.table("materials");
    if (!table) return;
    double everywhere = 1.0, friction = 0.0, tangential = 0.0;
    table->texts("names", scene_.materials);
    if (scene_.materials.size() > 256) table->refuse("names", "at most 256 names");
    for (std::size_t i = 0; i < scene_.materials.size(); ++i)
      if (std::count(scene_.materials.begin(), scene_.materials.end(), scene_.materials[i]) > 1)
        table->refuse("names", "each name once");
    table->number("restitution", everywhere, part_of_one);
    table->number("friction", friction, limit::friction);
    table->number("tangential_restitution", tangential, part_of_one);
    const std::size_t count = scene_.materials.size();
    scene_.world.restitution = physics::RestitutionTable(count, everywhere);
    physics::SurfaceFriction surfaces{physics::PairTable(count, friction),
                                      physics::RestitutionTable(count, tangential)};
    bool is_rough = friction > 0.0;
    for (SceneTable& pair : table->tables("pair")) is_rough = read_pair(pair, surfaces) || is_rough;
    table->finish();
    if (is_rough) scene_.world.surface_friction = surfaces;
  }

  /// Whether the pair has friction.
  bool read_pair(SceneTable& pair, physics::SurfaceFriction& surfaces) {
    std::vector<std::string> between;
    double number = 1.0;
    if (!pair.texts("between", between))
      pair.refuse_all("lacks the key between: expected two materials");
    if (between.size() != 2) pair.refuse("between", "two materials");
    const MaterialId a = material_named(pair, "between", between[0]),
                     b = material_named(pair, "between", between[1]);
    const bool has_restitution = pair.number("restitution", number, part_of_one);
    if (has_restitution) scene_.world.restitution.set(a, b, number);
    const bool has_tangential = pair.number("tangential_restitution", number, part_of_one);
    if (has_tangential) surfaces.tangential_restitution.set(a, b, number);
    const bool has_friction = pair.number("friction", number, limit::friction);
    if (has_friction) surfaces.coefficient.set(a, b, number);
    if (!has_restitution && !has_tangential && !has_friction)
      pair.refuse_all(
          "has no value for the pair: expected restitution, friction or tangential_restitution");
    pair.finish();
    return has_friction && number > 0.0;
  }

  MaterialId material_named(const SceneTable& table, const char* key,
                            const std::string& name) const {
    const auto place = std::find(scene_.materials.begin(), scene_.materials.end(), name);
    if (place == scene_.materials.end())
      table.refuse(key, "materials out of " + listed(scene_.materials));
    return static_cast<MaterialId>(place - scene_.materials.begin());
  }

  void read_material(SceneTable& table, const char* key, MaterialId& material) const {
    std::string name;
    if (table.text(key, name)) material = material_named(table, key, name);
  }

  void read_field() {
    std::optional<SceneTable> table = root_.table("field");
    if (!table)
      throw SceneError(file_ + ":1: the scene lacks the table [field] with its length and width");
    physics::Field& field = scene_.world.field;
    table->require_number("length", field.length, limit::field);
    table->require_number("width", field.width, limit::field);
    table->number("goal_width", field.goal_width, {0.0, field.width});
    table->truth("bats_keep_to_half", field.bats_keep_to_half);
    read_material(*table, "material", field.wall);
    table->finish();
  }

  void read_drag() {
    std::optional<SceneTable> table = root_.table("drag");
    if (!table) return;
    table->number("pucks", scene_.world.puck_drag, limit::drag);
    table->number("bats", scene_.world.bat_drag, limit::drag);
    table->finish();
  }

  void read_friction() {
    std::optional<SceneTable> table = root_.table("friction");
    if (!table) return;
    table->number("pucks", scene_.world.puck_friction, limit::thrust);
    if (table->has("bats"))
      table->refuse("bats", "pucks only: thrust and Coulomb friction together have no closed form");
    table->finish();
  }

  void read_match() {
    std::optional<SceneTable> table = root_.table("match");
    if (!table) return;
    std::uint64_t goals = 0;
    if (table->whole("goals_to_win", goals, 1, 1'000'000))
      scene_.rules.goals_to_win = static_cast<std::uint32_t>(goals);
    table->number("face_off_delay", scene_.rules.face_off_delay, limit::delay);
    table->number("possession_s", scene_.rules.possession_s,
                  {MatchRules::possession_min, limit::time_max});
    // A puck is served to the other half, whose spot must be in it.
    const double farthest = scene_.rules.possession_s > 0.0 ? 0.49 : 1.0;
    table->number("face_off_distance", scene_.rules.face_off_distance, {0.0, farthest, true});
    table->finish();
  }

  /// Every body has a name of its own, for errors and scripted keys.
  std::string read_name(SceneTable& table, const char* kind, std::size_t number) {
    std::string name = std::string(kind) + "-" + std::to_string(number);
    table.text("name", name);
    if (!lines_.emplace(name, table.line()).second)
      table.refuse_all("the name " + name + " is taken: expected each name once");
    return name;
  }

  void read_post(SceneTable& table) {
    Post post{read_name(table, "post", scene_.placed.posts.size()), {}};
    table.require_vector("position", post.body.position, limit::position);
    table.require_number("radius", post.body.radius, {0.0, limit::field_max});
    read_material(table, "material", post.body.material);
    table.finish();
    scene_.placed.posts.push_back(post);
  }

  void read_bat(SceneTable& table) {
    Bat bat;
    bat.name = read_name(table, "bat", scene_.placed.bats.size());
    table.require_vector("position", bat.body.position, limit::position);
    table.vector("velocity", bat.body.velocity, limit::velocity);
    table.require_vector("half_extent", bat.body.half_extent, limit::size);
    table.number("mass", bat.body.mass, limit::mass);
    table.number("thrust", bat.thrust, limit::thrust);
    read_material(table, "material", bat.body.material);
    bat.team = bat.body.position.x() < scene_.world.field.length / 2 ? Team::left : Team::right;
    table.choice<Team>("team", bat.team,
                       {{"left", Team::left}, {"right", Team::right}, {"none", Team::none}});
    if (scene_.world.field.bats_keep_to_half && bat.team != Team::none)
      bat.body.half = bat.team == Team::left ? physics::Half::left : physics::Half::right;
    table.finish();
    scene_.placed.bats.push_back(bat);
  }

  void read_puck(SceneTable& table) {
    Puck puck{read_name(table, "puck", scene_.placed.pucks.size()), {}};
    table.require_vector("position", puck.body.position, limit::position);
    table.vector("velocity", puck.body.velocity, limit::velocity);
    table.number("radius", puck.body.radius, limit::size);
    table.number("mass", puck.body.mass, limit::mass);
    read_material(table, "material", puck.body.material);
    if (table.number("spin", puck.body.spin, limit::spin) && !scene_.world.surface_friction)
      table.refuse("spin", "friction above 0 in [materials], for without it no impact feels spin");
    table.finish();
    scene_.placed.pucks.push_back(puck);
  }

  void read_population(SceneTable& table) {
    Population population;
    std::string kind;
    table.require_text("kind", kind);
    table.choice<BodyKind>(
        "kind", population.kind,
        {{"puck", BodyKind::puck}, {"bat", BodyKind::bat}, {"post", BodyKind::post}});
    population.name = read_name(table, (kind + "s").c_str(), scene_.populations.size());
    read_count(table, population);
    if (population.kind != BodyKind::bat)
      table.span("radius", population.radius_min, population.radius_max,
                 population.kind == BodyKind::puck ? limit::size : Range{0.0, limit::field_max});
    if (population.kind != BodyKind::post) table.number("mass", population.mass, limit::mass);
    if (population.kind == BodyKind::puck) read_speeds(table, population);
    if (population.kind == BodyKind::bat) read_bats(table, population);
    read_material(table, "material", population.material);
    table.finish();
    scene_.populations.push_back(population);
  }

  void read_count(SceneTable& table, Population& population) {
    std::uint64_t count = 0;
    double density = 0.0;
    const bool has_count = table.whole("count", count, 0, body_max),
               has_density = table.number("density", density, from_zero);
    if (has_count == has_density)
      table.refuse_all("expected either count or density (bodies per square metre)");
    const double by_density =
        std::round(density * scene_.world.field.length * scene_.world.field.width);
    if (by_density > static_cast<double>(body_max))
      table.refuse("density", "at most " + std::to_string(body_max) + " bodies in all");
    assert(count <= body_max && by_density >= 0.0);
    population.count =
        has_count ? static_cast<std::uint32_t>(count) : static_cast<std::uint32_t>(by_density);
  }

  void read_speeds(SceneTable& table, Population& population) {
    table.number("mean_speed", population.mean_speed, limit::speed);
    table.choice<SpeedDistribution>("speeds", population.speeds,
                                    {{"fixed", SpeedDistribution::fixed},
                                     {"uniform", SpeedDistribution::uniform},
                                     {"maxwell", SpeedDistribution::maxwell}});
  }

  void read_bats(SceneTable& table, Population& population) {
    table.vector("half_extent", population.half_extent, limit::size);
    table.number("thrust", population.thrust, limit::thrust);
    Team team = Team::none;
    if (table.choice<Team>("team", team,
                           {{"left", Team::left}, {"right", Team::right}, {"none", Team::none}}))
      population.team = team;
  }

  void populate_by_line() {
    try {
      populate(scene_);
    } catch (const PlacementError& error) {
      throw SceneError(file_ + ":" + std::to_string(lines_.at(error.body)) + ": " + error.what());
    }
  }

  void read_key(SceneTable& table) {
    InputEvent event;
    std::string bat;
    table.require_number("time", event.time, limit::time);
    table.require_text("bat", bat);
    const std::vector<Bat>& bats = scene_.bodies.bats;
    const auto place = std::find_if(bats.begin(), bats.end(),
                                    [&](const Bat& candidate) { return candidate.name == bat; });
    if (place == bats.end()) table.refuse("bat", "the name of a bat");
    event.player = static_cast<std::uint32_t>(place - bats.begin());
    assert(event.player < bats.size());
    std::string key;
    bool is_down = true;
    table.require_text("key", key);
    table.choice<Key>(
        "key", event.key,
        {{"left", Key::left}, {"right", Key::right}, {"up", Key::up}, {"down", Key::down}});
    if (!table.truth("is_down", is_down))
      table.refuse_all("lacks the key is_down: expected true or false");
    event.kind = is_down ? InputKind::key_down : InputKind::key_up;
    table.finish();
    scene_.keys.push_back(event);
  }

  const std::string file_;
  SceneTable root_;
  Scene scene_;
  std::map<std::string, std::size_t> lines_;  ///< where each body or population stands
};

std::filesystem::path preset_folder() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return self.parent_path().parent_path() / "share" / "rink" / "scenes";
}

std::filesystem::path file_of(const std::string& scene) {
  if (scene.ends_with(".toml") || scene.find('/') != std::string::npos) return scene;
  const std::filesystem::path preset = preset_folder() / (scene + ".toml");
  if (std::filesystem::is_regular_file(preset)) return preset;
  const std::string known = listed(preset_names());
  throw SceneError(scene + ": no such scene: expected a file NAME.toml or one of the presets " +
                   (known.empty() ? "(none found in " + preset_folder().string() + ")" : known));
}

/// Throws SceneError at a line of more dots than any key of a scene: toml++ opens a table for each
/// and frees them by recursion, which a long enough key makes overflow.
void refuse_deep_keys(std::string_view text, const std::string& file) {
  constexpr std::ptrdiff_t dots_max = 1000;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::string_view here = text.substr(0, text.find('\n'));
    if (std::count(here.begin(), here.end(), '.') > dots_max)
      throw SceneError(file + ":" + std::to_string(line) +
                       ": not TOML of a scene: more than 1000 dots in a line");
    text.remove_prefix(std::min(text.size(), here.size() + 1));
  }
}

}  // namespace

Scene parse_scene(std::string_view text, const std::filesystem::path& file) {
  refuse_deep_keys(text, file.string());
  toml::table root;
  try {
    root = toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw SceneError(file.string() + ":" + std::to_string(error.source().begin.line) +
                     ": not TOML: " + std::string(error.description()));
  }
  Scene scene = SceneReader(root, file.string()).read();
  if (scene.name.empty()) scene.name = file.stem().string();
  return scene;
}

std::string scene_text(const std::string& scene) {
  const std::filesystem::path file = file_of(scene);
  std::ifstream stream(file);
  std::ostringstream text;
  const bool is_empty = stream.peek() == std::ifstream::traits_type::eof() && !stream.bad();
  if (std::filesystem::is_directory(file) || !stream.is_open() ||
      !(is_empty || text << stream.rdbuf()))
    throw SceneError(file.string() + ": cannot be read: expected a scene file (TOML)");
  return text.str();
}

Scene load_scene(const std::string& scene) {
  return parse_scene(scene_text(scene), file_of(scene));
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(preset_folder(), error))
    if (entry.is_regular_file() && entry.path().extension() == ".toml")
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  assert(std::ranges::adjacent_find(names) == names.end() && "a folder has each file once");
  return names;
}

}  // namespace rink::game
