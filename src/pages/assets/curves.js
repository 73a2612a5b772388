"use strict";
// Curves: traces of golden and run over time and their difference, in charts that zoom together; and profiles of the
// sand along a way.

const lookOfSide = { golden: { colour: colours[0] }, run: { colour: colours[1], dash: "dashed" },
                     recorded: { colour: neutral, dash: "dotted" } };
const lookOfDifference = { colour: colours[2] };
const lookOfSurface = { initial: { colour: neutral, dash: "dashed" }, last: { colour: colours[0] } };

const overTime = { title: "time", unit: "s" };

/**
 * A chart of curves {name, look, curve: {at, value}} over time or a way (`over`). `limit`, if any, draws a band around
 * zero. Its show(from, to) zooms to a stretch, with round ticks, and a height that fits what is in sight.
 */
function curveChart({ title, note, legend, whole, over }) {
  let shown = { curves: [], quantity: "", unit: "", limit: null };
  const axes = (from, to) => {
    const inSight = shown.curves.flatMap(({ curve: { at, value } }) => {
      const after = at.findIndex((t) => t >= from), before = at.findLastIndex((t) => t <= to);
      return value.slice(Math.max(0, after - 1), before + 2);
    });
    const x = scaleOf([from, to], { margin: 0, ...over });
    const y = scaleOf(shown.limit === null ? inSight : [...inSight, -shown.limit, shown.limit],
                      { title: shown.quantity, unit: shown.unit });
    return { xAxis: { ...x.axis, min: whole[0], max: whole[1] }, yAxis: { ...y.axis, nameGap: 62 } };
  };
  const series = () => shown.curves.map(({ name, look: own, curve }, i) => ({
    type: "line", name, symbol: "none", data: curve.at.map((t, k) => [t, curve.value[k]]),
    ...lineStyles({ ...own, width: 1.5 }),
    markArea: i > 0 || shown.limit === null ? undefined
      : { silent: true, itemStyle: { color: "var(--within)" },
          data: [[{ yAxis: -shown.limit }, { yAxis: shown.limit }]] },
  }));
  const tip = (items) => tipOf(`${format(items[0].value[0])} ${over.unit}`,
                               items.map(({ seriesName, value }) => [withUnit(seriesName, shown.unit), value[1]]));
  const option = {
    ...chartBase(() => null),
    grid: { left: 88, right: 26, top: 14, bottom: 48 },
    tooltip: { trigger: "axis", ...tipLook, formatter: tip, axisPointer: { animation: false } },
    dataZoom: [{ type: "inside", filterMode: "none", zoomOnMouseWheel: "ctrl", moveOnMouseWheel: false }],
  };
  const element = chart({ title, note, legend, option, height: "17rem" });
  const one = charts.at(-1);
  const update = (change) => (one.drawn ? one.drawn.setOption(change) : Object.assign(option, change));
  return {
    element, one,
    draw: (content) => {
      shown = content;
      update({ ...axes(...whole), series: series() });
    },
    show: (from, to) => {
      const fraction = (t) => (100 * (t - whole[0])) / (whole[1] - whole[0]);
      update({ ...axes(from, to), dataZoom: [{ start: fraction(from), end: fraction(to) }] });
    },
  };
}

/**
 * Two charts of a group of quantities, one of which is chosen. One shows golden, run and what was recorded with the
 * stroke; the other shows the difference of golden and run.
 */
function groupCharts(group, quantities, whole) {
  const sides = ["golden", "run", "recorded"].filter((name) => quantities[0][name]);
  const lookOf = (name) => (sides.includes("golden") || name === "recorded" ? lookOfSide[name] : { colour: lookOfSide[name].colour });
  const values = curveChart({
    title: group, whole, over: overTime, legend: sides.map((side) => ({ name: labelOf(side), series: true, ...lookOf(side) })) });
  const apart = quantities[0].difference && curveChart({
    title: `${group}: difference`, whole, over: overTime,
    note: `${labelOf("run")} − ${labelOf("golden")}, tick by tick` +
      (quantities.some(({ name }) => name === "magnitude")
        ? "; for the magnitude, the length of the difference vector." : "."),
    legend: [{ name: "difference", ...lookOfDifference, dash: "solid" },
             { name: "limit", text: "within the limit", fill: "var(--within)" }],
  });
  const choose = (quantity) => {
    const { name, unit, limit } = quantity;
    values.draw({ quantity: name, unit, limit: null,
                  curves: sides.map((side) => ({ name: labelOf(side), look: lookOf(side), curve: quantity[side] })) });
    apart?.draw({ quantity: name, unit, limit,
                  curves: [{ name: "difference", look: lookOfDifference, curve: quantity.difference }] });
  };
  choose(quantities[0]);
  return { charts: [values, apart].filter(Boolean), names: quantities.map(({ name }) => name),
           choose: (i) => choose(quantities[i]) };
}

/** Charts that zoom together: by buttons, or when the pointer zooms one of them. */
function zoomTogether(curveCharts, whole) {
  let [from, to] = whole;
  const show = (start, end) => {
    const width = Math.min(end - start, whole[1] - whole[0]);
    from = Math.max(whole[0], Math.min(start, whole[1] - width));
    to = from + width;
    curveCharts.forEach((one) => one.show(from, to));
  };
  const about = (factor) => () =>
    show((from + to) / 2 - (factor * (to - from)) / 2, (from + to) / 2 + (factor * (to - from)) / 2);
  const by = (fraction) => () => show(from + fraction * (to - from), to + fraction * (to - from));
  const button = (text, label, click) =>
    el("button", { type: "button", "aria-label": label, title: label, click }, text);
  return {
    buttons: el("span", { class: "buttons", role: "group", "aria-label": "Zoom over time" },
                button("+", "zoom in", about(0.5)), button("−", "zoom out", about(2)),
                button("←", "earlier", by(-0.5)), button("→", "later", by(0.5)),
                button("whole", "show the whole time", () => show(...whole))),
    again: () => show(from, to),
    listen: () => curveCharts.forEach(({ one }) => one.drawn.on("datazoom", (event) => {
      const { start, end } = event.batch?.[0] ?? event;
      const at = (fraction) => whole[0] + (fraction / 100) * (whole[1] - whole[0]);
      show(at(start), at(end));
    })),
  };
}

let afterDrawing = () => {};

function drawTraces(part) {
  const ends = part.quantities.flatMap(({ golden, run }) => [golden, run].filter(Boolean))
    .flatMap(({ at }) => [at[0], at.at(-1)]).filter(isNumber);
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
          el("div", { class: "controls" }, ...groups.filter(({ names }) => names.length > 1).map(choiceOf), el("span", {}, "Zoom ", zoom.buttons)),
          el("p", { class: "quiet" }, "Ctrl and the mouse wheel zoom as well, and dragging moves the curves."),
          el("div", { class: "charts single" }, ...all.map(({ element }) => element))];
}

/** Heights of the initial and the last surface along a way through the bed. */
function drawProfiles(part) {
  const drawn = part.profiles.map(({ title, note, over, last, curves }) => {
    const sides = Object.keys(curves), ends = curves.initial.at;
    const chartOf = curveChart({ title, note, over: { title: over, unit: "m" }, whole: [ends[0], ends.at(-1)],
                             legend: sides.map((name) => ({ name, text: name === "last" ? last : name, series: true,
                                                            ...lookOfSurface[name] })) });
    const inMillimetres = ({ at, value }) => ({ at, value: value.map((one) => (isNumber(one) ? 1e3 * one : one)) });
    chartOf.draw({ quantity: "height", unit: "mm", limit: null, curves: sides.map((name) =>
      ({ name, look: lookOfSurface[name], curve: inMillimetres(curves[name]) })) });
    return chartOf.element;
  });
  return [el("p", {}, part.text), el("div", { class: "charts single" }, ...drawn)];
}
