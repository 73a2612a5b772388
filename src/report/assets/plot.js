"use strict";
// Charts of every page: looks, scales with their ticks, legends and tooltips. The chart library gets text from the data
// only as text of SVG elements. Tooltips are elements made here.

// Colours are names of page.css: charts that stand follow when the page turns dark, or light for a printer. Fills that
// mean something stay as they are, and so do the inks on them. Each colour of a series has a symbol, so that grey print
// tells series apart.
const colours = [1, 2, 3, 4, 5, 6, 7].map((i) => `var(--series-${i})`), neutral = colours[6];
const [darkInk, lightInk] = ["#1d2329", "#ffffff"], outlineColour = "#ff5fb0";
const verdictLooks = {  // also in grey print from light to dark as from harmless to bad
  fine: { fill: "#d3e6f2", ink: darkInk }, restless: { fill: "#efb23e", ink: darkInk },
  worse: { fill: "#7a63b3", ink: lightInk }, lost: { fill: "#ad3a06", ink: lightInk },
};
const symbols = [  // outlines in a square of 10
  // A circle of one arc would be drawn, but the pointer would never find it.
  "M5 0a5 5 0 0 1 0 10a5 5 0 0 1 0-10z", "M0 0h10v10h-10z", "M5 0l5.5 10h-11z", "M5 0l5 5-5 5-5-5z",
  "M5 10l5.5-10h-11z",
  "M3.3 0h3.4v3.3h3.3v3.4h-3.3v3.3h-3.4v-3.3h-3.3v-3.4h3.3z", "M2 0h6l3 5-3 5h-6l-3-5z",
];
const dashes = ["solid", "dashed", "dotted"];
/** The look of the i-th series, the same in every chart of a page. */
const lookOf = (i) => ({
  colour: colours[i % colours.length],
  symbol: symbols[i % symbols.length],
  dash: dashes[Math.floor(i / colours.length) % dashes.length],
});

// ---- Scales. ECharts draws everything on linear axes; for a logarithmic axis it gets the values' logarithms. So the
// ticks are made here, and rectangles and lines meet on any axis.

/** Round values between low and high, about `count` of them. */
function roundTicks(low, high, count = 6) {
  const raw = (high - low) / count;
  const unit = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((m) => m * unit >= raw * 0.999) * unit;
  const ticks = [];
  const first = Math.ceil(low / step - 1e-9);
  // Where low and high differ by rounding alone, first + 1 may be first.
  for (let n = 0; n <= 2 * count && (first + n) * step <= high + 1e-9 * step; n += 1) ticks.push((first + n) * step);
  return [...new Set(ticks)];
}

/** Ticks from 10^low to 10^high, with the labelled ones among them. */
function logarithmicTicks(low, high) {
  const between = (mantissas) => {
    const found = [];
    for (let k = Math.floor(low); k <= high; k += 1)
      for (const m of mantissas) {
        const at = k + Math.log10(m);
        if (at >= low - 1e-9 && at <= high + 1e-9) found.push(Number(`${m}e${k}`));
      }
    return found;
  };
  const decades = high - low;
  if (decades < 0.5) {
    const ticks = roundTicks(10 ** low, 10 ** high, 4);
    return { ticks, labelled: ticks };
  }
  const all = [1, 2, 3, 4, 5, 6, 7, 8, 9];
  if (decades < 2.2)
    return { ticks: between(all), labelled: between(decades < 1 ? [1, 2, 3, 4, 5, 7] : [1, 2, 5]) };
  const every = Math.ceil(decades / 7);
  return {
    ticks: between(decades < 5 ? all : [1]),
    labelled: between([1]).filter((value) => Math.round(Math.log10(value)) % every === 0),
  };
}

/**
 * The positions of values on an axis. `values` are what it must hold (on a logarithmic axis only positive values have a
 * position). `margin` is the fraction of the axis that is left free at each end.
 */
function scaleOf(values, { logarithmic = false, margin = 0.05, title = "", unit = "" } = {}) {
  const at = (value) => {
    if (!isNumber(value) || (logarithmic && value <= 0)) return null;
    return logarithmic ? Math.log10(value) : value;
  };
  let low = Infinity, high = -Infinity;
  for (const position of values.map(at))
    if (position !== null) [low, high] = [Math.min(low, position), Math.max(high, position)];
  if (low > high) [low, high] = [0, 1];
  const least = logarithmic ? 0.3 : Math.max(Math.abs(high) * 1e-6, 1e-12);
  if (high === low || (margin > 0 && high - low < least)) [low, high] = [low - least / 2, high + least / 2];
  const free = margin * (high - low);
  low -= free;
  high += free;
  const { ticks, labelled } = logarithmic
    ? logarithmicTicks(low, high)
    : { ticks: roundTicks(low, high), labelled: roundTicks(low, high) };
  const back = (position) => (logarithmic ? 10 ** position : position);
  const axis = axisOf(low, high, withUnit(title, unit), ticks.map(at), labelled.map(at),
                      (position) => tickText(back(position)));
  axis.splitLine.lineStyle.color = ticks.map((tick) => (labelled.includes(tick) ? "var(--rule)" : "var(--faint-rule)"));
  return { at, low, high, from: back(low), to: back(high), axis };
}

/** The positions of names on an axis: the i-th is at i. */
function nameScale(names, { title = "" } = {}) {
  const [low, high] = [-0.5, names.length - 0.5], positions = names.map((_, i) => i);
  const axis = axisOf(low, high, title, positions, positions, (i) => names[i]);
  Object.assign(axis.axisLabel, { width: 56, overflow: "truncate" });
  return { at: (i) => i, low, high, axis };
}

/** An axis with ticks, some of which have labels: text(position). */
const axisOf = (low, high, name, ticks, labelled, text) => ({
  type: "value", min: low, max: high, name, nameLocation: "middle", nameGap: 30,
  nameTextStyle: { color: "var(--ink)", fontSize: 12 },
  axisLine: { show: true, onZero: false, lineStyle: { color: "var(--axis)" } },
  axisTick: { show: true, customValues: ticks, length: 4 },
  axisLabel: { customValues: labelled, color: "var(--ink)", fontSize: 11, hideOverlap: true, formatter: text },
  splitLine: { lineStyle: { color: "var(--rule)" } },
});

// ---- Colours for numbers: from light to dark, so that grey print keeps their order.
const rampColours = ["#fdf5cc", "#cbe7bf", "#76c5bf", "#3394bd", "#2b60a4", "#222a63"];
/** The colour at a fraction between 0 and 1. */
const ramp = (fraction) => echarts.color.lerp(Math.min(Math.max(fraction, 0), 1), rampColours);
/** The colour of text on that colour. */
const rampInk = (fraction) => (fraction > 0.55 ? lightInk : darkInk);
/** The position of a value on a scale (without margin), as a fraction of the scale. */
const fractionOf = (scale, value) => (scale.at(value) - scale.low) / (scale.high - scale.low);

/** A colour bar: colour stops from low to high, with ticks [value, text]. */
function colourBar({ name, low, high, ticks, stops }) {
  const marks = ticks.map(([value, text]) =>
    el("span", { style: `left: ${(100 * (value - low)) / (high - low)}%` }, text));
  return el("div", { class: "colours" }, el("span", {}, name),
            el("div", {}, el("div", { class: "bar", style: `background: linear-gradient(to right, ${stops})` }),
               el("div", { class: "marks" }, ...marks)));
}

/** The ramp's colour bar over a scale; of the ramp, the part between two fractions. */
function rampBar({ low, high, axis: { name, axisLabel } }, from = 0, to = 1) {
  const ticks = axisLabel.customValues.map((position) => [position, axisLabel.formatter(position)]);
  const stops = Array.from({ length: 11 }, (_, i) => ramp(from + (to - from) * (i / 10)));
  return colourBar({ name, low, high, ticks, stops });
}

// ---- Charts.

/** The small picture beside a name: a line with its symbol, or a filled square with a sign in it. */
function swatch({ colour, symbol, hollow, dash, fill, sign, ink }) {
  const space = "http://www.w3.org/2000/svg";
  const make = (tag, attributes, text = "") => {
    const shape = document.createElementNS(space, tag);
    for (const [name, value] of Object.entries(attributes)) shape.setAttribute(name, value);
    shape.textContent = text;
    return shape;
  };
  const picture = make("svg", { width: fill ? 14 : 26, height: 14, "aria-hidden": "true" });
  if (fill) {
    picture.append(make("rect", { width: 14, height: 14, rx: 2, fill, stroke: colour ?? "var(--hairline)",
                                  "stroke-width": colour ? 3 : 1 }));
    if (sign) picture.append(
      make("text", { x: 7, y: 11, "text-anchor": "middle", "font-size": 11, fill: ink }, sign));
    return picture;
  }
  const dashed = { dashed: "6 3", dotted: "2 3" }[dash] ?? "none";
  if (dash !== "none")
    picture.append(make("path", { d: "M0 7H26", stroke: colour, "stroke-width": 2,
                                  "stroke-dasharray": dashed }));
  if (symbol)
    picture.append(make("path", { d: symbol, transform: "translate(9 3) scale(0.8)", "stroke-width": 1.75,
                                  fill: hollow ? "none" : colour, stroke: hollow ? colour : "none" }));
  return picture;
}

const verdictMark = (look, name) => el("span", { class: "verdict" }, swatch(look), name);

/**
 * A chart with its title and legend. `legend`: [{name, text, colour, symbol, dash, fill, ...}]. An entry with
 * `series: true` hides and shows the series of its name; an entry without colour is a heading. `bar` is a colour bar.
 * click(item) gets what was clicked. The chart is drawn once the page stands: as SVG, or on a canvas for `many` items.
 */
function chart({ title, note = null, legend = [], bar = null, option, height = null, click = null, many = false }) {
  const canvas = el("div", { class: "canvas", style: height && `height: ${height}` });
  const one = { canvas, option, click, renderer: many ? "canvas" : "svg", drawn: null };
  const toggle = (name) => (event) => {
    const button = event.currentTarget;
    button.setAttribute("aria-pressed", button.getAttribute("aria-pressed") === "false");
    one.drawn.dispatchAction({ type: "legendToggleSelect", name });
  };
  const entries = legend.map((entry) => {
    const parts = [entry.colour || entry.fill ? swatch(entry) : null, el("span", {}, entry.text ?? entry.name)];
    return el("li", {}, entry.series
      ? el("button", { type: "button", "aria-pressed": "true", click: toggle(entry.name) }, ...parts)
      : el("span", {}, ...parts.filter(Boolean)));
  });
  charts.push(one);
  option.legend = { show: false };
  option.aria = {
    enabled: true,
    label: { description: [title, ...legend.map((entry) => entry.text ?? entry.name)].join("; ") },
  };
  return el("figure", {}, el("figcaption", {}, title, note && el("small", {}, note)), canvas, bar,
            entries.length ? el("ul", { class: "legend" }, ...entries) : null);
}

// A canvas does not know the names either: it looks them up as it is painted.
echarts.setPlatformAPI({ createCanvas: () => {
  const canvas = document.createElement("canvas"), context = canvas.getContext("2d");
  const values = getComputedStyle(document.documentElement);  // as they are when asked for
  for (const property of ["fillStyle", "strokeStyle"]) {
    const { get, set } = Object.getOwnPropertyDescriptor(CanvasRenderingContext2D.prototype, property);
    const named = (colour) => colour.replace?.(/^var\((.*)\)$/, (_, name) => values.getPropertyValue(name)) ?? colour;
    Object.defineProperty(context, property, { get: () => get.call(context),
                                               set: (colour) => set.call(context, named(colour)) });
  }
  return canvas;
} });

function drawChart(one) {
  one.drawn = echarts.init(one.canvas, chartTheme, { renderer: one.renderer });
  one.drawn.setOption(one.option);
  if (one.click) one.drawn.on("click", one.click);
  // Tools that capture a whole page make its window a pixel wide for a moment: nobody reads that.
  one.observer = new ResizeObserver(() => one.canvas.clientWidth >= 100 && one.drawn.resize());
  one.observer.observe(one.canvas);
}

/** A frame for one chart after the other: show(what) draws chart(what) there; change(option) changes what is drawn. */
function chartFrame(attributes) {
  const element = el("div", attributes);
  let one = null;
  const remove = () => {
    one.observer?.disconnect();
    one.drawn?.dispose();
    charts.splice(charts.indexOf(one), 1);
  };
  return {
    element,
    show: (what) => {
      if (one) remove();
      element.replaceChildren(chart(what));
      one = charts.at(-1);
      if (element.isConnected) drawChart(one);
    },
    change: (option) => one.drawn?.setOption(option),
  };
}

const tipLook = { confine: true, backgroundColor: "var(--paper)", textStyle: { color: "var(--ink)" } };
/** The start of every chart's option. `tip(item)` gives the tooltip of the item under the pointer. */
const chartBase = (tip) => ({
  animation: false,
  textStyle: { fontFamily: "system-ui, -apple-system, 'Segoe UI', Roboto, 'Noto Sans', 'DejaVu Sans', sans-serif" },
  grid: { left: 64, right: 26, top: 14, bottom: 48 },
  tooltip: { trigger: "item", ...tipLook, formatter: (item) => tip(item) ?? "" },
});

/** A tooltip: a heading, and names with their values. */
const tipOf = (heading, pairs) =>
  el("div", { class: "tip" }, el("strong", {}, heading),
     el("dl", {}, ...pairs.flatMap(([name, value]) => [el("dt", {}, name), el("dd", {}, format(value))])));

/** A symbol as the chart library needs it. */
const outlined = (symbol) => `path://${symbol}`;

// The library lightens what is pointed at, but cannot do so with names of colours: symbols and lines keep theirs.
const chartTheme = Object.fromEntries(["line", "scatter"].map((type) =>
  [type, { emphasis: { itemStyle: { color: "inherit" } } }]));
/** The look of a line with its symbols. */
const lineStyles = ({ colour, dash = "solid", width = 1.75 }, focus = "none") => ({
  itemStyle: { color: colour }, lineStyle: { color: colour, type: dash, width },
  emphasis: { focus, lineStyle: { color: colour } },
});

/** A line through [x, y], given as the data's values. */
const lineOf = (name, points, x, y, look, more = {}) => ({
  type: "line", name, data: points.map(([px, py]) => [x.at(px), y.at(py)]), symbol: "none", silent: true,
  lineStyle: { color: look.colour, type: look.dash ?? "solid", width: look.width ?? 1.5 }, ...more,
});

// ---- Maps: rectangles, which are items with `value: [left, bottom, right, top]` in positions of the axes.

/** The borders between cells: midway between their positions. */
function borders(positions) {
  const middle = positions.slice(1).map((position, i) => (position + positions[i]) / 2);
  if (middle.length === 0) return [positions[0] - 0.5, positions[0] + 0.5];
  return [2 * positions[0] - middle[0], ...middle, 2 * positions.at(-1) - middle.at(-1)];
}

function rectangle(api) {
  const [left, bottom] = api.coord([api.value(0), api.value(1)]);
  const [right, top] = api.coord([api.value(2), api.value(3)]);
  const [x, y] = [Math.round(left), Math.round(top)];  // on whole pixels, so that cells leave no seam
  return { x, y, width: Math.round(right) - x, height: Math.round(bottom) - y };
}

/** Cells; look(cell) gives {fill, sign, ink}. */
const cellSeries = (name, cells, look) => ({
  type: "custom", name, data: cells, progressive: 0, z: 1, encode: { x: [0, 2], y: [1, 3] },
  renderItem: (params, api) => {
    const { fill, sign, ink } = look(cells[params.dataIndex]);
    const shape = rectangle(api);
    const size = Math.min(shape.width, shape.height, 13);
    const box = { type: "rect", shape, style: { fill, stroke: "var(--paper)", lineWidth: size < 7 ? 0 : 0.75 } };
    if (!sign || size < 7) return box;
    return { type: "group", children: [box, {
      type: "text", silent: true,
      style: { text: sign, x: shape.x + shape.width / 2, y: shape.y + shape.height / 2, fill: ink, opacity: 0.75,
               fontSize: size, align: "center", verticalAlign: "middle" } }] };
  },
});

/** Outlines of cells that stand out. */
const outlineSeries = (name, cells) => ({
  type: "custom", id: name, name, data: cells, progressive: 0, z: 4, silent: true,
  encode: { x: [0, 2], y: [1, 3] },
  renderItem: (params, api) => {
    const outline = (stroke, lineWidth) =>
      ({ type: "rect", shape: rectangle(api), style: { fill: "none", stroke, lineWidth } });
    return { type: "group", children: [outline(darkInk, 5), outline(outlineColour, 2.5)] };
  },
});
