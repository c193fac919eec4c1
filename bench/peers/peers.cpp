// Which peers were found when this was built; RINK_HAS_CHIPMUNK, RINK_HAS_BOX2D and
// RINK_HAS_BOX2D3 come from bench/peers/CMakeLists.txt.
#include "bench/peers/peers.h"

#include <algorithm>

#ifdef RINK_HAS_CHIPMUNK
#include "bench/peers/chipmunk_world.h"
#endif
#ifdef RINK_HAS_BOX2D
#include "bench/peers/box2d_world.h"
#endif
#ifdef RINK_HAS_BOX2D3
#include "bench/peers/box2d3_world.h"
#endif

namespace rink::peers {
namespace {

constexpr const char* chipmunk = "chipmunk";
constexpr const char* box2d = "box2d";
constexpr const char* box2d_bullets = "box2d-bullets";
constexpr const char* box2d3 = "box2d3";

}  // namespace

const std::vector<std::string>& peer_names() {
  static const std::vector<std::string> names{chipmunk, box2d, box2d_bullets, box2d3};
  return names;
}

std::string way_to(const std::string& name) {
  if (name == box2d3) return "configure with -DRINK_BOX2D3=FOLDER of the sources of Box2D v3.1";
  return std::string("install ") + (name == chipmunk ? "libchipmunk-dev" : "libbox2d-dev") +
         " and configure again";
}

bool is_built_in(const std::string& name) { return version_of(name) != "absent"; }

std::string version_of([[maybe_unused]] const std::string& name) {
#ifdef RINK_HAS_CHIPMUNK
  if (name == chipmunk) return chipmunk_version();
#endif
#ifdef RINK_HAS_BOX2D
  if (name == box2d || name == box2d_bullets) return box2d_version();
#endif
#ifdef RINK_HAS_BOX2D3
  if (name == box2d3) return box2d3_version();
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
#ifdef RINK_HAS_BOX2D3
  if (name == box2d3) return make_box2d3(spec, dt, speed_max);
#endif
  return nullptr;
}

}  // namespace rink::peers
