"use strict";
// A little WebGL 2 and the mathematics of a camera, for sand.js. Matrices are arrays of 16 numbers, by columns.

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const plus = (a, b, times = 1) => [a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]];
const lengthOf = (a) => Math.hypot(...a);
const unitOf = (a) => a.map((x) => x / (lengthOf(a) || 1));

const matrixProduct = (a, b) => Float64Array.from({ length: 16 }, (_, at) => {
  const row = at % 4, col = at - row;
  return a[row] * b[col] + a[row + 4] * b[col + 1] + a[row + 8] * b[col + 2] + a[row + 12] * b[col + 3];
});

/** The matrix from the world to the picture: perspective, `tan` of half its height, seen from `eye` along `forward`. */
function cameraMatrix({ eye, forward, right, up }, tan, aspect, near, far) {
  const rotate = [right, up, forward.map((x) => -x)];
  const view = [0, 1, 2].flatMap((i) => [...rotate.map((axis) => axis[i]), 0])
    .concat(rotate.map((axis) => -dot(axis, eye)), 1);
  const depth = near - far;
  return matrixProduct([1 / (tan * aspect), 0, 0, 0, 0, 1 / tan, 0, 0,
                        0, 0, (far + near) / depth, -1, 0, 0, (2 * far * near) / depth, 0], view);
}

/** A program of two shaders. set(values) sets its uniforms: numbers, arrays, [texture unit]. */
function glProgram(gl, vertexText, fragmentText) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertexText], [gl.FRAGMENT_SHADER, fragmentText]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, `#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n${text}`);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
      throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, "vertex");
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(gl.getProgramInfoLog(program));
  const setters = {
    [gl.FLOAT]: (at, v) => gl.uniform1f(at, v), [gl.INT]: (at, v) => gl.uniform1i(at, v),
    [gl.BOOL]: (at, v) => gl.uniform1i(at, v), [gl.SAMPLER_2D]: (at, v) => gl.uniform1i(at, v),
    [gl.FLOAT_VEC2]: (at, v) => gl.uniform2fv(at, v), [gl.FLOAT_VEC3]: (at, v) => gl.uniform3fv(at, v),
    [gl.FLOAT_VEC4]: (at, v) => gl.uniform4fv(at, v), [gl.INT_VEC2]: (at, v) => gl.uniform2iv(at, v),
    [gl.FLOAT_MAT4]: (at, v) => gl.uniformMatrix4fv(at, false, v),
  };
  const uniforms = new Map();
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i += 1) {
    const { name, type } = gl.getActiveUniform(program, i), at = gl.getUniformLocation(program, name);
    uniforms.set(name, (value) => setters[type](at, value));
  }
  return (values) => {
    gl.useProgram(program);
    for (const [name, value] of Object.entries(values)) uniforms.get(name)?.(value);
  };
}

/** Triangles: three numbers per vertex, of any array type; indices of 16 or 32 bits. Returns draw(), with free(). */
function glMesh(gl, vertices, indices) {
  const array = gl.createVertexArray();
  const buffers = [gl.createBuffer(), gl.createBuffer()];
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, buffers[0]);
  gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, vertices instanceof Uint8Array ? gl.UNSIGNED_BYTE : gl.FLOAT, false, 0, 0);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[1]);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
  const draw = () => {
    gl.bindVertexArray(array);
    gl.drawElements(gl.TRIANGLES, indices.length, indices instanceof Uint32Array ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT, 0);
  };
  draw.free = () => {
    gl.deleteVertexArray(array);
    buffers.forEach((buffer) => gl.deleteBuffer(buffer));
  };
  return draw;
}

/** A texture whose storage is allocated at once. */
function glTexture(gl, unit, format, width, height, filter) {
  const texture = gl.createTexture();
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  return texture;
}

// ---- Meshes.

/**
 * A grid over a tile with a curtain around it, which hides cracks beside tiles of other detail. Vertices: column, row
 * and 1 at the curtain's lower end. The last row and column are the next tile's first.
 */
function gridMesh(side, step) {
  const n = side / step + 1, vertices = [], indices = [];
  for (let row = 0; row < n; row += 1) for (let col = 0; col < n; col += 1) vertices.push(col * step, row * step, 0);
  const quad = (a, b, c, d) => indices.push(a, b, c, b, d, c);
  for (let row = 0; row + 1 < n; row += 1)
    for (let col = 0; col + 1 < n; col += 1) {
      const at = row * n + col;
      quad(at, at + 1, at + n, at + n + 1);
    }
  const borders = [(i) => i, (i) => n * (n - 1) + i, (i) => n * i, (i) => n * i + n - 1];
  for (const border of borders) {
    const first = vertices.length / 3;
    for (let i = 0; i < n; i += 1) vertices.push(vertices[3 * border(i)], vertices[3 * border(i) + 1], 1);
    for (let i = 0; i + 1 < n; i += 1) quad(border(i), border(i + 1), first + i, first + i + 1);
  }
  return [Uint8Array.from(vertices), Uint16Array.from(indices)];
}

/** The surface of a body of revolution about z: a profile of [radius, z]. */
function turnedMesh(profile, sectors) {
  const vertices = [], indices = [];
  for (const [radius, z] of profile)
    for (let i = 0; i <= sectors; i += 1) {
      const angle = (2 * Math.PI * i) / sectors;
      vertices.push(radius * Math.cos(angle), radius * Math.sin(angle), z);
    }
  for (let ring = 0; ring + 1 < profile.length; ring += 1)
    for (let i = 0; i < sectors; i += 1) {
      const a = ring * (sectors + 1) + i, b = a + sectors + 1;
      indices.push(a, a + 1, b, a + 1, b + 1, b);
    }
  return [Float32Array.from(vertices), Uint16Array.from(indices)];
}

const halfCircle = (rings) => Array.from({ length: rings + 1 }, (_, i) =>
  [Math.sin((Math.PI * i) / rings), -Math.cos((Math.PI * i) / rings)]);
