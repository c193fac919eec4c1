// The common part of all shaders: the lamp over the table, the hall that glossy things reflect, the
// print on the table.
#include "game/view/render/shaders/shaders.h"

namespace rink::view {

const char* const light_source = R"glsl(
uniform vec3 field;         // length, width, width of the goals [m]
uniform vec3 left_colour, right_colour;
const vec3 key_light = vec3(-0.3146, 0.2696, 0.9101);   // towards the lamp
const float wall_height = 0.05;

vec3 linear(vec3 colour) { return colour * colour * (0.7 * colour + 0.3); }      // from sRGB, near enough
vec3 shown(vec3 light) {                                                        // filmic shoulder (Hable), then sRGB
  vec3 toned = (light * (2.51 * light + 0.03)) / (light * (2.43 * light + 0.59) + 0.14);
  return pow(clamp(toned, 0.0, 1.0), vec3(1.0 / 2.2));
}

// A dark hall with two rows of soft lamps under its ceiling.
vec3 hall(vec3 way) {
  vec3 light = mix(vec3(0.012, 0.014, 0.022), vec3(0.06, 0.075, 0.11), smoothstep(-0.3, 0.9, way.z));
  vec2 ceiling = way.xy / max(way.z, 0.02);
  float lamps = smoothstep(1.3, 1.0, abs(ceiling.x)) * smoothstep(0.30, 0.16, abs(abs(ceiling.y - 0.1) - 0.55));
  return light + vec3(1.5, 1.42, 1.3) * lamps * smoothstep(0.0, 0.15, way.z);
}

// `open` is how much of the hall's light arrives, `lit` how much of the lamp's.
vec3 shaded(vec3 albedo, vec3 normal, vec3 to_eye, float gloss, float open, float lit) {
  float facing = max(dot(normal, key_light), 0.0) * lit;
  vec3 ambient = mix(vec3(0.10, 0.10, 0.12), vec3(0.34, 0.37, 0.44), 0.5 + 0.5 * normal.z) * open;
  vec3 halfway = normalize(to_eye + key_light);
  float shine = pow(max(dot(normal, halfway), 0.0), mix(12.0, 220.0, gloss)) * gloss * lit;
  float grazing = 0.04 + 0.96 * pow(1.0 - max(dot(normal, to_eye), 0.0), 5.0);
  return albedo * (ambient + vec3(1.15, 1.08, 0.98) * facing) + vec3(1.0, 0.95, 0.88) * shine + hall(reflect(-to_eye, normal)) * grazing * gloss * open;
}

float stroke(float away, float half_width, float pixel) { return 1.0 - smoothstep(-pixel, pixel, abs(away) - half_width); }

// The printed sheet at `p` [m]; a pixel covers about `pixel` metres there.
vec3 print(vec2 p, float pixel) {
  float unit = field.y / 1.2, fine = min(unit, 2.2), half_pixel = 0.6 * pixel;
  vec3 ice = linear(vec3(0.76, 0.845, 0.93)), blue = linear(vec3(0.16, 0.36, 0.70)), red = linear(vec3(0.84, 0.20, 0.22));
  bool is_left = p.x < 0.5 * field.x;
  vec3 team = linear(is_left ? left_colour : right_colour);
  vec2 end = vec2(is_left ? p.x : field.x - p.x, p.y - 0.5 * field.y), centre = p - 0.5 * field.xy;
  float crease = 0.72 * field.z;
  vec3 colour = ice;
  vec2 hole = fract(p / (0.04 * unit)) - 0.5;
  float holes = (1.0 - smoothstep(-half_pixel, half_pixel, length(hole) * 0.04 * unit - 0.0028 * unit)) * (1.0 - smoothstep(0.004 * unit, 0.02 * unit, pixel));
  colour *= 1.0 - 0.45 * holes * step(unit, 2.5);                                // in a wide field they would look like pucks
  colour = mix(colour, team, 0.30 * (1.0 - smoothstep(-half_pixel, half_pixel, length(end) - crease)));
  colour = mix(colour, team, stroke(length(end) - crease, 0.006 * fine, half_pixel));
  colour = mix(colour, blue, stroke(end.x - 0.33 * field.x, 0.008 * fine, half_pixel) * 0.9);
  float from_centre = length(centre);
  colour = mix(colour, blue, 0.14 * (1.0 - smoothstep(-half_pixel, half_pixel, from_centre - 0.19 * unit)));
  colour = mix(colour, blue, stroke(from_centre - 0.19 * unit, 0.006 * fine, half_pixel));
  colour = mix(colour, red, stroke(centre.x, 0.010 * fine, half_pixel));
  colour = mix(colour, red, 1.0 - smoothstep(-half_pixel, half_pixel, from_centre - 0.03 * fine));
  vec2 spot = vec2(end.x - 0.25 * field.x, abs(end.y) - 0.25 * field.y);
  colour = mix(colour, red, 0.85 * (1.0 - smoothstep(-half_pixel, half_pixel, length(spot) - 0.018 * fine)));
  colour = mix(colour, red, 0.85 * stroke(length(spot) - 0.07 * unit, 0.004 * fine, half_pixel));
  return colour;
}

// Light that the bands along the walls throw on the table.
vec3 bands(vec2 p) {
  float unit = field.y / 1.2;
  vec2 inside = min(p, field.xy - p);
  float near = exp(-max(min(inside.x, inside.y), 0.0) / (0.05 * unit));
  return linear(mix(left_colour, right_colour, smoothstep(-0.06 * unit, 0.06 * unit, p.x - 0.5 * field.x))) * near;
}
)glsl";

}  // namespace rink::view
