// The view from above: thousands of discs as points with the circle in the fragment shader, large
// pieces and boxes as quads, a plain table for a camera that moves; and overlays.
#include "game/view/render/shaders/shaders.h"

namespace rink::view {

const char* const plan_vertex = R"glsl(
layout(location = 0) in vec4 form;     // centre, half extent [m]
layout(location = 1) in vec4 colour;   // its alpha is 1 for a box
layout(location = 2) in vec4 accent;   // its alpha is the angle to which a disc is turned; below -100: its ring is whole
uniform mat4 view;
uniform float pixel;                   // m
out vec2 place;
flat out vec2 half_extent;
flat out vec4 tint, second;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  half_extent = form.zw;
  place = corner * (form.zw + pixel);
  tint = colour;
  second = accent;
  gl_Position = view * vec4(form.xy + place, 0.0, 1.0);
}
)glsl";

const char* const plan_fragment = R"glsl(
in vec2 place;
flat in vec2 half_extent;
flat in vec4 tint, second;
uniform float pixel;
out vec4 result;
void main() {
  float size = min(half_extent.x, half_extent.y), away, inner;
  if (tint.a > 0.5) {
    vec2 q = abs(place) - half_extent + 0.3 * size;
    away = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - 0.3 * size;
    inner = clamp((-away - 0.35 * size) / pixel + 0.5, 0.0, 1.0);
  } else {
    away = length(place) - half_extent.x;
    inner = clamp((0.18 * size - abs(away + 0.40 * size)) / pixel + 0.5, 0.0, 1.0);
    if (second.a > -100.0) inner *= smoothstep(-0.75, -0.55, cos(3.0 * (atan(place.y, place.x) - second.a)));
  }
  vec3 colour = mix(tint.rgb, second.rgb, inner * clamp(0.5 * size / pixel - 0.5, 0.0, 1.0));
  colour *= 1.0 + 0.22 * dot(place / half_extent, vec2(-0.6, 0.6)) - 0.5 * clamp((away + 0.14 * size) / (0.14 * size), 0.0, 1.0);
  result = vec4(colour, clamp(0.5 - away / pixel, 0.0, 1.0));
}
)glsl";

const char* const point_vertex = R"glsl(
layout(location = 0) in vec3 form;     // centre, radius [m]
layout(location = 1) in vec3 colour;
layout(location = 2) in vec3 accent;
uniform mat4 view;
uniform float pixel;                   // m
flat out float radius;
flat out vec3 tint, second;
void main() {
  radius = form.z / pixel;
  tint = colour;
  second = accent;
  gl_PointSize = 2.0 * radius + 2.0;
  gl_Position = view * vec4(form.xy, 0.0, 1.0);
}
)glsl";

// In pixels.
const char* const point_fragment = R"glsl(
flat in float radius;
flat in vec3 tint, second;
out vec4 result;
void main() {
  vec2 place = (gl_PointCoord - 0.5) * (2.0 * radius + 2.0);
  float away = length(place) - radius;
  float inner = clamp((0.18 * radius - abs(away + 0.40 * radius)) + 0.5, 0.0, 1.0);
  vec3 colour = mix(tint, second, inner * clamp(0.5 * radius - 0.5, 0.0, 1.0));
  result = vec4(colour, clamp(0.5 - away, 0.0, 1.0));
}
)glsl";

const char* const flat_vertex = R"glsl(
layout(location = 0) in vec2 place;
layout(location = 1) in vec3 colour;
uniform mat4 view;
flat out vec3 light;
void main() {
  light = shown(linear(colour) * 1.15);
  gl_Position = view * vec4(place, 0.0, 1.0);
}
)glsl";

const char* const flat_fragment = R"glsl(
flat in vec3 light;
out vec4 result;
void main() { result = vec4(light, 1.0); }
)glsl";

const char* const overlay_vertex = R"glsl(
layout(location = 0) in vec4 spot;     // place [m], offset from the centre in pixels of a disc
layout(location = 1) in vec2 size;     // radius and half the width of the ring in pixels; the latter as large as the radius for a full disc, the former 0 for what is no disc
layout(location = 2) in vec4 colour;
uniform mat4 view;
out vec2 offset;
flat out vec2 ring;
flat out vec4 tint;
void main() {
  offset = spot.zw;
  ring = size;
  tint = colour;
  gl_Position = view * vec4(spot.xy, 0.0, 1.0);
}
)glsl";

const char* const overlay_fragment = R"glsl(
in vec2 offset;
flat in vec2 ring;
flat in vec4 tint;
out vec4 result;
void main() {
  float away = abs(length(offset) - ring.x + ring.y) - ring.y;
  result = vec4(tint.rgb, ring.x > 0.0 ? tint.a * clamp(0.5 - away, 0.0, 1.0) : tint.a);
}
)glsl";

}  // namespace rink::view
