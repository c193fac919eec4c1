// Which peers were found when this was built; RINK_HAS_CHIPMUNK and RINK_HAS_BOX2D come from
// bench/peers/CMakeLists.txt.
#include "bench/peers/peers.h"

#include <algorithm>

#ifdef RINK_HAS_CHIPMUNK
#include "bench/peers/chipmunk_world.h"
#endif
#ifdef RINK_HAS_BOX2D
#include "bench/peers/box2d_world.h"
#endif

namespace rink::peers {
namespace {

constexpr const char* chipmunk = "chipmunk";
constexpr const char* box2d = "box2d";
constexpr const char* box2d_bullets = "box2d-bullets";

}  // namespace

const std::vector<std::string>& peer_names() {
  static const std::vector<std::string> names{chipmunk, box2d, box2d_bullets};
  return names;
}

const char* package_of(const std::string& name) {
  return name == chipmunk ? "libchipmunk-dev" : "libbox2d-dev";
}

bool is_built_in(const std::string& name) { return version_of(name) != "absent"; }

std::string version_of([[maybe_unused]] const std::string& name) {
#ifdef RINK_HAS_CHIPMUNK
  if (name == chipmunk) return chipmunk_version();
#endif
#ifdef RINK_HAS_BOX2D
  if (name == box2d || name == box2d_bullets) return box2d_version();
#endif
  return "absent";
}

std::unique_ptr<physics::Simulator> make_peer([[maybe_unused]] const physics::WorldSpec& spec,
                                              [[maybe_unused]] const std::string& name,
                                              [[maybe_unused]] double dt,
                                              [[maybe_unused]] double speed_max) {
#ifdef RINK_HAS_CHIPMUNK
  if (name == chipmunk) return make_chipmunk(spec, dt);
#endif
#ifdef RINK_HAS_BOX2D
  if (name == box2d || name == box2d_bullets)
    return make_box2d(spec, name == box2d_bullets, dt, speed_max);
#endif
  return nullptr;
}

}  // namespace rink::peers
