#include "render/shaders.h"

#include "core/asset.h"
#include "render/floor_look.h"

SANDSTROKE_DECLARE_ASSET(sand_look);

namespace sandstroke::shaders {
namespace {

constexpr const char* version = "#version 330 core\n";

/// The light: its sources, and the way to the eye.
const std::string light = std::string(SANDSTROKE_ASSET(sand_look)) + R"(
uniform vec3 eye;
uniform vec3 forward;        // used where the camera is orthographic
uniform bool orthographic;
vec3 to_eye(vec3 position) { return orthographic ? -forward : normalize(eye - position); }
)";

/// Smooth random values over the bed, anchored in metres. Every machine computes them from the same integers.
constexpr const char* noise = R"(
vec2 lattice(ivec2 p, uint seed) {
  uint h = uint(p.x) * 0x8da6b343u ^ uint(p.y) * 0xd8163841u ^ seed * 0xcb1ab31fu;
  h ^= h >> 16; h *= 0x7feb352du; h ^= h >> 15; h *= 0x846ca68bu; h ^= h >> 16;
  return vec2(h & 0xffffu, h >> 16) / 32767.5 - 1.0;
}
// Gradient noise (Perlin), about -1 to 1 with mean zero, and its gradient.
vec3 gradient_noise(vec2 p, uint seed) {
  vec2 cell = floor(p), f = p - cell;
  ivec2 i = ivec2(cell);
  vec2 ga = lattice(i, seed), gb = lattice(i + ivec2(1, 0), seed);
  vec2 gc = lattice(i + ivec2(0, 1), seed), gd = lattice(i + ivec2(1, 1), seed);
  float a = dot(ga, f), b = dot(gb, f - vec2(1.0, 0.0));
  float c = dot(gc, f - vec2(0.0, 1.0)), d = dot(gd, f - vec2(1.0, 1.0));
  vec2 u = f * f * f * (f * (6.0 * f - 15.0) + 10.0), du = 30.0 * f * f * (f * (f - 2.0) + 1.0);
  float k = a - b - c + d;
  return 2.2 * vec3(a + (b - a) * u.x + (c - a) * u.y + k * u.x * u.y,
                    ga + u.x * (gb - ga) + u.y * (gc - ga) + u.x * u.y * (ga - gb - gc + gd) +
                        du * (vec2(b - a, c - a) + k * u.yx));
}
)";

/// The shading of the bed. It comes from all cells, whatever triangles are drawn.
constexpr const char* bed = R"(
uniform sampler2D shading;   // slope along x and y, parts of sun and sky seen
uniform vec2 bed_origin;     // cell coordinates of the bed's centre
uniform ivec2 cells;
uniform float cell_size;
uniform float wall_radius;   // m, of a round bed; 0: the bed is not round
in vec3 world;
// The part of a pixel that lies beyond the wall of a round bed.
float beyond_wall(float pixel) {
  return wall_radius > 0.0 ? clamp((length(world.xy) - wall_radius) / pixel + 0.5, 0.0, 1.0) : 0.0;
}
vec2 texture_position() { return (world.xy / cell_size + bed_origin + 0.5) / vec2(cells); }
// Metres per pixel, along the longer side of the pixel's footprint.
float pixel_footprint() { return max(length(dFdx(world.xy)), length(dFdy(world.xy))); }
// A texture's mean over a pixel.
vec4 mean_at(sampler2D field, vec2 position, float pixel) {
  return textureLod(field, position, log2(max(pixel / cell_size, 1.0)));
}
vec4 mean_over(sampler2D field, float pixel) { return mean_at(field, texture_position(), pixel); }
)";

}  // namespace

std::string surface_vertex() {
  return std::string(version) + R"(
layout(location = 0) in ivec3 vertex;   // column and row in the tile, 1 at the bottom of the skirt
uniform sampler2D heights;
uniform vec2 bed_origin;
uniform ivec2 cells;
uniform float cell_size;
uniform ivec2 tile_origin;
uniform float skirt_height;
uniform mat4 to_clip;
out vec3 world;
void main() {
  ivec2 cell = min(tile_origin + vertex.xy, cells - 1);   // the last tiles are cut at the border
  float height = vertex.z == 0 ? texelFetch(heights, cell, 0).r : skirt_height;
  world = vec3((vec2(cell) - bed_origin) * cell_size, height);
  gl_Position = to_clip * vec4(world, 1.0);
}
)";
}

std::string solid_vertex() {
  return std::string(version) + R"(
layout(location = 0) in vec3 vertex;
layout(location = 1) in vec3 vertex_normal;   // of the box
uniform float scale;
uniform vec3 offset;
uniform mat4 to_clip;
out vec3 world;
flat out vec3 face_normal;
void main() {
  face_normal = vertex_normal;
  world = scale * vertex + offset;
  gl_Position = to_clip * vec4(world, 1.0);
}
)";
}

std::string surroundings_vertex() {
  return std::string(version) + R"(
out vec2 position;   // in the picture, -1 to 1
void main() {
  position = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(position, 1.0, 1.0);
}
)";
}

std::string sand_fragment(bool on_floor) {
  return std::string(version) + light + noise + bed +
         (on_floor ? std::string("#define ON_FLOOR\n") + floor_parts + floor_look : "") +
         "const float tool_reach = " + std::to_string(tool_reach) + R"(;
uniform vec4 tool;           // centre and radius; radius 0 = none
uniform float widest_pixel;  // m, of this tile
uniform float crumbs;        // the slope at which moist sand lies in crumbs; 0: it is dry
out vec4 colour;

// Grains and patches: octaves of noise. Each fades out before a pixel covers half a wave, so nothing shimmers.
// x: relative change of the albedo; yz: slope of the grains.
vec3 grain(vec2 position, float pixel) {
  const int octaves = 8;
  const float waves[octaves] = float[octaves](0.00045, 0.0008, 0.0014, 0.0027, 0.006, 0.016, 0.05, 0.21);
  const float albedo[octaves] = float[octaves](0.38, 0.36, 0.28, 0.13, 0.06, 0.035, 0.04, 0.05);
  const float relief[octaves] = float[octaves](0.16, 0.14, 0.09, 0.035, 0.014, 0.005, 0.0, 0.0);
  const mat2 turn = mat2(0.8, 0.6, -0.6, 0.8);   // octaves share no lattice direction
  vec3 sum = vec3(0.0);
  mat2 frame = mat2(1.0);
  for (int i = octaves - 1; i >= 0 && pixel < 0.5 * waves[i]; --i) {   // ends early: a mere `if` saves no time here
    frame = turn * frame;
    vec3 n = gradient_noise(frame * position / waves[i], uint(i));
    float weight = 1.0 - smoothstep(0.25, 0.5, pixel / waves[i]);
    sum += weight * vec3(albedo[i] * n.x, relief[i] * (n.yz * frame));
  }
  return sum;
}

// Lumps of moist sand that came down, smaller ones between large ones. As grain().
vec3 crumb(vec2 position, float pixel) {
  const float waves[3] = float[3](0.0013, 0.0027, 0.0058);
  const mat2 turn = mat2(0.6, -0.8, 0.8, 0.6);
  vec3 sum = vec3(0.0);
  mat2 frame = mat2(1.0);
  for (int i = 2; i >= 0 && pixel < 0.5 * waves[i]; --i) {
    frame = turn * frame;
    vec3 n = gradient_noise(frame * position / waves[i], uint(60 + i));
    float lump = smoothstep(0.0, 0.35, n.x), weight = 1.0 - smoothstep(0.25, 0.5, pixel / waves[i]);
    sum += weight * vec3(0.16 * (lump - 0.5), 0.24 * step(0.0, n.x) * (n.yz * frame));
  }
  return sum;
}

// The fractions of the sun (x) and of the sky (y) that the tool does not hide.
vec2 past_tool(vec3 position, vec3 normal) {
  if (tool.w == 0.0) return vec2(1.0);
  vec3 to = tool.xyz - position;
  float distance = length(to), along = dot(to, sun_direction);
  float miss = length(to - along * sun_direction) - tool.w;
  float penumbra = 0.03 * max(along, 0.0) + 0.04 * tool.w;
  float sun = along > 0.0 ? smoothstep(-penumbra, penumbra, miss) : 1.0;
  float part = min(1.0, tool.w / distance);
  float taken = max(part * part - 1.0 / (tool_reach * tool_reach), 0.0);
  return vec2(sun, 1.0 - 0.8 * taken * clamp(0.5 + 0.5 * dot(normal, to / distance), 0.0, 1.0));
}

// Diffuse reflection of a rough ground (Oren and Nayar, roughness 0.5): flatter than Lambert's, as sand is.
float rough_diffuse(vec3 normal, vec3 from_sun, vec3 to_viewer) {
  float sun_part = max(dot(normal, from_sun), 0.0), view_part = max(dot(normal, to_viewer), 0.0);
  float side = dot(from_sun, to_viewer) - sun_part * view_part;
  return sun_part * (0.78 + 0.33 * (side > 0.0 ? side / max(max(sun_part, view_part), 1e-4) : side));
}

void main() {
  float pixel = pixel_footprint(), footprint = max(length(dFdx(world)), length(dFdy(world)));  // the height's part in it
  vec4 here = mean_over(shading, min(pixel, widest_pixel));
  float beyond = beyond_wall(pixel);
  vec3 on_top = sun_colour * 0.9 * sun_direction.z + ambient(vec3(0.0, 0.0, 1.0));
  vec3 wood = vec3(0.27, 0.155, 0.085) * on_top;
  if (beyond == 1.0) {
    colour = vec4(tone(wood), 1.0);
    return;
  }
  vec3 upward = vec3(-here.xy, 1.0), ground = normalize(upward);
  // Noise that is looked up from above makes streaks on steep faces. There the lookup moves on with the height, too.
  float steep = 1.0 - smoothstep(0.5, 0.7, ground.z);
  vec2 uphill = -steep * ground.xy / max(length(ground.xy), 1e-6);
  vec3 grains = grain(world.xy + world.z * uphill, mix(pixel, footprint, steep));
  if (crumbs > 0.0) {
    float part = length(here.xy) / crumbs, loose = smoothstep(0.75, 0.95, part) - smoothstep(1.1, 1.4, part);
    vec3 triangle = normalize(cross(dFdx(world), dFdy(world)));
    loose *= smoothstep(0.1, 0.3, abs(triangle.z));   // none on the upright skirt at the bed's border
    if (loose > 0.0) grains += loose * crumb(world.xy, pixel);
  }
#ifdef ON_FLOOR
  vec2 bare_here = bare_parts(min(pixel, widest_pixel), steep);
  float sand_here = 1.0 - bare_here.x - bare_here.y;
  vec3 stone = bare_here.x > 0.0 ? stone_texture(world.xy + world.z * uphill, mix(pixel, footprint, steep)) : vec3(0.0);
  grains.yz = sand_here * grains.yz + bare_here.x * stone.yz;
#endif
  vec3 relief = vec3(grains.yz, dot(grains.yz, uphill));
  vec3 normal = normalize(upward - mix(1.0, length(upward), steep) * relief);
  vec2 part = here.zw * past_tool(world, ground);

  vec3 albedo = sand_albedo(world.z) * max(1.0 + grains.x, 0.1);
#ifdef ON_FLOOR
  albedo = sand_here * albedo + bare_here.x * bare_stone * (1.0 + stone.x) +
           bare_here.y * bare_wood * (1.0 + board_texture(world.xy, pixel));
#endif

  // Furrow walls light each other, which makes corners less dark, and warmer.
  vec3 sky = part.y / (1.0 - albedo * (1.0 - part.y));
  vec3 received = sun_colour * part.x * max(rough_diffuse(normal, sun_direction, to_eye(world)), 0.0) +
                  ambient(normal) * sky;
  colour = vec4(mix(tone(albedo * received), tone(wood), beyond), 1.0);
}
)";
}

std::string map_fragment(bool on_floor) {
  return std::string(version) + light + bed +
         (on_floor ? std::string("#define ON_FLOOR\n") + floor_parts : "") + R"(
uniform sampler2D values;    // m, shown by the colours
uniform sampler2D colours;   // the colour map, from low to high
uniform vec2 range;          // m, its ends
uniform float contour_interval;  // m
uniform float relief;        // how much the light models the surface: 0 none, 1 fully
out vec4 colour;
// Slope of the values. It is smooth across cells and triangles, so that the width of lines is.
vec2 slope_of(sampler2D field, float pixel) {
  float reach = max(pixel / cell_size, 1.0), detail = log2(reach);
  vec2 at = texture_position(), x = vec2(0.5 * reach / float(cells.x), 0.0), y = vec2(0.0, 0.5 * reach / float(cells.y));
  float ne = textureLod(field, at + x + y, detail).r, nw = textureLod(field, at - x + y, detail).r;
  float se = textureLod(field, at + x - y, detail).r, sw = textureLod(field, at - x - y, detail).r;
  return 0.5 * vec2(ne - nw + se - sw, ne - se + nw - sw) / (reach * cell_size);
}
void main() {
  float pixel = pixel_footprint();
  float value = mean_over(values, pixel).r;
  float unit = clamp((value - range.x) / (range.y - range.x), 0.0, 1.0);
  vec3 mapped = texture(colours, vec2((unit * 255.0 + 0.5) / 256.0, 0.5)).rgb;

  vec3 normal = normalize(vec3(-mean_over(shading, pixel).xy, 1.0));
  const float fill = 0.6;
  float shade = (fill + max(dot(normal, sun_direction), 0.0)) / (fill + sun_direction.z);
  mapped *= mix(1.0, clamp(shade, 0.35, 1.25), relief);

  // A contour line: one and a half pixels wide, from the value's change per pixel. There is no line where the value does
  // not go through the line's (the foot of a heap on a plane at that height), or changes so much that lines would touch.
  vec2 change = slope_of(values, pixel);
  float per_pixel = length(vec2(dot(change, dFdx(world.xy)), dot(change, dFdy(world.xy))));
  float at = round(value / contour_interval) * contour_interval;
  float line = 1.0 - smoothstep(0.4, 1.3, abs(value - at) / max(per_pixel, 1e-30));
  line *= 1.0 - smoothstep(0.15, 0.4, per_pixel / contour_interval);
  if (line > 0.0) {
    vec2 uphill = 1.5 * pixel * change / (max(length(change), 1e-15) * cell_size * vec2(cells));
    float above = mean_at(values, texture_position() + uphill, pixel).r - at;
    float below = at - mean_at(values, texture_position() - uphill, pixel).r;
    line *= smoothstep(0.0005, 0.002, min(above, below) / contour_interval);
  }
  bool dark = dot(mapped, vec3(0.3, 0.6, 0.1)) < 0.35;
  vec3 with_lines = mix(mapped, vec3(dark ? 0.85 : 0.05), 0.6 * line);
#ifdef ON_FLOOR
  // Where the floor is bare: lines of gray, between which colours keep their meaning.
  vec2 parts = bare_parts(pixel, 0.0);
  float hatch = 1.0 - smoothstep(0.5, 1.2, abs(mod(gl_FragCoord.x + gl_FragCoord.y, 7.0) - 3.5));
  with_lines = mix(with_lines, vec3(dark ? 0.75 : 0.3), 0.7 * hatch * (parts.x + parts.y));
#endif
  colour = vec4(mix(with_lines, vec3(0.8), beyond_wall(pixel)), 1.0);
}
)";
}

std::string box_fragment() {
  return std::string(version) + light + noise + R"(
uniform float wall;          // m, its thickness
uniform float plain;         // 1: gray, for measuring; 0: wood
uniform vec2 half_bed;       // m
in vec3 world;
flat in vec3 face_normal;
out vec4 colour;
void main() {
  vec3 normal = dot(face_normal, to_eye(world)) < 0.0 ? -face_normal : face_normal;
  // Boards run along the nearer side of the bed; the grain is long and thin.
  vec2 out_of_bed = abs(world.xy) - half_bed;
  bool along_x = out_of_bed.y > out_of_bed.x;
  float run = along_x ? world.x : world.y, across = (along_x ? abs(world.y) : abs(world.x)) + world.z;
  float pixel = max(length(dFdx(world)), length(dFdy(world))) / wall;
  float fibre = gradient_noise(vec2(run / wall * 0.35, across / wall * 5.0), 31u).x * (1.0 - smoothstep(0.05, 0.12, pixel));
  fibre += 0.8 * gradient_noise(vec2(run / wall * 0.12, across / wall * 1.7), 32u).x * (1.0 - smoothstep(0.15, 0.35, pixel));
  vec3 albedo = mix(vec3(0.27, 0.155, 0.085) * (1.0 + 0.28 * fibre), vec3(0.33), plain);
  vec3 received = sun_colour * 0.9 * max(dot(normal, sun_direction), 0.0) + ambient(normal);
  colour = vec4(tone(albedo * received), 1.0);
}
)";
}

std::string tool_fragment() {
  return std::string(version) + light + noise + R"(
uniform vec4 tool;
uniform float sandy;         // 1: the sand on the tool
uniform float facets;        // 1: flat triangles; 0: a sphere
in vec3 world;
out vec4 colour;
void main() {
  vec3 viewer = to_eye(world), normal = normalize(world - tool.xyz);
  if (facets > 0.5) {
    normal = normalize(cross(dFdx(world), dFdy(world)));
    if (dot(normal, viewer) < 0.0) normal = -normal;
  }
  if (sandy > 0.5) {
    float pixel = max(length(dFdx(world)), length(dFdy(world)));
    vec3 grains = gradient_noise((world.xy - tool.xy) / 0.0014, 70u) * (1.0 - smoothstep(0.25, 0.5, pixel / 0.0014));
    normal = normalize(normal - vec3(0.12 * grains.yz, 0.0));
    vec3 received = sun_colour * max(dot(normal, sun_direction), 0.0) + ambient(normal);
    colour = vec4(tone(sand_albedo(world.z) * (1.0 + 0.28 * grains.x) * received), 1.0);
    return;
  }
  vec3 mirror = reflect(-viewer, normal), halfway = normalize(viewer + sun_direction);
  float edge = pow(1.0 - max(dot(normal, viewer), 0.0), 5.0);
  vec3 albedo = vec3(0.11, 0.15, 0.20);
  // The surroundings that the polished steel reflects: sand below, sky above.
  vec3 around = mix(vec3(0.55, 0.40, 0.26), vec3(0.62, 0.74, 0.92), smoothstep(-0.12, 0.12, mirror.z));
  float glint = pow(max(dot(normal, halfway), 0.0), 220.0);
  vec3 received = sun_colour * max(dot(normal, sun_direction), 0.0) + ambient(normal);
  colour = vec4(tone(albedo * received + around * mix(0.22, 0.9, edge) + sun_colour * 2.5 * glint), 1.0);
}
)";
}

std::string surroundings_fragment() {
  return std::string(version) + R"(
uniform vec3 lower, upper;       // sRGB, at the borders of the picture
uniform mat4 from_clip;
uniform vec3 eye;
uniform vec3 box_low, box_high;  // m, of the box that stands on the ground
uniform vec3 sun_direction;
uniform float shadow;            // 0 none, 1 fully
in vec2 position;
out vec4 colour;
float outside_box(vec2 p) {
  vec2 away = max(box_low.xy - p, p - box_high.xy);
  return length(max(away, 0.0)) + min(max(away.x, away.y), 0.0);
}
// How far [m] a point lies outside the farthest side of the box's shadow, which is the box swept along `way`.
float outside_shadow(vec2 p, vec2 way) {
  vec2 away = max(box_low.xy + min(way, 0.0) - p, p - box_high.xy - max(way, 0.0));
  vec2 across = vec2(-way.y, way.x) / max(length(way), 1e-6 * (box_high.x - box_low.x));
  float beside = abs(dot(p - 0.5 * (box_low + box_high).xy, across)) -
                 dot(0.5 * (box_high - box_low).xy, abs(across));
  return max(max(away.x, away.y), beside);
}
void main() {
  vec3 tint = mix(lower, upper, smoothstep(-1.0, 1.0, position.y));
  vec4 near = from_clip * vec4(position, -1.0, 1.0), far = from_clip * vec4(position, 1.0, 1.0);
  vec3 from = near.xyz / near.w, ray = far.xyz / far.w - from;
  if ((box_low.z - eye.z) / ray.z > 0.0) {   // the ground lies ahead, even if nearer than all else
    // The ground is darker where the box hides the sky, and in its shadow, whose length is set by the wall's height.
    vec2 ground = from.xy + (box_low.z - from.z) / ray.z * ray.xy;
    float size = max(box_high.x - box_low.x, box_high.y - box_low.y), height = box_high.z - box_low.z;
    float sky = 1.0 - 0.30 * exp(-max(outside_box(ground), 0.0) / (0.035 * size));
    float outside = outside_shadow(ground, -sun_direction.xy / sun_direction.z * height);
    float sun = mix(0.72, 1.0, smoothstep(-0.1 * height, 0.35 * height, outside));
    tint *= mix(1.0, sky * sun, shadow);
  }
  colour = vec4(tint, 1.0);
}
)";
}

}  // namespace sandstroke::shaders
