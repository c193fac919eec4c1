// The moving part: marks on the table (soft shadows, streaks, the glow of a goal), and pieces
// traced as rounded solids in perspective.
#include "game/view/render/shaders/shaders.h"

namespace rink::view {

const char* const mark_vertex = R"glsl(
layout(location = 0) in vec4 box;      // low and high corner [m]
layout(location = 1) in vec4 form;     // centre, half extent [m]
layout(location = 2) in vec4 manner;   // kind, and what that kind needs
layout(location = 3) in vec4 colour;
uniform mat4 view;
out vec2 place;
flat out vec4 shape, how, tint;
void main() {
  place = mix(box.xy, box.zw, vec2(gl_VertexID & 1, gl_VertexID >> 1));
  shape = form;
  how = manner;
  tint = colour;
  gl_Position = view * vec4(place, 0.0, 1.0);
}
)glsl";

const char* const mark_fragment = R"glsl(
in vec2 place;
flat in vec4 shape, how, tint;
uniform sampler2D stage_depth;
uniform vec2 origin;
uniform bool is_plan;
out vec4 result;

float box_distance(vec2 p, vec2 half_extent, float corner) {
  vec2 q = abs(p) - half_extent + corner;
  return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - corner;
}

// Of a solid of height how.y over the shape: the shape moved away from the lamp with height, its edge softer the higher what throws it.
float shadow() {
  vec2 drift = -key_light.xy / key_light.z * how.y;
  float dark = 0.0;
  for (int i = 0; i < 4; ++i) {
    float part = float(i) / 3.0;
    vec2 p = place - shape.xy - drift * part;
    float away = how.x < 0.5 ? length(p) - shape.z : box_distance(p, shape.zw, 0.012);
    float soft = 0.004 + 0.010 * part;
    dark = max(dark, 1.0 - smoothstep(-soft, soft, away));
  }
  vec2 q = place - shape.xy;
  float contact = exp(-max(how.x < 0.5 ? length(q) - shape.z : box_distance(q, shape.zw, 0.012), 0.0) / 0.018);
  return max(dark * 0.62, contact * 0.34);
}

void main() {
  if (!is_plan && gl_FragCoord.z > texelFetch(stage_depth, ivec2(gl_FragCoord.xy - origin), 0).r + 2e-5) discard;
  int kind = int(how.x + 0.5);
  vec2 p = place - shape.xy;
  result = tint;
  if (kind < 2) {
    if (any(lessThan(place, vec2(0.0))) || any(greaterThan(place, field.xy))) discard;
    result.a *= shadow();
  } else if (kind == 2) {                                     // a streak behind what is fast: how.yz is its way
    float long_side = length(how.yz), along = clamp(dot(p, -how.yz) / (long_side * long_side), 0.0, 1.0);
    float away = length(p + how.yz * along) / (shape.z * (1.0 - 0.75 * along));
    result.a *= (1.0 - smoothstep(0.6, 1.0, away)) * (1.0 - along) * (1.0 - along);
  } else if (kind == 4) {                                     // a line: how.yz is its way, shape.zw its half widths, how.w the part of alpha that is left at its end
    float along = dot(p, how.yz) / dot(how.yz, how.yz);
    if (along < 0.0 || along >= 1.0) discard;
    result.a *= (1.0 - smoothstep(0.4, 1.0, length(p - how.yz * along) / mix(shape.z, shape.w, along))) * mix(1.0, how.w, along);
  } else {                                                    // the glow of a goal
    result.a *= exp(-length(p / shape.zw) * 2.2) * (1.0 - smoothstep(0.8, 1.0, length(p / shape.zw)));
  }
}
)glsl";

const char* const piece_vertex = R"glsl(
layout(location = 0) in vec4 window;   // low and high corner of what may be covered, -1 to 1
layout(location = 1) in vec4 place;    // centre [m], kind (0 puck, 1 bat, 2 post), 1 for the mirrored image
layout(location = 2) in vec4 size;     // half extent, half height, rounding [m]
layout(location = 3) in vec4 colour;   // and the angle to which a puck is turned; below -100: its ring is whole
layout(location = 4) in vec3 accent;
uniform vec3 right, up, forward;
out vec3 ray;
flat out vec4 spot, body;
flat out vec3 tint, second;
flat out float turn;
void main() {
  vec2 corner = mix(window.xy, window.zw, vec2(gl_VertexID & 1, gl_VertexID >> 1));
  ray = forward + right * corner.x + up * corner.y;
  spot = place;
  body = size;
  tint = colour.rgb;
  turn = colour.a;
  second = accent;
  gl_Position = vec4(corner, 0.0, 1.0);
}
)glsl";

const char* const piece_fragment = R"glsl(
in vec3 ray;
flat in vec4 spot, body;
flat in vec3 tint, second;
flat in float turn;
uniform vec3 eye;
uniform mat4 view;
uniform float pixel;                   // angle that a pixel covers
uniform sampler2D stage_depth;
uniform vec2 origin;
out vec4 result;

float solid(vec3 p) {
  float corner = body.w;
  if (spot.z > 0.5 && spot.z < 1.5) {
    float inset = 0.012;
    vec2 flat_part = abs(p.xy) - body.xy + inset;
    float around = length(max(flat_part, 0.0)) + min(max(flat_part.x, flat_part.y), 0.0) - inset;
    vec2 q = vec2(around, abs(p.z) - body.z) + corner;
    return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - corner;
  }
  vec2 q = vec2(length(p.xy) - body.x, abs(p.z) - body.z) + corner;
  return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - corner;
}

vec3 normal_at(vec3 p) {
  const vec2 s = vec2(1.0, -1.0) * 0.0004;
  return normalize(s.xyy * solid(p + s.xyy) + s.yyx * solid(p + s.yyx) + s.yxy * solid(p + s.yxy) + s.xxx * solid(p + s.xxx));
}

// What the piece is painted with, its gloss in the last component.
vec4 paint(vec3 p, vec3 normal) {
  vec3 colour = linear(tint), inlay = linear(second);
  if (spot.z < 0.5) {
    float out_of = length(p.xy) / body.x;
    float ring = smoothstep(0.50, 0.54, out_of) * (1.0 - smoothstep(0.66, 0.70, out_of));
    if (turn > -100.0) ring *= smoothstep(-0.75, -0.55, cos(3.0 * (atan(p.y, p.x) - turn)));
    ring += 1.0 - smoothstep(0.14, 0.18, out_of);
    return vec4(mix(colour, inlay, ring * step(0.5, normal.z)), 0.8);
  }
  if (spot.z < 1.5) {
    vec2 q = abs(p.xy) - body.xy + 0.020;
    float inside = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - 0.006;
    return vec4(mix(colour, inlay, (1.0 - smoothstep(-0.001, 0.001, inside)) * step(0.5, normal.z)), 0.7);
  }
  float band = 1.0 - smoothstep(0.004, 0.005, abs(p.z - 0.35 * body.z));
  return vec4(mix(colour, inlay, band * (1.0 - step(0.5, normal.z))), 1.0);
}

void main() {
  bool is_image = spot.w > 0.5;
  vec3 way = normalize(ray);
  float to_table = -eye.z / way.z;
  vec2 mirrored = eye.xy + way.xy * to_table;
  if (is_image && (any(lessThan(mirrored, vec2(0.0))) || any(greaterThan(mirrored, field.xy)))) discard;
  vec3 from = eye - vec3(spot.xy, body.z);
  vec3 go = way;
  if (is_image) from.z = -eye.z - body.z, go.z = -way.z;
  // Between the entry into the box about the solid and the exit from it.
  vec3 reach = vec3(body.xy, body.z) + 0.004, near = (-sign(go) * reach - from) / go, far = (sign(go) * reach - from) / go;
  float t = max(max(near.x, near.y), near.z), last = min(min(far.x, far.y), far.z), least = 1e3;
  if (t > last) discard;
  bool is_hit = false;
  for (int i = 0; i < 24; ++i) {
    float gap = solid(from + go * t);
    least = min(least, gap / (t * pixel));
    if (gap < 0.0002) { is_hit = true; break; }
    t += gap;
    if (t > last) break;
  }
  float cover = is_hit ? 1.0 : clamp(1.0 - least, 0.0, 1.0);
  if (cover < 0.01) discard;
  vec3 p = from + go * t, normal = normal_at(p);
  vec3 world = p + vec3(spot.xy, body.z);
  vec4 clip = view * vec4(is_image ? vec3(mirrored, 0.0) : world, 1.0);
  if (clip.z / clip.w * 0.5 + 0.5 > texelFetch(stage_depth, ivec2(gl_FragCoord.xy - origin), 0).r + 4e-5) discard;
  vec4 coat = paint(p, normal);
  float low = smoothstep(0.0, 0.02, world.z);
  vec3 light = shaded(coat.rgb, normal, -go, coat.a, 0.45 + 0.55 * low, 1.0);
  if (spot.z > 1.5) light += hall(reflect(go, normal)) * linear(tint) * 0.9 + linear(vec3(0.85, 0.9, 0.95)) * 0.25 * max(-reflect(go, normal).z, 0.0);
  light += bands(world.xy) * coat.rgb * max(0.0, 1.0 - normal.z) * 0.8;
  if (is_image) {
    float grazing = 0.05 + 0.6 * pow(1.0 - abs(way.z), 4.0);
    cover *= (0.10 + grazing) * exp(-world.z / 0.035);
  }
  result = vec4(shown(light), cover);
}
)glsl";

}  // namespace rink::view
