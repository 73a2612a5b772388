#pragma once

namespace sandstroke::shaders {

/// GLSL: how the floor under the sand looks where it is bare (render/bare_texture.h): stones, and the level
/// bottom of the bed, which is of wood. It needs the shading of the bed, and noise where a picture is no map.
inline constexpr const char* floor_parts = R"(
uniform sampler2D bare;
// The parts of a pixel that are bare stone (x) and bare bottom (y). Between cells the outline is sharper than the
// texture, as a stone's is.
// steep: from 0 to 1 on faces that no sand could have: these belong to the stone, down to its foot.
vec2 bare_parts(float pixel, float steep) {
  vec2 parts = mean_over(bare, pixel).rg;
  parts.x = min((1.0 + 3.0 * steep) * parts.x, 1.0 - parts.y);
  return smoothstep(vec2(0.2), vec2(0.8), parts);
}
)";

inline constexpr const char* floor_look = R"(
// Flecks and pores. x: relative change of the albedo; yz: slope.
vec3 stone_texture(vec2 position, float pixel) {
  const int octaves = 5;
  const float waves[octaves] = float[octaves](0.0009, 0.0021, 0.0057, 0.017, 0.053);
  const float albedo[octaves] = float[octaves](0.20, 0.17, 0.11, 0.10, 0.12);
  const float relief[octaves] = float[octaves](0.07, 0.06, 0.05, 0.04, 0.02);
  const mat2 turn = mat2(0.6, 0.8, -0.8, 0.6);
  vec3 sum = vec3(0.0);
  mat2 frame = mat2(1.0);
  for (int i = octaves - 1; i >= 0 && pixel < 0.5 * waves[i]; --i) {
    frame = turn * frame;
    vec3 n = gradient_noise(frame * position / waves[i], uint(40 + i));
    float weight = 1.0 - smoothstep(0.25, 0.5, pixel / waves[i]);
    sum += weight * vec3(albedo[i] * n.x, relief[i] * (n.yz * frame));
  }
  return sum;
}
// Relative change of the albedo of boards along x, with gaps between them.
float board_texture(vec2 position, float pixel) {
  float board = 0.08 * cell_size * float(max(cells.x, cells.y)), across = position.y / board;
  float shift = 7.3 * floor(across), width = pixel / board;
  float fibre = 0.28 * gradient_noise(vec2(position.x / board * 0.5 + shift, across * 9.0), 51u).x *
                (1.0 - smoothstep(0.025, 0.06, width));
  fibre += 0.2 * gradient_noise(vec2(position.x / board * 0.2 + shift, across * 3.0), 52u).x *
           (1.0 - smoothstep(0.08, 0.2, width));
  float gap = 0.5 - abs(fract(across) - 0.5), half_gap = 0.012;
  return fibre - 0.6 * (1.0 - smoothstep(half_gap, half_gap + 0.02 + width, gap)) * min(1.0, half_gap / width);
}
)";

}  // namespace sandstroke::shaders
