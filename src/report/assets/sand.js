"use strict";
// Sand in 3-D: a bed of heights that may change tile by tile, the tool in it and the force on the hand. The colour of a
// cell (sun, shadow, open sky, grains) is computed when sand near it changes, and kept. A picture then looks it up once
// per pixel. Tiles that are small in the picture are drawn with fewer triangles.

const tileSide = 64;
const noFloor = -1e30;  // m, where nothing is under the sand
const sunDirection = (() => {
  const [azimuth, elevation] = [145, 20].map((degrees) => (degrees * Math.PI) / 180);
  return [Math.cos(elevation) * Math.cos(azimuth), Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation)];
})();

// How far a cell's light depends on other cells, in cells: those that hide the sun, and the sky.
const lightReach = { sun: 80, sky: 19 };

// Colours for numbers, from low to high; red, green and blue from 0 to 1.
const palettes = {
  sequential: [[0.27, 0, 0.33], [0.25, 0.27, 0.53], [0.16, 0.47, 0.56], [0.13, 0.66, 0.52], [0.48, 0.82, 0.32],
               [0.99, 0.91, 0.14]],
  diverging: [[0.13, 0.4, 0.67], [0.57, 0.77, 0.87], [0.97, 0.97, 0.97], [0.96, 0.65, 0.51], [0.7, 0.09, 0.17]],
};
const paletteShader = (name, colours) => `const vec3 ${name}[${colours.length}] = vec3[${colours.length}](${
  colours.map((colour) => `vec3(${colour.map((part) => part.toFixed(3))})`)});`;

const wholePicture = `
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;

// Smooth noise between whole numbers, about -1 to 1.
const noiseShader = `
float lattice(ivec2 p) {
  uint h = uint(p.x) * 0x8da6b343u ^ uint(p.y) * 0xd8163841u;
  h ^= h >> 16; h *= 0x7feb352du; h ^= h >> 15;
  return float(h & 0xffffu) / 32767.5 - 1.0;
}
float noise(vec2 p) {
  ivec2 i = ivec2(floor(p));
  vec2 f = fract(p), u = f * f * (3.0 - 2.0 * f);
  return mix(mix(lattice(i), lattice(i + ivec2(1, 0)), u.x),
             mix(lattice(i + ivec2(0, 1)), lattice(i + ivec2(1, 1)), u.x), u.y);
}`;

// A cell's colour as sand in the sun; alpha: how much sun falls on it.
const lightShader = `
uniform sampler2D heights, floors;
uniform ivec2 cells;
uniform float cell_size;
uniform bool on_floor;   // stones or a bottom are under the sand
uniform float bottom;    // the height of a level one
out vec4 light;
float height(ivec2 cell) { return texelFetch(heights, clamp(cell, ivec2(0), cells - 1), 0).r; }
// Tangent of the highest elevation on the way from a cell. The steps grow.
float horizon(ivec2 cell, float here, vec2 way, float steps, float growth) {
  float highest = -1.0, distance = 1.0;
  for (float i = 0.0; i < steps; i += 1.0) {
    vec2 offset = round(way * distance);
    highest = max(highest, (height(cell + ivec2(offset)) - here) / (length(offset) * cell_size));
    distance *= growth;
  }
  return highest;
}
// Grains and patches whose waves the cells can show.
float grains(vec2 position) {
  float sum = 0.04 * noise(position / 0.06);
  if (cell_size < 0.003) sum += 0.08 * noise(position / 0.008);
  if (cell_size < 0.0012) sum += 0.10 * noise(position / 0.0026);
  return sum;
}
void main() {
  ivec2 cell = ivec2(gl_FragCoord.xy), x = ivec2(1, 0), y = ivec2(0, 1);
  float here = height(cell);
  vec2 slope = vec2(height(cell + x) - height(cell - x), height(cell + y) - height(cell - y)) / (2.0 * cell_size);
  vec3 normal = normalize(vec3(-slope, 1.0));
  float sun_tangent = sun_direction.z / length(sun_direction.xy);
  float towards_sun = horizon(cell, here, normalize(sun_direction.xy), 24.0, 1.21);
  float sun = max(dot(normal, sun_direction), 0.0) *
              (1.0 - smoothstep(sun_tangent - 0.10, sun_tangent + 0.08, towards_sun));
  float sky = 0.0;
  for (int i = 0; i < 8; i += 1) {
    float angle = 0.7853981634 * float(i) + 0.39;
    float tangent = max(horizon(cell, here, vec2(cos(angle), sin(angle)), 6.0, 1.8), 0.0);
    sky += 0.125 * (1.0 - tangent / sqrt(1.0 + tangent * tangent));
  }
  vec3 albedo = sand_albedo(here) * (1.0 + grains(vec2(cell) * cell_size));
  if (on_floor) {
    float lowest = texelFetch(floors, cell, 0).r, sand = clamp((here - lowest) / (0.01 * cell_size), 0.0, 1.0);
    vec3 bare = lowest <= bottom ? bare_wood : bare_stone * (1.0 + 1.2 * grains(vec2(cell.yx) * cell_size));
    albedo = mix(bare, albedo, sand);
  }
  light = vec4(tone(albedo * (sun_colour * sun + ambient(normal) * sky)), sun);
}`;

const sandVertex = `
in vec3 vertex;
uniform sampler2D heights;
uniform ivec2 cells, tile_origin;
uniform float cell_size, curtain;
uniform vec2 origin;
uniform mat4 to_picture;
out vec3 world;
void main() {
  ivec2 cell = min(tile_origin + ivec2(vertex.xy), cells - 1);
  float height = texelFetch(heights, cell, 0).r;
  bool outer = any(equal(cell, ivec2(0))) || any(equal(cell, cells - 1));
  world = vec3(origin + vec2(cell) * cell_size, height - vertex.z * (outer ? 0.0 : curtain));
  gl_Position = to_picture * vec4(world, 1.0);
}`;

const sandFragment = `
uniform sampler2D light, values;
uniform ivec2 cells;
uniform float cell_size;
uniform vec2 origin;
uniform vec3 sun_direction;
uniform vec3 tool;         // its centre
uniform float radius;      // 0: there is none
uniform vec3 range;        // of the colours: low, high, and 1 if they are used
uniform bool diverging;
in vec3 world;
out vec4 colour;
${paletteShader("low_to_high", palettes.sequential)}
${paletteShader("blue_to_red", palettes.diverging)}
vec3 scale_colour(float value) {
  float fraction = clamp((value - range.x) / (range.y - range.x), 0.0, 1.0);
  if (diverging) {
    int i = min(int(fraction * 4.0), 3);
    return mix(blue_to_red[i], blue_to_red[i + 1], fraction * 4.0 - float(i));
  }
  int i = min(int(fraction * 5.0), 4);
  return mix(low_to_high[i], low_to_high[i + 1], fraction * 5.0 - float(i));
}
// The fraction of the light that the tool leaves: it casts a shadow and hides part of the sky. An approximation.
float past_tool() {
  vec3 to = tool - world;
  float away = length(to), along = dot(to, sun_direction), miss = length(to - along * sun_direction) - radius;
  float penumbra = 0.03 * max(along, 0.0) + 0.06 * radius, part = min(1.0, radius / away);
  float sun = along > 0.0 ? smoothstep(-penumbra, penumbra, miss) : 1.0;
  return mix(0.45, 1.0, sun) * (1.0 - 0.35 * max(part * part - 0.06, 0.0));
}
void main() {
  vec2 at = (world.xy - origin) / cell_size;
  vec4 here = texture(light, (at + 0.5) / vec2(cells));
  if (range.z > 0.0) {
    float shade = (0.6 + here.a) / (0.6 + sun_direction.z);
    colour = vec4(scale_colour(texelFetch(values, ivec2(round(at)), 0).r) * clamp(shade, 0.5, 1.2), 1.0);
  } else {
    float pixel = max(length(dFdx(world.xy)), length(dFdy(world.xy)));
    float close = 1.0 - smoothstep(0.0003, 0.0006, pixel);   // grains of half a millimetre
    if (close > 0.0) here.rgb *= 1.0 + 0.12 * close * noise(world.xy / 0.0009);
    colour = vec4(here.rgb, 1.0);
  }
  if (distance(tool.xy, world.xy) < 4.0 * radius + 2.2 * abs(tool.z - world.z) && radius > 0.0) colour.rgb *= past_tool();
}`;

const solidVertex = `
in vec3 vertex;
uniform mat4 to_picture;
uniform vec3 position, scale, axis;   // the mesh's z goes along the axis,
uniform vec4 turn;                 // after it was turned by a quaternion (x, y, z, w)
out vec3 mesh, world;
void main() {
  vec3 x = normalize(abs(axis.z) < 0.9 ? cross(vec3(0.0, 0.0, 1.0), axis) : cross(vec3(0.0, 1.0, 0.0), axis));
  mesh = vertex;
  vec3 turned = vertex + 2.0 * cross(turn.xyz, cross(turn.xyz, vertex) + turn.w * vertex);
  world = position + mat3(x, cross(axis, x), axis) * (turned * scale);
  gl_Position = to_picture * vec4(world, 1.0);
}`;

const solidFragment = `
uniform vec4 paint;
uniform bool sandy;      // the sand on the tool
uniform vec3 eye;
uniform float gloss;
in vec3 mesh, world;
out vec4 colour;
void main() {
  vec3 normal = normalize(cross(dFdx(world), dFdy(world))), viewer = normalize(eye - world);
  if (sandy) {
    if (normal.z < 0.0) normal = -normal;
    vec3 albedo = sand_albedo(world.z) * (1.0 + 0.12 * noise(mesh.xy / 0.0014));
    colour = vec4(tone(albedo * (sun_colour * max(dot(normal, sun_direction), 0.0) + ambient(normal))), 1.0);
    return;
  }
  if (gloss > 0.0) normal = normalize(mesh);   // of a sphere
  float glint = gloss * pow(max(dot(normal, normalize(viewer + sun_direction)), 0.0), 90.0);
  vec3 received = sun_colour * max(dot(normal, sun_direction), 0.0) + 2.0 * ambient(normal);
  colour = vec4(tone(paint.rgb * received + sun_colour * glint), paint.a);
}`;

/** The box around the bed: an outer wall with a rim, as four prisms of [x, y, z]. */
function boxMesh({ low, high, floor, rim, wall }) {
  const vertices = [], indices = [];
  const inner = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]];
  const outer = inner.map(([x, y], i) => [x + (i === 0 || i === 3 ? -wall : wall), y + (i < 2 ? -wall : wall)]);
  for (let i = 0; i < 4; i += 1) {
    const j = (i + 1) % 4, first = vertices.length / 3;
    for (const [x, y, z] of [[...outer[i], floor], [...outer[j], floor], [...outer[i], rim], [...outer[j], rim],
                             [...inner[i], rim], [...inner[j], rim], [...inner[i], floor], [...inner[j], floor]])
      vertices.push(x, y, z);
    for (const [a, b, c, d] of [[0, 1, 2, 3], [2, 3, 4, 5], [4, 5, 6, 7]])
      indices.push(...[a, b, c, b, d, c].map((k) => first + k));
  }
  return [Float32Array.from(vertices), Uint16Array.from(indices)];
}

/**
 * A bed {rows, cols, cellSize, x0, y0, low, high, bottom} [m] in a canvas. x0, y0: its first cell's centre. low, high: the
 * range of its heights. bottom: the height of a level floor under the sand; null: none. Null where there is no WebGL 2, or where it does not take so many cells.
 */
function sandPicture(canvas, bed) {
  // Where the processor draws, smooth edges would cost as much as everything else.
  const fast = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true }) !== null;
  const gl = canvas.getContext("webgl2", { antialias: fast, powerPreference: "high-performance" });
  if (!gl || Math.max(bed.rows, bed.cols) > gl.getParameter(gl.MAX_TEXTURE_SIZE)) return null;
  const { rows, cols, cellSize } = bed;
  const size = Math.max(rows, cols) * cellSize, origin = [bed.x0, bed.y0], cells = [cols, rows];
  const tileCols = Math.ceil(cols / tileSide), tileRows = Math.ceil(rows / tileSide);
  const heights = new Float32Array(rows * cols);

  const [toHeights, toLight, toValues, toFloors] = [0, 1, 2, 3];
  glTexture(gl, toHeights, gl.R32F, cols, rows, gl.NEAREST);
  const lightTexture = glTexture(gl, toLight, gl.RGBA8, cols, rows, gl.LINEAR);
  let valuesTexture = glTexture(gl, toValues, gl.R32F, 1, 1, gl.NEAREST);
  let floorsTexture = null;  // once there are some
  const lightTarget = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, lightTarget);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, lightTexture, 0);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);

  const lit = glProgram(gl, wholePicture, sandLook + noiseShader + lightShader);
  const sand = glProgram(gl, sandVertex, noiseShader + sandFragment);
  const solid = glProgram(gl, solidVertex, sandLook + noiseShader + solidFragment);
  const steps = [1, 2, 4, 8, 16, 32], grids = steps.map((step) => glMesh(gl, ...gridMesh(tileSide, step)));
  const sphere = glMesh(gl, ...turnedMesh(halfCircle(20), 32));
  const arrow = glMesh(gl, ...turnedMesh([[0, 0], [0.35, 0], [0.35, 0.75], [1, 0.75], [0, 1]], 20));
  const rod = glMesh(gl, ...turnedMesh([[1, 0], [1, 1]], 8));
  const nothing = gl.createVertexArray();
  const wall = 0.012 * size, half = 0.5 * cellSize;
  const end = [bed.x0 + (cols - 1) * cellSize + half, bed.y0 + (rows - 1) * cellSize + half];
  const box = glMesh(gl, ...boxMesh({ low: [bed.x0 - half, bed.y0 - half], high: end, wall,
                                      floor: Math.min(bed.low, -0.02) - 0.03 * size, rim: Math.max(bed.high, 0) + 0.6 * wall }));

  const waiting = new Map();  // heights by tile, not taken yet
  let unfinished = null;      // the last picture, while it is being drawn
  let stale = [[0, 0, cols, rows]];  // rectangles of cells whose light must be computed
  let tool = null, toolMesh = null, load = null, line = null, colouring = null, [lowest, highest] = [bed.low, bed.high];

  /** Cells [first column, row, end column, row] changed: the light near them and in their shadow becomes stale. */
  const shade = ([left, lower, right, upper]) => {
    const tangent = sunDirection[2] / Math.hypot(sunDirection[0], sunDirection[1]);
    const reach = Math.min(lightReach.sun, (highest - lowest) / ((tangent - 0.1) * cellSize) + 1);
    const [x, y] = [0, 1].map((i) => (-reach * sunDirection[i]) / Math.hypot(sunDirection[0], sunDirection[1]));
    const sky = lightReach.sky;
    const from = [left - sky + Math.min(x, 0), lower - sky + Math.min(y, 0)].map((at) => Math.max(0, Math.floor(at)));
    const to = [Math.min(cols, right + sky + Math.max(x, 0)), Math.min(rows, upper + sky + Math.max(y, 0))].map(Math.ceil);
    stale.push([...from, to[0] - from[0], to[1] - from[1]]);
  };

  /** A tile: first column and row, width and height. */
  const part = (tile) => {
    const col = (tile % tileCols) * tileSide, row = Math.floor(tile / tileCols) * tileSide;
    return [col, row, Math.min(tileSide, cols - col), Math.min(tileSide, rows - row)];
  };

  const takeTile = (values, tile) => {
    const [col, row, width, height] = part(tile);
    const changed = [cols, rows, 0, 0];
    for (let r = 0; r < height; r += 1)
      for (let c = 0; c < width; c += 1) {
        const at = (row + r) * cols + col + c, value = values[r * tileSide + c];
        if (value === heights[at]) continue;
        heights[at] = value;
        lowest = Math.min(lowest, value);
        highest = Math.max(highest, value);
        changed[0] = Math.min(changed[0], col + c);
        changed[1] = Math.min(changed[1], row + r);
        changed[2] = Math.max(changed[2], col + c + 1);
        changed[3] = Math.max(changed[3], row + r + 1);
      }
    if (changed[0] >= changed[2]) return;
    gl.texSubImage2D(gl.TEXTURE_2D, 0, col, row, width, height, gl.RED, gl.FLOAT, values);
    shade(changed);
  };

  /** Takes the tiles that came since the last picture, each in its newest state. */
  const takeTiles = () => {
    gl.activeTexture(gl.TEXTURE0 + toHeights);
    gl.pixelStorei(gl.UNPACK_ROW_LENGTH, tileSide);
    waiting.forEach(takeTile);
    waiting.clear();
  };

  /** Makes room for the floor under the sand, of which there is none yet. */
  const beginFloors = () => {
    floorsTexture = glTexture(gl, toFloors, gl.R32F, cols, rows, gl.NEAREST);
    gl.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, cols, rows, gl.RED, gl.FLOAT, new Float32Array(rows * cols).fill(noFloor));
  };

  const lightUp = () => {
    lit({ heights: toHeights, cells, cell_size: cellSize, sun_direction: sunDirection, on_floor: floorsTexture !== null,
          floors: floorsTexture ? toFloors : toHeights, bottom: bed.bottom ?? noFloor });
    gl.bindFramebuffer(gl.FRAMEBUFFER, lightTarget);
    gl.bindVertexArray(nothing);
    gl.disable(gl.DEPTH_TEST);
    for (const cellsOf of stale) {
      gl.viewport(...cellsOf);   // what lies outside is clipped, and pixels keep their cells
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    stale = [];
  };

  const drawTiles = (camera, pixels) => {
    const reach = 0.75 * tileSide * cellSize;
    for (let tile = 0; tile < tileRows * tileCols; tile += 1) {
      const [col, row] = part(tile);
      const middle = [origin[0] + (col + tileSide / 2) * cellSize, origin[1] + (row + tileSide / 2) * cellSize, 0];
      const from = plus(middle, camera.eye, -1), ahead = dot(from, camera.forward);
      if (ahead < -reach) continue;
      const w = Math.max(ahead, reach), edge = 1 + (reach * 2) / (w * camera.tan);
      if (Math.abs(dot(from, camera.up)) > edge * w * camera.tan ||
          Math.abs(dot(from, camera.right)) > edge * w * camera.tan * camera.aspect) continue;
      const cellPixels = (pixels * cellSize) / Math.max(lengthOf(from) - reach, 0.2 * reach);
      let level = 0;
      while (level + 1 < steps.length && steps[level + 1] * cellPixels <= 2.5) level += 1;
      sand({ tile_origin: [col, row], curtain: 2 * steps[level] * cellSize });
      grids[level]();
    }
  };

  const drawSolid = (mesh, values) => {
    solid(values);
    mesh();
  };

  const drawAll = (orbit, coarseness) => {
    const camera = orbit.of(canvas.width / canvas.height);
    const matrix = cameraMatrix(camera, camera.tan, camera.aspect, 0.02 * camera.distance, camera.distance + 4 * size);
    const world = { to_picture: matrix, sun_direction: sunDirection, eye: camera.eye };
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    const centre = tool ? plus(tool.tip, [0, 0, tool.radius]) : [0, 0, 0];
    sand({ ...world, heights: toHeights, light: toLight, values: colouring?.values ? toValues : toHeights, cells,
           cell_size: cellSize, origin, tool: centre, radius: tool && !toolMesh ? tool.radius : 0,
           range: colouring ? [colouring.low, colouring.high, 1] : [0, 1, 0], diverging: colouring?.diverging ?? false });
    drawTiles(camera, canvas.height / (2 * camera.tan * coarseness));
    const upright = { ...world, axis: [0, 0, 1], turn: [0, 0, 0, 1], gloss: 0, sandy: false };
    drawSolid(box, { ...upright, position: [0, 0, 0], scale: [1, 1, 1], paint: [0.27, 0.16, 0.09, 1] });
    if (line) {
      const along = plus(line[1], line[0], -1), thin = 0.002 * size;
      gl.disable(gl.DEPTH_TEST);
      drawSolid(rod, { ...upright, axis: unitOf(along), position: line[0], scale: [thin, thin, lengthOf(along)],
                       paint: [0.0, 0.2, 0.6, 1] });
      gl.enable(gl.DEPTH_TEST);
    }
    if (!tool) return;
    const { radius } = tool, ball = { position: centre, scale: [radius, radius, radius], gloss: 2.5 };
    const body = { ...upright, ...(toolMesh ? { position: tool.tip, scale: [1, 1, 1], turn: tool.turn } : ball) };
    const drawTool = (opacity) => drawSolid(toolMesh ?? sphere, { ...body, paint: [0.12, 0.16, 0.21, opacity] });
    drawTool(1);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthFunc(gl.GREATER);   // then the part of the tool that lies in the sand
    gl.depthMask(false);
    drawTool(0.25);
    gl.depthMask(true);
    gl.depthFunc(gl.LESS);
    gl.disable(gl.BLEND);
    if (load) drawSolid(load, { ...upright, position: tool.tip, scale: [1, 1, 1], sandy: true });
    const push = lengthOf(tool.force);
    if (push > 0.2 * radius)
      drawSolid(arrow, { ...upright, axis: unitOf(tool.force), position: centre, paint: [0.75, 0.13, 0.02, 1],
                         scale: [0.3 * radius, 0.3 * radius, radius + push] });
  };

  return {
    canvas, heights,
    /** Sets a tile, by its index: 64 x 64 heights. */
    setTile: (tile, values) => { waiting.set(tile, values); },
    /** Sets all heights, row by row. */
    setHeights: (values) => {
      waiting.clear();
      heights.set(values);
      gl.activeTexture(gl.TEXTURE0 + toHeights);
      gl.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, cols, rows, gl.RED, gl.FLOAT, values);
      stale = [[0, 0, cols, rows]];
    },
    /** Sets a tile of the floor under the sand, by its index: 64 x 64 heights; noFloor: there is none. */
    setFloorTile: (tile, values) => {
      if (!floorsTexture) beginFloors();
      gl.activeTexture(gl.TEXTURE0 + toFloors);
      gl.pixelStorei(gl.UNPACK_ROW_LENGTH, tileSide);
      const [col, row, width, height] = part(tile);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, col, row, width, height, gl.RED, gl.FLOAT, values);
      stale.push([col, row, width, height]);
    },
    /** The same of all cells, row by row. */
    setFloor: (values) => {
      if (!floorsTexture) beginFloors();
      gl.activeTexture(gl.TEXTURE0 + toFloors);
      gl.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, cols, rows, gl.RED, gl.FLOAT, values);
      stale = [[0, 0, cols, rows]];
    },
    /** Sets the tool: tip and radius in m, force as an arrow's length in m, and its turn; null: there is none. */
    setTool: (one) => { tool = one; },
    /** Sets the tool's shape, its tip at the origin [m]. Without it the tool is a sphere. */
    setToolMesh: (vertices, triangles) => {
      toolMesh = glMesh(gl, Float32Array.from(vertices), Uint32Array.from(triangles));
    },
    /** Sets the sand on the tool: triangles on the bed's axes, the tip at the origin [m]; without any there is none. */
    setLoad: (vertices, triangles) => {
      load?.free();
      load = triangles.length > 0 ? glMesh(gl, vertices, triangles) : null;
    },
    /** Sets a line between two positions; null: there is none. */
    setLine: (one) => { line = one; },
    /** Sets colours for values (by cell; null: the heights themselves) from low to high; null: sand. */
    setColours: (one) => {
      colouring = one;
      if (!one?.values) return;
      gl.deleteTexture(valuesTexture);
      valuesTexture = glTexture(gl, toValues, gl.R32F, cols, rows, gl.NEAREST);
      gl.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, cols, rows, gl.RED, gl.FLOAT, one.values);
    },
    /** What a cell looks like in the sun: red, green and blue, and how much sun falls on it, to 255. */
    colourOf: (row, col) => {
      const pixel = new Uint8Array(4);
      gl.bindFramebuffer(gl.FRAMEBUFFER, lightTarget);
      gl.readPixels(col, row, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      return [...pixel];
    },
    /** True while the last picture is being drawn: asking for another one then only takes longer. */
    isBusy: () => {
      if (unfinished && !gl.isContextLost() && gl.getSyncParameter(unfinished, gl.SYNC_STATUS) !== gl.SIGNALED) return true;
      gl.deleteSync(unfinished);
      unfinished = null;
      return false;
    },
    /** Draws what a camera (orbitCamera) sees. Triangles may be `coarseness` times larger than they need be. */
    draw: (orbit, coarseness = 1) => {
      if (gl.isContextLost()) return;
      takeTiles();
      lightUp();
      drawAll(orbit, coarseness);
      unfinished = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
      gl.flush();
    },
    /** The position where a ray meets the sand [m]; null: nowhere. */
    meet: ([from, way]) => {
      const reaches = [0, 1].map((i) => [[origin[i] - from[i]], [origin[i] + (cells[i] - 1) * cellSize - from[i]]]
        .map(([d]) => d / (way[i] || 1e-12)).sort((a, b) => a - b));
      let at = Math.max(0, reaches[0][0], reaches[1][0]);
      const last = Math.min(reaches[0][1], reaches[1][1]);
      const step = cellSize / Math.max(Math.abs(way[0]), Math.abs(way[1]), 0.3);
      const above = (t) => {
        const p = plus(from, way, t);
        const col = Math.round((p[0] - origin[0]) / cellSize), row = Math.round((p[1] - origin[1]) / cellSize);
        if (col < 0 || row < 0 || col >= cols || row >= rows) return Infinity;
        return p[2] - heights[row * cols + col];
      };
      for (let before = Infinity; at <= last; at += step) {
        const now = above(at);
        if (now <= 0) {
          const back = Number.isFinite(before) ? (step * now) / (now - before) : 0;
          return plus(from, way, at - Math.abs(back));
        }
        before = now;
      }
      return null;
    },
    bed, size, fast, tileCount: tileRows * tileCols,
  };
}
