// How sand looks in the sun: for GLSL 3.30 (pictures) and GLSL ES 3.00 (pages). Colours are linear until tone().
uniform vec3 sun_direction;
const vec3 sun_colour = vec3(1.0, 0.83, 0.60) * 3.5;
const vec3 sky_colour = vec3(0.49, 0.55, 0.70) * 0.50;
const vec3 bounce_colour = vec3(0.55, 0.39, 0.23) * 0.55;
const vec3 dry_sand = vec3(0.64, 0.455, 0.265);
const vec3 moist_sand = vec3(0.41, 0.275, 0.155);

// What lies under the sand: stones, gray under a sun that is warmer than the sky, and the wood of the box.
const vec3 bare_stone = vec3(0.24, 0.246, 0.258);
const vec3 bare_wood = vec3(0.27, 0.155, 0.085);

// A soft light from the side, as of a bright cloud: without it the walls of a furrow along the sun look alike.
const vec3 side_colour = vec3(0.66, 0.72, 0.90) * 0.6;
vec3 side_direction() {
  vec2 level = sun_direction.xy / max(length(sun_direction.xy), 1e-3);
  return normalize(vec3(level.y, -level.x, 0.55));
}

vec3 ambient(vec3 normal) {
  return mix(bounce_colour, sky_colour, 0.5 + 0.5 * normal.z) + side_colour * max(dot(normal, side_direction()), 0.0);
}

// Carved sand is moist and dark, deposited sand dry and light. Both effects grow slowly with the height [m].
vec3 sand_albedo(float height) {
  float heap = height / (abs(height) + 0.006);
  return mix(dry_sand, heap < 0.0 ? moist_sand : dry_sand * 1.13, abs(heap) * (heap < 0.0 ? 0.55 : 0.75));
}

vec3 srgb_from_linear(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
// A filmic curve: straight in the middle, soft towards white, so that sunlit crests keep their colour. Exposed for
// level ground, like a camera: as bright under a high sun as under one at 28 degrees.
vec3 tone(vec3 c) {
  c *= clamp(1.9 / (2.95 * sun_direction.z + 0.7), 0.5, 1.8);
  c = c * (1.0 + c * 0.12) / (1.0 + c * 0.55);
  return srgb_from_linear(c);
}
