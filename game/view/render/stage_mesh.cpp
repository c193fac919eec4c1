// Boxes and quads. Proportions are those of a real table of 2.4 m by 1.2 m.
#include "game/view/render/stage_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <initializer_list>

namespace rink::view {
namespace {

using Vector2f = Eigen::Vector2f;

constexpr Colour white{1.0f, 1.0f, 1.0f, 1.0f}, black{0.035f, 0.04f, 0.05f, 1.0f},
    steel{0.62f, 0.66f, 0.72f, 1.0f}, dark{0.10f, 0.11f, 0.14f, 1.0f};
constexpr float wood_texture_m = 0.8f;
constexpr float board_half = 0.40f, board_low = 0.06f,
                board_high = 0.38f;  // of the scoreboard, in units of a table 1.2 m wide

class Mesh {
 public:
  /// The corners anticlockwise as seen from where `corner[i]` x `corner[i+1]` points.
  void quad(const std::array<Vector3, 4>& corners, Material material, const Colour& colour,
            const Vector2f& low, const Vector2f& high) {
    const auto& [a, b, c, d] = corners;
    const Vector3 normal = (b - a).cross(d - a).normalized();
    const Vector2f right_low(high.x(), low.y()), left_high(low.x(), high.y());
    for (const auto& [place, at] :
         {std::pair{a, low}, {b, right_low}, {c, high}, {a, low}, {c, high}, {d, left_high}})
      vertex(place, normal, at, material, colour);
  }

  /// A whole texture at `height`, seen from above.
  void level(const Vector2f& low, const Vector2f& high, float height, Material material,
             const Colour& colour) {
    quad({Vector3(low.x(), low.y(), height), Vector3(high.x(), low.y(), height),
          Vector3(high.x(), high.y(), height), Vector3(low.x(), high.y(), height)},
         material, colour, {0.0f, 0.0f}, {1.0f, 1.0f});
  }

  /// A box from `low` to `high`; the wood's grain runs along the longest side of each face.
  void box(const Vector3& low, const Vector3& high, Material material, const Colour& colour) {
    for (int axis = 0; axis < 3; ++axis)
      for (const bool is_high : {false, true}) face(low, high, {axis, is_high}, material, colour);
  }

  std::vector<float> take() { return std::move(rows_); }

 private:
  /// The face of a box where it ends along `axis`.
  struct Face {
    int axis;
    bool is_high;
  };

  void vertex(const Vector3& place, const Vector3& normal, const Vector2f& at, Material material,
              const Colour& colour) {
    rows_.insert(rows_.end(),
                 {place.x(), place.y(), place.z(), normal.x(), normal.y(), normal.z(), at.x(),
                  at.y(), colour.red, colour.green, colour.blue, static_cast<float>(material)});
  }

  void face(const Vector3& low, const Vector3& high, const Face& face, Material material,
            const Colour& colour) {
    const auto [axis, is_high] = face;
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (!is_high) std::swap(u, v);
    Vector3 a = low;
    a[axis] = is_high ? high[axis] : low[axis];
    Vector3 b = a, c = a, d = a;
    b[u] = c[u] = high[u];
    c[v] = d[v] = high[v];
    const Vector3 size = high - low;
    const bool is_along_u = size[u] >= size[v];
    for (const Vector3* corner : {&a, &b, &c, &a, &c, &d}) {
      const Vector2f at = (is_along_u ? Vector2f((*corner)[u], (*corner)[v])
                                      : Vector2f((*corner)[v], (*corner)[u])) /
                          wood_texture_m;
      vertex(*corner, Vector3::Unit(axis) * (is_high ? 1.0f : -1.0f), at, material, colour);
    }
  }

  std::vector<float> rows_;
};

struct Sizes {
  float length, width, goal_low, goal_high, unit, wall, thick;
};

Sizes sizes_of(const Table& table) {
  const float unit = table.width / 1.2f;
  return {table.length,
          table.width,
          0.5f * (table.width - table.goal_width),
          0.5f * (table.width + table.goal_width),
          unit,
          0.05f * std::min(unit, 4.0f),
          0.075f * unit};
}

/// The wall along one end: two blocks beside the goal, a lintel over it, a dark pocket behind and a
/// frame of the team's colour.
void add_end(Mesh& mesh, const Sizes& s, bool is_left, const Colour& team) {
  const float inner = is_left ? 0.0f : s.length, outer = is_left ? -s.thick : s.length + s.thick;
  const float low = std::min(inner, outer), high = std::max(inner, outer), slot = 0.72f * s.wall,
              frame = 0.012f * s.unit;
  mesh.box({low, -s.thick, -0.16f * s.unit}, {high, s.goal_low, s.wall}, Material::wood, white);
  mesh.box({low, s.goal_high, -0.16f * s.unit}, {high, s.width + s.thick, s.wall}, Material::wood,
           white);
  if (s.goal_high <= s.goal_low) return;
  mesh.box({low, s.goal_low, -0.16f * s.unit}, {high, s.goal_high, -0.012f}, Material::painted,
           black);
  const float back = is_left ? low + 0.01f * s.unit : high - 0.01f * s.unit;
  mesh.box({std::min(outer, back), s.goal_low, -0.012f}, {std::max(outer, back), s.goal_high, slot},
           Material::painted, black);
  mesh.box({low, s.goal_low, slot}, {high, s.goal_high, s.wall}, Material::metal,
           {0.6f * team.red, 0.6f * team.green, 0.6f * team.blue, 1.0f});
  const float lip = is_left ? inner - frame : inner;
  for (const float y : {s.goal_low - frame, s.goal_high})
    mesh.box({lip, y, 0.0f}, {lip + frame, y + frame, s.wall + 0.004f * s.unit}, Material::glowing,
             team);
  mesh.box({lip, s.goal_low - frame, slot},
           {lip + frame, s.goal_high + frame, slot + 0.35f * frame}, Material::glowing, team);
}

/// Bands of light on top of the walls' inner edges, each team's half in its colour.
void add_bands(Mesh& mesh, const Sizes& s, const Table& table) {
  const float band = 0.009f * s.unit, top = s.wall + 0.003f * s.unit, half = 0.5f * s.length;
  const float inward = 0.0015f * s.unit;  // nothing lies in the plane of the wall
  for (const auto& [low, high] : {std::pair{-band, inward}, {s.width - inward, s.width + band}}) {
    mesh.box({0.0f, low, s.wall - 0.01f * s.unit}, {half, high, top}, Material::glowing,
             table.left);
    mesh.box({half, low, s.wall - 0.01f * s.unit}, {s.length, high, top}, Material::glowing,
             table.right);
  }
}

void add_surround(Mesh& mesh, const Sizes& s, const Table& table) {
  for (const float y : {-s.thick, s.width})
    mesh.box({0.0f, y, -0.16f * s.unit}, {s.length, y + s.thick, s.wall}, Material::wood, white);
  add_end(mesh, s, true, table.left);
  add_end(mesh, s, false, table.right);
  add_bands(mesh, s, table);
  const float trim = 0.006f * s.unit;
  for (const float y : {-s.thick - trim, s.width + s.thick})
    mesh.box({-s.thick - trim, y, s.wall - 0.02f * s.unit},
             {s.length + s.thick + trim, y + trim, s.wall + 0.002f * s.unit}, Material::metal,
             steel);
  for (const float x : {-s.thick - trim, s.length + s.thick})
    mesh.box({x, -s.thick, s.wall - 0.02f * s.unit},
             {x + trim, s.width + s.thick, s.wall + 0.002f * s.unit}, Material::metal, steel);
}

void add_legs(Mesh& mesh, const Sizes& s, float ground) {
  const float side = 0.12f * s.unit, in = 0.10f * s.unit;
  for (const float x : {in, s.length - in - side})
    for (const float y : {in, s.width - in - side})
      mesh.box({x, y, ground}, {x + side, y + side, -0.15f * s.unit}, Material::metal, steel);
  mesh.box({-0.02f * s.unit, -0.02f * s.unit, -0.20f * s.unit},
           {s.length + 0.02f * s.unit, s.width + 0.02f * s.unit, -0.14f * s.unit},
           Material::painted, dark);
}

/// Two numbers of one or two digits each on a dark panel that faces a viewer looking along `ahead`.
void add_board(Mesh& mesh, const Sizes& s, const Table& table, const Scoreboard& board,
               float ground) {
  const Vector3 ahead(board.ahead_x, board.ahead_y, 0.0f),
      right(board.ahead_y, -board.ahead_x, 0.0f), up(0.0f, 0.0f, 1.0f);
  const float unit = s.unit, half = board_half * unit, low = board_low * unit,
              high = board_high * unit;
  const Vector3 middle(board.x, board.y, 0.0f);
  const auto place = [&](float across, float height, float forth) -> Vector3 {
    return middle + right * across + up * height - ahead * forth;
  };
  struct Block {
    float left, right, bottom, top, front, back;
  };
  const auto add = [&](const Block& block, Material material, const Colour& colour) {
    const Vector3 a = place(block.left, block.bottom, block.front),
                  b = place(block.right, block.top, block.back);
    mesh.box(a.cwiseMin(b), a.cwiseMax(b), material, colour);
  };
  add({-half, half, low, high, 0.0f, -0.05f * unit}, Material::painted, black);
  for (const auto& [bottom, top] :
       {std::pair{high, high + 0.012f * unit}, {low - 0.012f * unit, low}})
    add({.left = -half - 0.012f * unit,
         .right = half + 0.012f * unit,
         .bottom = bottom,
         .top = top,
         .front = 0.006f * unit,
         .back = -0.056f * unit},
        Material::metal, steel);
  for (const float side : {-1.0f, 1.0f})
    add({.left = side * 0.55f * half - 0.015f * unit,
         .right = side * 0.55f * half + 0.015f * unit,
         .bottom = ground,
         .top = low,
         .front = -0.02f * unit,
         .back = -0.05f * unit},
        Material::metal, steel);
  const float width = 0.17f * unit, height = 1.6f * width,
              bottom = 0.5f * (low + high) - 0.5f * height, front = 0.002f * unit;
  const auto digit = [&](float across, std::uint32_t number, const Colour& colour) {
    assert(number < 10);
    const float from = static_cast<float>(number) / 10.0f;
    mesh.quad(
        {place(across - 0.5f * width, bottom, front), place(across + 0.5f * width, bottom, front),
         place(across + 0.5f * width, bottom + height, front),
         place(across - 0.5f * width, bottom + height, front)},
        Material::digit, colour, {from, 0.0f}, {from + 0.1f, 1.0f});
  };
  const auto number = [&](float across, std::uint32_t value, const Colour& colour) {
    value = std::min(value, 99u);
    if (value < 10) return digit(across, value, colour);
    digit(across - 0.5f * width, value / 10, colour);
    digit(across + 0.5f * width, value % 10, colour);
  };
  number(-0.5f * half, board.first, board.is_left_first ? table.left : table.right);
  number(0.5f * half, board.second, board.is_left_first ? table.right : table.left);
  for (const float height_part : {0.38f, 0.62f}) {
    const float at = bottom + height_part * height, dot = 0.011f * unit;
    add({-dot, dot, at - dot, at + dot, 0.004f * unit, 0.0f}, Material::glowing,
        {0.75f, 0.8f, 0.85f, 1.0f});
  }
}

}  // namespace

std::vector<float> stage_mesh(const Table& table, const Scoreboard& board) {
  Mesh mesh;
  const Sizes s = sizes_of(table);
  const float ground = -0.8f * s.unit, around = 8.0f * s.unit;
  mesh.level({-around, -around}, {s.length + around, s.width + around}, ground, Material::floor,
             white);
  mesh.level({0.0f, 0.0f}, {s.length, s.width}, 0.0f, Material::table, white);
  add_surround(mesh, s, table);
  add_legs(mesh, s, ground);
  if (board.is_there) add_board(mesh, s, table, board, ground);
  return mesh.take();
}

Eigen::AlignedBox3f board_box(const Table& table, const Scoreboard& board) {
  const float unit = table.width / 1.2f, half_x = board_half * unit * std::abs(board.ahead_y),
              half_y = board_half * unit * std::abs(board.ahead_x), around = 0.01f * unit;
  return {Vector3(board.x - half_x - around, board.y - half_y - around, board_low * unit),
          Vector3(board.x + half_x + around, board.y + half_y + around, board_high * unit)};
}

std::vector<float> plan_mesh(const Table& table) {
  Mesh mesh;
  const Sizes s = sizes_of(table);
  mesh.level({0.0f, 0.0f}, {s.length, s.width}, 0.0f, Material::table, white);
  add_surround(mesh, s, table);
  return mesh.take();
}

}  // namespace rink::view
