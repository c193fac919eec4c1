// The table in plain colours, for a camera from above that moves: a frame of it costs a fifteenth
// of the printed sheet with its texture.
#include <algorithm>
#include <cmath>
#include <utility>

#include "game/view/render/stage_mesh.h"

namespace rink::view {
namespace {

constexpr Colour ice{0.76f, 0.845f, 0.93f, 1.0f}, blue{0.16f, 0.36f, 0.70f, 1.0f},
    red{0.84f, 0.20f, 0.22f, 1.0f}, wood{0.47f, 0.27f, 0.17f, 1.0f},
    edging{0.5f, 0.53f, 0.58f, 1.0f};
constexpr int arc_segments = 96;

Colour mixed(const Colour& a, const Colour& b, float part) {
  return {std::lerp(a.red, b.red, part), std::lerp(a.green, b.green, part),
          std::lerp(a.blue, b.blue, part), 1.0f};
}

constexpr float pi = 3.14159265f;

/// The part of a ring between two radii from angle `from` on, `turn` [rad] long.
struct Ring {
  float x, y, inner, outer;
  float from = 0.0f, turn = 2.0f * pi;
};

class PlanMesh {
 public:
  void vertex(float x, float y, const Colour& colour) {
    rows_.insert(rows_.end(), {x, y, colour.red, colour.green, colour.blue});
  }
  void box(float x0, float y0, float x1, float y1, const Colour& colour) {
    for (const int corner : {0, 1, 3, 0, 3, 2})
      vertex((corner & 1) != 0 ? x1 : x0, (corner & 2) != 0 ? y1 : y0, colour);
  }
  void ring(const Ring& ring, const Colour& colour) {
    for (int i = 0; i < arc_segments; ++i) {
      const float a = ring.from + ring.turn * static_cast<float>(i) / arc_segments,
                  b = ring.from + ring.turn * static_cast<float>(i + 1) / arc_segments;
      const auto at = [&](float angle, float radius) {
        vertex(ring.x + radius * std::cos(angle), ring.y + radius * std::sin(angle), colour);
      };
      at(a, ring.inner), at(a, ring.outer), at(b, ring.outer);
      at(a, ring.inner), at(b, ring.outer), at(b, ring.inner);
    }
  }
  std::vector<float> take() { return std::move(rows_); }

 private:
  std::vector<float> rows_;
};

}  // namespace

std::vector<float> plain_mesh(const Table& table) {
  PlanMesh mesh;
  const float length = table.length, width = table.width, unit = width / 1.2f,
              fine = std::min(unit, 2.2f), thick = 0.075f * unit, trim = 0.006f * unit,
              band = 0.009f * unit, middle = 0.5f * width;
  mesh.box(-thick - trim, -thick - trim, length + thick + trim, width + thick + trim, edging);
  mesh.box(-thick, -thick, length + thick, width + thick, wood);
  mesh.box(0.0f, 0.0f, length, width, ice);
  mesh.ring({0.5f * length, middle, 0.0f, 0.19f * unit}, mixed(ice, blue, 0.09f));
  for (const bool is_left : {true, false}) {
    const Colour& team = is_left ? table.left : table.right;
    const float end = is_left ? 0.0f : length, way = is_left ? 1.0f : -1.0f,
                from = is_left ? -0.5f * pi : 0.5f * pi, crease = 0.72f * table.goal_width,
                line = end + way * 0.33f * length;
    mesh.ring({end, middle, 0.0f, crease, from, pi}, mixed(ice, team, 0.18f));
    mesh.ring({end, middle, crease - 0.006f * fine, crease + 0.006f * fine, from, pi}, team);
    mesh.box(line - 0.008f * fine, 0.0f, line + 0.008f * fine, width, mixed(ice, blue, 0.8f));
    for (const float side : {-1.0f, 1.0f}) {
      const float x = end + way * 0.25f * length, y = middle + side * 0.25f * width;
      mesh.ring({x, y, 0.0f, 0.018f * fine}, mixed(ice, red, 0.75f));
      mesh.ring({x, y, 0.07f * unit - 0.004f * fine, 0.07f * unit + 0.004f * fine},
                mixed(ice, red, 0.75f));
    }
    const float half = 0.5f * table.goal_width;
    mesh.box(is_left ? -thick : length, middle - half, is_left ? 0.0f : length + thick,
             middle + half, mixed(Colour{}, team, 0.7f));
    for (const float y : {-band, width})
      mesh.box(is_left ? 0.0f : 0.5f * length, y, is_left ? 0.5f * length : length, y + band,
               mixed(team, {1.0f, 1.0f, 1.0f, 1.0f}, 0.4f));
  }
  mesh.ring({0.5f * length, middle, 0.19f * unit - 0.006f * fine, 0.19f * unit + 0.006f * fine},
            blue);
  mesh.box(0.5f * length - 0.010f * fine, 0.0f, 0.5f * length + 0.010f * fine, width, red);
  mesh.ring({0.5f * length, middle, 0.0f, 0.03f * fine}, red);
  return mesh.take();
}

}  // namespace rink::view
