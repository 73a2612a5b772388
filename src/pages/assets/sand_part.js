"use strict";
// A part of a page: surfaces in 3-D (sand_view.js), one after the other; heights along a line that is drawn on them;
// and the difference of two surfaces, in colours.

/** Packed whole numbers of 32 bits. */
async function unpackSteps(data) {
  const bytes = Uint8Array.from(atob(data), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new DataView(await new Response(stream).arrayBuffer());
}

/** The floor under the sand of a part [m], by cell; noFloor: there is none. */
async function unpackFloor({ floor, rows, cols, quantum }) {
  const steps = await unpackSteps(floor), none = -(2 ** 31);
  return Float32Array.from({ length: rows * cols }, (_, i) => {
    const step = steps.getInt32(4 * i, true);
    return step === none ? noFloor : step * quantum;
  });
}

/** The surfaces of a part, as heights [m]. Each was kept as whole steps from the one before. */
async function unpackSurfaces({ surfaces, rows, cols, quantum }) {
  const steps = new Int32Array(rows * cols), all = [];
  for (const { data } of surfaces) {
    const change = await unpackSteps(data);
    for (let i = 0; i < steps.length; i += 1) steps[i] += change.getInt32(4 * i, true);
    all.push(Float32Array.from(steps, (step) => step * quantum));
  }
  return all;
}

/** Heights under a line between two positions, a cell apart: [way, height]. */
function heightsAlong(bed, heights, [from, to]) {
  const long = Math.hypot(to[0] - from[0], to[1] - from[1]), n = Math.max(2, Math.ceil(long / bed.cellSize) + 1);
  return Array.from({ length: n }, (_, i) => {
    const fraction = i / (n - 1);
    const [col, row] = [[0, bed.x0, bed.cols], [1, bed.y0, bed.rows]].map(([axis, first, count]) =>
      Math.min(Math.max(Math.round((from[axis] + fraction * (to[axis] - from[axis]) - first) / bed.cellSize), 0), count - 1));
    return [fraction * long, heights[row * bed.cols + col]];
  });
}

function profileChart(bed, line, shown) {
  const curves = shown.map(({ name, heights, look }) => ({ name, look, points: heightsAlong(bed, heights, line) }));
  const x = scaleOf([0, curves[0].points.at(-1)[0]], { margin: 0, title: "way along the line", unit: "m" });
  const y = scaleOf(curves.flatMap(({ points }) => points.map(([, height]) => height)), { title: "height", unit: "m" });
  return {
    title: "Heights along the line", height: "17rem",
    legend: curves.map(({ name, look }) => ({ name, colour: look.colour, dash: look.dash })),
    option: { ...chartBase(() => null), grid: { left: 88, right: 26, top: 14, bottom: 48 },
              xAxis: x.axis, yAxis: { ...y.axis, nameGap: 62 },
              series: curves.map(({ name, look, points }) => lineOf(name, points, x, y, look)) },
  };
}

function drawSand(part) {
  const { rows, cols, cell_size: cellSize, x0, y0, low, high, surfaces, difference } = part;
  const bed = { rows, cols, cellSize, x0, y0, low, high, bottom: part.bottom };
  const view = sandView(bed, part.title);
  if (!view)
    return [el("p", {}, "This browser has no WebGL 2 and cannot draw sand in 3-D. The pictures on this page show it.")];
  const profile = chartFrame({ class: "profile" });
  const state = { view, part, heights: [], shown: surfaces.length - 1, line: null, ready: false };
  sandParts.push(state);

  const name = el("output", {}, surfaces.at(-1).name);
  const show = (k) => {
    state.shown = k;
    name.textContent = surfaces[k].name;
    view.picture.setHeights(state.heights[k]);
    drawProfile();
    view.changed();
  };
  const drawProfile = () => {
    if (!state.line) return;
    const last = { name: surfaces[state.shown].name, heights: state.heights[state.shown], look: lookOfSurface.last };
    const other = state.shown === 0 ? surfaces.length - 1 : 0;
    const first = { name: surfaces[other].name, heights: state.heights[other], look: lookOfSurface.initial };
    profile.show(profileChart(bed, state.line, [first, last]));
  };
  /** Draws a line on the bed, between two positions. */
  state.draw = (line) => {
    state.line = line;
    view.picture.setLine(line.map((at) => [at[0], at[1], at[2] ?? 0]));
    drawProfile();
    view.changed();
  };

  const choice = surfaces.length > 3
    ? el("label", { class: "wide" }, "Time ", el("input", { type: "range", min: 0, max: surfaces.length - 1,
                                                            value: state.shown,
                                                            input: (event) => show(Number(event.target.value)) }), name)
    : el("label", {}, "Surface ", el("select", { change: (event) => show(Number(event.target.value)) },
        ...surfaces.map((surface, k) => el("option", { value: k, selected: k === state.shown }, surface.name))));
  const colours = el("select", { change: (event) => {
    const one = event.target.value;
    view.coloured = one !== "sand";
    view.colours = one === "difference" ? state.difference : null;
    view.changed();
  } }, el("option", { value: "sand" }, "as sand"), el("option", { value: "height" }, "by height"),
     difference ? el("option", { value: "difference" }, difference) : null);
  const pen = el("button", { type: "button", "aria-pressed": "false", click: () => {
    const on = pen.getAttribute("aria-pressed") === "false";
    pen.setAttribute("aria-pressed", String(on));
    view.canvas.classList.toggle("draws", on);
    let from = null;
    view.drawing = !on ? null : (event) => {
      const position = view.position(event);
      if (event.type === "pointerdown") from = position;
      if (event.type === "pointermove" && from && position) state.draw([from, position]);
      if (["pointerup", "pointercancel"].includes(event.type)) from = null;
      return event.type !== "wheel";
    };
  } }, "Draw a line for a profile");

  Promise.all([unpackSurfaces(part), part.floor ? unpackFloor(part) : null]).then(([heights, floor]) => {
    state.heights = heights;
    if (floor) view.picture.setFloor(floor);
    if (difference) {
      const values = heights[1].map((height, i) => height - heights[0][i]);
      const most = values.reduce((largest, value) => Math.max(largest, Math.abs(value)), 1e-9);
      state.difference = { values, low: -most, high: most, diverging: true };
    }
    show(state.shown);
    state.ready = true;
  });
  return [el("p", {}, part.text),
          el("div", { class: "controls" }, choice, el("label", {}, "Colours ", colours), pen),
          el("div", { class: "sand" }, view.canvas, view.scale), el("p", { class: "quiet keys" }, viewHelp), profile.element];
}

const sandParts = [];  // of this page
