"use strict";
// Maps and pictures: one, or golden, run and their difference side by side; then also two of them over one another,
// with a slider that wipes between them.

const sideLabels = new Map();
/** The page's names of golden and run: for two files, their own names. */
const labelOf = (side) => sideLabels.get(side) ?? side;
const titleOf = (side) =>
  `${side[0].toUpperCase()}${side.slice(1)}${sideLabels.has(side) ? `: ${labelOf(side)}` : ""}`;

/** The colour bar of a map. */
const barOf = ({ title, unit, low, high, colours: stops }) =>
  colourBar({ name: withUnit(title, unitText(unit)), low, high, stops,
              ticks: roundTicks(low, high, 5).map((tick) => [tick, tickText(tick)]) });

/** A map that fills its frame. The map of the difference has a ring around its largest value. */
function layer(part, map) {
  const picture = el("img", { src: map.picture, width: map.width, height: map.height, draggable: "false",
                              alt: `${part.title}: ${labelOf(map.name)}` });
  // Cells stay squares where they are larger than a pixel. Where they are smaller, the browser shows their mean.
  new ResizeObserver(() => {
    picture.style.imageRendering = picture.clientWidth > map.width ? "pixelated" : "auto";
  }).observe(picture);
  const ringed = map.name === "difference" && part.largest;
  const { x, y } = part.extent ?? {};
  const fraction = ([from, to], value) => `${(100 * (value - from)) / (to - from)}%`;
  return el("div", { class: "layer" }, picture, ringed
    ? el("div", { class: "ring", title: "the largest difference",
                  style: `left: ${fraction(x, part.largest.x)}; bottom: ${fraction(y, part.largest.y)}` })
    : null);
}

/** Gives the values under the pointer: a function of the position, as fractions of width and height from the upper left. */
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
      `${labelOf("golden")} ${inUnit(golden[spot], scale)}, ` +
      `${labelOf("run")} ${inUnit(golden[spot] + difference[spot], scale)}, ` +
      `difference ${inUnit(difference[spot], finer)}`;
  };
}

/** Layers over one another, and a line with the values under the pointer. */
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
  const difference = `Difference: ${labelOf("run")} − ${labelOf("golden")}`;
  return el("figure", {}, el("figcaption", {}, map.name === "difference" ? difference : titleOf(map.name),
                             map.text ? el("small", {}, map.text) : null),
            element, map.scale ? barOf(map.scale) : null, readout);
};

/** Two maps over one another, left and right of an edge. A slider or the pointer moves the edge. */
function wipe(part) {
  const named = new Map(part.maps.map((map) => [map.name, map]));
  const pairs = [["golden", "run"], ["golden", "difference"], ["run", "difference"]];
  const layers = el("div", { class: "layer" });
  const edge = el("div", { class: "edge" });
  const tags = [el("span", { class: "tag" }), el("span", { class: "tag right" })];
  const scales = el("div", { class: "charts" });
  const slider = el("input", { type: "range", min: 0, max: 100, step: "any", value: 50, input: () => move() });
  const size = part.maps[0];
  const { element, readout } = stage(part, size, layers, edge, ...tags);

  let pair = pairs[0];
  const move = () => {
    const fraction = Number(slider.value);
    edge.style.left = `${fraction}%`;
    layers.lastChild.style.clipPath = `inset(0 0 0 ${fraction}%)`;
    slider.setAttribute("aria-valuetext",
                        `${labelOf(pair[0])} on the left ${Math.round(fraction)} %, ${labelOf(pair[1])} on the right`);
  };
  const choose = (chosen) => {
    pair = chosen;
    layers.replaceChildren(...pair.map((name) => layer(part, named.get(name))));
    tags.forEach((tag, i) => { tag.textContent = labelOf(pair[i]); });
    const seen = [...new Map(pair.map((name) => named.get(name).scale).filter(Boolean).map((one) => [one.title, one]))
      .values()];
    scales.replaceChildren(...seen.map(barOf));
    slider.setAttribute("aria-label", `Wipe between ${pair.map(labelOf).join(" and ")}`);
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
                    ...pairs.map((names, i) => el("option", { value: i }, names.map(labelOf).join(" and "))));
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
