"use strict";
// A comparison: the outcome and its checks; maps of golden, run and difference, with a slider that wipes between
// two of them; traces over time; and what is known about the files.

const unitText = (unit) => unit.replace(/^um$/, "µm");
const valueWithUnit = (value, unit) => format(value) + (unit === "" || unit.startsWith("/") ? "" : "\u00a0") + unit;
const lookOfSide = { golden: { colour: colours[0] }, run: { colour: colours[1], dash: "dashed" } };

// ---- Maps.

/** What the colours of a map mean. */
function colourScale({ title, unit, low, high, colours: steps }) {
  const place = (value) => `${(100 * (value - low)) / (high - low)}%`;
  return el("div", { class: "scale" },
            el("div", { class: "bar", style: `background: linear-gradient(to right, ${steps.join(", ")})` }),
            el("div", { class: "marks" }, ...roundTicks(low, high, 5).map((tick) =>
              el("span", { style: `left: ${place(tick)}` }, tickText(tick)))),
            el("div", {}, withUnit(title, unitText(unit))));
}

/** A map, which fills its place, with a ring around the largest difference where it shows that. */
function layer(part, map) {
  const picture = el("img", { src: map.picture, width: map.width, height: map.height, draggable: "false",
                              alt: `${part.title}: ${map.name}` });
  // Cells stay squares where they are larger than a pixel; the browser's mean shows them where smaller.
  new ResizeObserver(() => {
    picture.style.imageRendering = picture.clientWidth > map.width ? "pixelated" : "auto";
  }).observe(picture);
  const ringed = map.name === "difference" && part.largest;
  const { x, y } = part.extent ?? {};
  const share = ([from, to], value) => `${(100 * (value - from)) / (to - from)}%`;
  return el("div", { class: "layer" }, picture, ringed
    ? el("div", { class: "ring", title: "the largest difference",
                  style: `left: ${share(x, part.largest.x)}; bottom: ${share(y, part.largest.y)}` })
    : null);
}

/** The values under the pointer: a function of the place, as shares of width and height from the upper left. */
function reader(part) {
  if (!part.spots) return null;
  const floats = (text) => {
    const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
    const view = new DataView(bytes.buffer);
    return Float32Array.from({ length: bytes.length / 4 }, (_, i) => view.getFloat32(4 * i, true));
  };
  const { side, cols, cells } = part.spots;
  const golden = floats(part.spots.golden), difference = floats(part.spots.difference);
  const [{ scale }, , { scale: finer }] = part.maps;
  const inUnit = (value, { one, unit }) => `${format(value / one, false)} ${unitText(unit)}`;
  const metres = ([from, to], at) => `${format(Number((from + at * (to - from)).toPrecision(4)), false)} m`;
  return (right, down) => {
    const row = Math.floor(((1 - down) * cells[0]) / side), col = Math.floor((right * cells[1]) / side);
    const spot = row * cols + col;
    if (!(spot >= 0 && spot < golden.length)) return "";
    return `x ${metres(part.extent.x, right)}, y ${metres(part.extent.y, 1 - down)}: ` +
      `golden ${inUnit(golden[spot], scale)}, run ${inUnit(golden[spot] + difference[spot], scale)}, ` +
      `difference ${inUnit(difference[spot], finer)}`;
  };
}

/** Layers over one another, and a line that says the values under the pointer. */
function stage(part, map, ...layers) {
  const read = reader(part);
  const readout = el("p", { class: "readout quiet" });
  const show = (event) => {
    const { left, top, width, height } = element.getBoundingClientRect();
    readout.textContent = read((event.clientX - left) / width, (event.clientY - top) / height);
  };
  const element = el("div", {
    class: "stage", style: `aspect-ratio: ${map.width} / ${map.height}`, pointermove: read && show,
    pointerleave: () => { readout.textContent = ""; },
  }, ...layers);
  return { element, readout: read ? readout : null };
}

const mapFigure = (part, map) => {
  const { element, readout } = stage(part, map, layer(part, map));
  return el("figure", {}, el("figcaption", {}, map.name[0].toUpperCase() + map.name.slice(1),
                             map.text ? el("small", {}, map.text) : null),
            element, map.scale ? colourScale(map.scale) : null, readout);
};

/** Two maps over one another: the first left of an edge, which a slider or the pointer moves, the other right. */
function wipe(part) {
  const named = new Map(part.maps.map((map) => [map.name, map]));
  const pairs = [["golden", "run"], ["golden", "difference"], ["run", "difference"]];
  const places = el("div", { class: "layer" });
  const edge = el("div", { class: "edge" });
  const tags = [el("span", { class: "tag" }), el("span", { class: "tag right" })];
  const scales = el("div", { class: "charts" });
  const slider = el("input", { type: "range", min: 0, max: 100, step: "any", value: 50, input: () => move() });
  const size = part.maps[0];
  const { element, readout } = stage(part, size, places, edge, ...tags);

  let pair = pairs[0];
  const move = () => {
    const share = Number(slider.value);
    edge.style.left = `${share}%`;
    places.lastChild.style.clipPath = `inset(0 0 0 ${share}%)`;
    slider.setAttribute("aria-valuetext", `${pair[0]} on the left ${Math.round(share)} %, ${pair[1]} on the right`);
  };
  const choose = (chosen) => {
    pair = chosen;
    places.replaceChildren(...pair.map((name) => layer(part, named.get(name))));
    tags.forEach((tag, i) => { tag.textContent = pair[i]; });
    const seen = [...new Map(pair.map((name) => named.get(name).scale).filter(Boolean).map((one) => [one.title, one]))
      .values()];
    scales.replaceChildren(...seen.map(colourScale));
    slider.setAttribute("aria-label", `Wipe between ${pair.join(" and ")}`);
    move();
  };
  const follow = (event) => {
    const { left, width } = element.getBoundingClientRect();
    slider.value = (100 * (event.clientX - left)) / width;
    move();
  };
  element.classList.add("wipe");
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    slider.focus({ preventScroll: true });
    event.preventDefault();
    follow(event);
  });
  element.addEventListener("pointermove", (event) => {
    if (element.hasPointerCapture(event.pointerId)) follow(event);
  });
  choose(pair);
  const choice = el("select", { change: (event) => choose(pairs[Number(event.target.value)]) },
                    ...pairs.map((names, i) => el("option", { value: i }, names.join(" and "))));
  const most = size.scale ? `calc(44rem * ${size.width / size.height})` : `${size.width}px`;
  return el("figure", {},
            el("div", { class: "controls" }, el("label", {}, "Wipe between ", choice),
               el("span", { class: "quiet" }, "Drag the edge, or move the slider with the arrow keys.")),
            el("div", { class: "narrow", style: `max-width: ${most}` }, element, slider), readout, scales);
}

function drawMaps(part) {
  const [{ width, height }] = part.maps;
  const aligned = part.maps.length === 3;
  const layout = !aligned ? "charts" : width > 1.5 * height ? "charts wide" : "charts three";
  return [el("p", {}, part.text), aligned ? wipe(part) : null,
          el("div", { class: layout }, ...part.maps.map((map) => mapFigure(part, map)))];
}

// ---- Traces.

const lookOfDifference = { colour: colours[2] };

/**
 * A chart of curves over time: {name, look, curve}. `limit`: a band around zero that it holds, if any. Its
 * show(from, to) zooms to a stretch of time [s], with round ticks, and heights that fit what is in sight.
 */
function timeChart({ title, note, legend, whole }) {
  let shown = { curves: [], quantity: "", unit: "", limit: null };
  const look = { height: "17rem", title, note, legend };
  const axes = (from, to) => {
    const inSight = shown.curves.flatMap(({ curve: { time, value } }) => {
      const after = time.findIndex((t) => t >= from), before = time.findLastIndex((t) => t <= to);
      return value.slice(Math.max(0, after - 1), before + 2);
    });
    const x = scaleOf([from, to], { margin: 0, title: "time", unit: "s" });
    const y = scaleOf(shown.limit === null ? inSight : [...inSight, -shown.limit, shown.limit],
                      { title: shown.quantity, unit: shown.unit });
    return { xAxis: { ...x.axis, min: whole[0], max: whole[1] }, yAxis: { ...y.axis, nameGap: 62 } };
  };
  const series = () => shown.curves.map(({ name, look: own, curve }, i) => ({
    type: "line", name, symbol: "none", data: curve.time.map((t, k) => [t, curve.value[k]]),
    lineStyle: { color: own.colour, type: own.dash ?? "solid", width: 1.5 }, itemStyle: { color: own.colour },
    markArea: i > 0 || shown.limit === null ? undefined
      : { silent: true, itemStyle: { color: "#009e73", opacity: 0.14 },
          data: [[{ yAxis: -shown.limit }, { yAxis: shown.limit }]] },
  }));
  const tip = (items) => tipOf(`${format(items[0].value[0])} s`,
                               items.map(({ seriesName, value }) => [withUnit(seriesName, shown.unit), value[1]]));
  const option = {
    ...chartBase(() => null),
    grid: { left: 88, right: 26, top: 14, bottom: 48 },
    tooltip: { trigger: "axis", confine: true, formatter: tip, axisPointer: { animation: false } },
    dataZoom: [{ type: "inside", filterMode: "none", zoomOnMouseWheel: "ctrl", moveOnMouseWheel: false }],
  };
  const element = chart({ ...look, option });
  const one = charts.at(-1);
  const update = (change) => (one.drawn ? one.drawn.setOption(change) : Object.assign(option, change));
  return {
    element, one,
    draw: (content) => {
      shown = content;
      update({ ...axes(...whole), series: series() });
    },
    show: (from, to) => {
      const share = (t) => (100 * (t - whole[0])) / (whole[1] - whole[0]);
      update({ ...axes(from, to), dataZoom: [{ start: share(from), end: share(to) }] });
    },
  };
}

/** Two charts of the quantities of a group, one of which is chosen: golden and run, and how far they are apart. */
function groupCharts(group, quantities, whole) {
  const sides = ["golden", "run"].filter((name) => quantities[0][name]);
  const values = timeChart({
    title: group, whole, legend: sides.map((name) => ({ name, series: true, ...lookOfSide[name] })) });
  const apart = quantities[0].difference && timeChart({
    title: `${group}: difference`, whole,
    note: "run − golden, tick by tick" +
      (quantities.some(({ name }) => name === "magnitude") ? "; of the magnitude, the length of the difference." : "."),
    legend: [{ name: "difference", ...lookOfDifference, dash: "solid" },
             { name: "limit", text: "within the limit", fill: "#dff2ec" }],
  });
  const choose = (quantity) => {
    const { name, unit, limit } = quantity;
    values.draw({ quantity: name, unit, limit: null,
                  curves: sides.map((side) => ({ name: side, look: lookOfSide[side], curve: quantity[side] })) });
    apart?.draw({ quantity: name, unit, limit,
                  curves: [{ name: "difference", look: lookOfDifference, curve: quantity.difference }] });
  };
  choose(quantities[0]);
  return { charts: [values, apart].filter(Boolean), names: quantities.map(({ name }) => name),
           choose: (i) => choose(quantities[i]) };
}

/** Charts that zoom alike: by buttons, and whichever of them the pointer zooms. */
function zoomTogether(timeCharts, whole) {
  let [from, to] = whole;
  const show = (start, end) => {
    const width = Math.min(end - start, whole[1] - whole[0]);
    from = Math.max(whole[0], Math.min(start, whole[1] - width));
    to = from + width;
    timeCharts.forEach((one) => one.show(from, to));
  };
  const about = (factor) => () =>
    show((from + to) / 2 - (factor * (to - from)) / 2, (from + to) / 2 + (factor * (to - from)) / 2);
  const by = (share) => () => show(from + share * (to - from), to + share * (to - from));
  const button = (text, label, click) =>
    el("button", { type: "button", "aria-label": label, title: label, click }, text);
  return {
    buttons: el("span", { class: "buttons", role: "group", "aria-label": "Zoom over time" },
                button("+", "zoom in", about(0.5)), button("−", "zoom out", about(2)),
                button("←", "earlier", by(-0.5)), button("→", "later", by(0.5)),
                button("whole", "all of the time", () => show(...whole))),
    again: () => show(from, to),
    listen: () => timeCharts.forEach(({ one }) => one.drawn.on("datazoom", (event) => {
      const { start, end } = event.batch?.[0] ?? event;
      const at = (share) => whole[0] + (share / 100) * (whole[1] - whole[0]);
      show(at(start), at(end));
    })),
  };
}

let afterDrawing = () => {};

function drawTraces(part) {
  const ends = part.quantities.flatMap(({ golden, run }) => [golden, run].filter(Boolean))
    .flatMap(({ time }) => [time[0], time.at(-1)]).filter(isNumber);
  if (ends.length === 0) return [el("p", {}, part.text)];
  const first = Math.min(...ends), whole = [first, Math.max(...ends, first + 1e-9)];
  const groups = [...new Set(part.quantities.map(({ group }) => group))].map((name) =>
    ({ name, ...groupCharts(name, part.quantities.filter(({ group }) => group === name), whole) }));
  const all = groups.flatMap((group) => group.charts);
  const zoom = zoomTogether(all, whole);
  afterDrawing = zoom.listen;
  const choiceOf = ({ name, names, choose }) => el("label", {}, `${name} `, el("select", {
    change: (event) => {
      choose(Number(event.target.value));
      zoom.again();
    } }, ...names.map((one, i) => el("option", { value: i }, one))));
  return [el("p", {}, part.text),
          el("div", { class: "controls" }, ...groups.map(choiceOf), el("span", {}, "Zoom ", zoom.buttons)),
          el("p", { class: "quiet" }, "The wheel of the mouse with Ctrl zooms as well, and dragging moves."),
          el("div", { class: "charts single" }, ...all.map(({ element }) => element))];
}

// ---- The files.

/** The settings of a resolved scene, as "section.key" and value. */
function settingsOf(scene) {
  let section = "";
  const settings = new Map();
  for (const line of scene.split("\n")) {
    const head = /^\[(.*)\]$/.exec(line), entry = /^(\S+) = (.*)$/.exec(line);
    if (head) section = `${head[1]}.`;
    else if (entry) settings.set(section + entry[1], entry[2]);
  }
  return settings;
}

/** Rows of what golden and run say, from two maps. */
const rowsOf = (golden, run) => [...new Set([...golden.keys(), ...run.keys()])].map((name) =>
  ({ name, golden: golden.get(name) ?? null, run: run.get(name) ?? null }));

function sideTable(rows, title, label) {
  return table([{ name: "name", title }, { name: "golden", title: "Golden" }, { name: "run", title: "Run" }],
               rows, { label, rowClass: (row) => (row.name !== "file" && row.golden !== row.run ? "surprise" : null) })
    .element;
}

function drawFiles({ golden, run }) {
  const parts = [sideTable(rowsOf(new Map([["file", golden.name], ...golden.provenance]),
                                  new Map([["file", run.name], ...run.provenance])), "Entry", "Files")];
  if (golden.scene && run.scene) {
    const changed = rowsOf(settingsOf(golden.scene), settingsOf(run.scene)).filter((row) => row.golden !== row.run);
    parts.push(changed.length ? el("h3", {}, "Settings that differ") : el("p", {}, "The scenes have the same settings."),
               changed.length ? sideTable(changed, "Setting", "Settings that differ") : null);
  }
  return parts;
}

// ---- The page.

function checkTable(checks) {
  const failedFirst = [...checks].sort((a, b) => a.passed - b.passed);
  return table([
    { name: "name", title: "Check" },
    { name: "passed", title: "Verdict", value: (check) => (check.passed ? "holds" : "failed"),
      cell: (check) => el("span", { class: check.passed ? "good" : "bad" }, check.passed ? "holds" : "failed") },
    { name: "measured", title: "Measured", cell: (check) => format(check.measured) },
    { name: "limit", title: "Limit", cell: (check) => format(check.limit) }, { name: "unit", title: "Unit" },
    { name: "sentence", title: "What was found" },
  ], failedFirst, { label: "Checks", rowClass: (check) => (check.passed ? null : "surprise") }).element;
}

drawPage((data, main) => {
  const { checks, parts, missing } = data;
  const failed = checks.filter((check) => !check.passed);
  const fact = (name, value, kind = null) => el("div", {}, el("dt", {}, name), el("dd", { class: kind }, value));
  const measured = ["final height", "height change", "force", "picture"]
    .map((name) => checks.find((check) => check.name === name)).filter((check) => check && isNumber(check.measured));
  main.append(
    el("h1", {}, document.title), machineLine(data.machine),
    el("dl", { class: "facts" },
       fact("Verdict", data.passed ? "equal" : "different", data.passed ? "good" : "bad"),
       fact("Failed checks", `${failed.length} of ${checks.length}`, failed.length ? "bad" : "good"),
       ...measured.map((check) => fact(`Largest difference: ${check.name}`, valueWithUnit(check.measured, check.unit),
                                       check.passed ? null : "bad"))),
    ...missing.map(({ name, sentence }) => el("p", { class: "warning" }, el("strong", {}, `${name} is not shown`),
                                              `: ${sentence}`)),
    data.passed ? el("p", {}, "All differences are within their limits.") : "");
  const kinds = { maps: drawMaps, traces: drawTraces };
  const sections = [
    ["checks", "Checks", () => [checkTable(checks)]],
    ...parts.map((part, i) => [`part-${i + 1}`, part.title, () => kinds[part.kind](part)]),
    ["files", "Files", () => drawFiles(data)],
  ];
  main.append(contents(sections));
  for (const [id, title, draw] of sections)
    main.append(el("section", { id }, el("h2", {}, title), ...draw().filter(Boolean)));
});
afterDrawing();
