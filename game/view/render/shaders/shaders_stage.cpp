// The standing scene: floor, table, surround box, goals, scoreboard.
#include "game/view/render/shaders/shaders.h"

namespace rink::view {

const char* const stage_vertex = R"glsl(
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 at;
layout(location = 3) in vec3 colour;
layout(location = 4) in float material;
uniform mat4 view;
out vec3 world, facing, tint;
out vec2 texel;
flat out int kind;
void main() {
  world = place;
  facing = normal;
  tint = colour;
  texel = at;
  kind = int(material + 0.5);
  gl_Position = view * vec4(place, 1.0);
}
)glsl";

const char* const stage_fragment = R"glsl(
in vec3 world, facing, tint;
in vec2 texel;
flat in int kind;
uniform vec3 eye;
uniform bool is_plan;
uniform sampler2D wood, digits;
out vec4 result;

vec3 table_light(vec3 to_eye) {
  vec2 inside = min(world.xy, field.xy - world.xy);
  float near = max(min(inside.x, inside.y), 0.0);
  float open = 1.0 - 0.40 * exp(-near / 0.045);
  vec2 towards_lamp = world.xy + key_light.xy * (wall_height / key_light.z);
  vec2 over = min(towards_lamp, field.xy - towards_lamp);
  float lit = smoothstep(-0.010, 0.012, min(over.x, over.y));
  float pixel = 0.7 * (length(dFdx(world.xy)) + length(dFdy(world.xy)));
  vec2 middle = world.xy / field.xy - vec2(0.5);
  float pool = 1.04 - 1.15 * dot(middle, middle);
  vec3 sheet = print(world.xy, pixel);
  return shaded(sheet * pool, vec3(0.0, 0.0, 1.0), to_eye, 0.75, open, lit) + sheet * bands(world.xy) * 0.55;
}

vec3 floor_light(vec3 to_eye) {
  vec2 centre = world.xy - 0.5 * field.xy;
  float away = length(max(abs(centre) - 0.5 * field.xy, 0.0));
  float pool = exp(-dot(centre, centre) / (3.2 * field.y * field.y));
  float shadow = 0.25 + 0.75 * smoothstep(0.0, 0.6 * field.y, away);
  vec2 tile = abs(fract(world.xy / 0.6) - 0.5);
  float pixel = length(fwidth(world.xy)) / 0.6;
  float joint = (1.0 - smoothstep(0.006, 0.006 + pixel, 0.5 - max(tile.x, tile.y))) * clamp(0.05 / pixel, 0.0, 1.0);
  vec3 stone = mix(vec3(0.028, 0.032, 0.048), vec3(0.014, 0.016, 0.024), joint);
  vec3 glow = linear(mix(left_colour, right_colour, smoothstep(-0.5, 0.5, centre.x / field.x))) * exp(-away / (0.45 * field.y)) * 0.10;
  return stone * (0.25 + 3.2 * pool) * shadow + glow * (0.4 + 0.6 * shadow) + hall(reflect(-to_eye, vec3(0.0, 0.0, 1.0))) * 0.015;
}

void main() {
  vec3 to_eye = is_plan ? vec3(0.0, 0.0, 1.0) : normalize(eye - world), normal = normalize(facing);
  vec3 colour = linear(tint), light;
  if (kind == 0) light = floor_light(to_eye);
  else if (kind == 1) light = is_plan ? print(world.xy, 0.7 * (length(dFdx(world.xy)) + length(dFdy(world.xy)))) * 1.15 : table_light(to_eye);
  else if (kind == 2) {
    vec3 grain = linear(texture(wood, texel).rgb);
    float low = normal.z > 0.5 ? 1.0 : smoothstep(-0.30, 0.03, world.z);
    light = shaded(grain * colour, normal, to_eye, 0.38, mix(0.25, 1.0, low), 1.0);
    vec2 inside = min(world.xy, field.xy - world.xy);
    if (normal.z < 0.5 && world.z > 0.0 && min(inside.x, inside.y) > -0.012 * field.y) light += bands(world.xy) * 0.35;
  } else if (kind == 3) light = shaded(colour, normal, to_eye, 0.35, 1.0, 1.0);
  else if (kind == 4) light = colour * 2.4 + 0.12;
  else if (kind == 5) light = shaded(colour * 0.6, normal, to_eye, 1.0, 1.0, 1.0) + hall(reflect(-to_eye, normal)) * colour * 0.8;
  else {
    float glyph = texture(digits, texel).r;
    light = colour * (glyph * glyph * 3.0 + 0.012) + vec3(0.6) * smoothstep(0.75, 1.0, glyph) * colour.g;
    result = vec4(shown(light), 1.0);
    return;
  }
  result = vec4(shown(light), 1.0);
}
)glsl";

}  // namespace rink::view
