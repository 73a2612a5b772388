"use strict";
// The charts of a sweep's report: a metric along an axis as lines, over two axes as a map, and the scattered points of
// a Latin hypercube. In each, points without a value have a position and a sign.

const cross = "M0.5 2l1.5-1.5 3 3 3-3 1.5 1.5-3 3 3 3-1.5 1.5-3-3-3 3-1.5-1.5 3-3z";
// The look of a verdict in maps. `mark` is its symbol where a point has no value because of it.
const verdicts = new Map([
  ["at rest", { ...verdictLooks.fine, sign: "" }],
  ["not at rest", { ...verdictLooks.restless, sign: "~" }],
  ["active", { ...verdictLooks.worse, sign: "!" }],
  ["unstable", { ...verdictLooks.lost, sign: "×", mark: { colour: "var(--bad)", symbol: cross } }],
  ["refused", { fill: "#9aa3aa", sign: "–", ink: darkInk, mark: { colour: "var(--quiet)", symbol: symbols[1] } }],
  ["missing", { fill: "#eceff1", sign: "?", ink: darkInk,
                mark: { colour: "var(--quiet)", symbol: symbols[0], hollow: true } }],
]);
const noValue = { fill: lightInk, sign: "∅", ink: darkInk,
                  mark: { colour: "var(--quiet)", symbol: symbols[4], hollow: true } };
const lookOfVerdict = (name) => verdicts.get(name) ?? noValue;
/** Why a point has no value of a metric: its verdict, where that is the reason. */
const nameWithout = ({ verdict }) => (lookOfVerdict(verdict).mark && verdicts.has(verdict) ? verdict : "no value");
const lookWithout = (point) => lookOfVerdict(nameWithout(point));
const isDoubtful = ({ verdict }) => verdict === "not at rest" || verdict === "active";
const manyItems = 1500;

/** An axis with the position of its i-th value, the order of its values, and their text. */
function prepareAxis(axis) {
  const { name, unit, values } = axis;
  const numeric = axis.numeric && values.every(isNumber);
  const logarithmic = numeric && axis.log && values.every((value) => value > 0);
  const position = (i) => (numeric ? (logarithmic ? Math.log10(values[i]) : values[i]) : i);
  const order = values.map((_, i) => i).sort((a, b) => position(a) - position(b));
  const rank = [];
  order.forEach((i, k) => { rank[i] = k; });
  const text = (i) => (numeric ? exact(values[i]) : String(values[i] ?? "–"));
  const scale = (margin) => (numeric
    ? { ...scaleOf(values, { logarithmic, margin, title: name, unit }), at: position }
    : nameScale(values.map(String), { title: withUnit(name, unit) }));
  /** The scale on which the cell of the i-th value reaches from edges[i][0] to edges[i][1]. */
  const cells = () => {
    const found = borders(order.map(position));
    const back = (at) => (logarithmic ? 10 ** at : at);
    return {
      ...(numeric ? scaleOf(found.map(back), { logarithmic, margin: 0, title: name, unit }) : scale()),
      edges: values.map((_, i) => [found[rank[i]], found[rank[i] + 1]]),
    };
  };
  return { ...axis, numeric, logarithmic, position, order, rank, text, scale, cells };
}

/** The points that a view shows: those that have the selected point's values of the `fixed` axes. */
function sliceOf({ axes, points, latin }, view) {
  const fixed = latin ? [] : axes.map((_, i) => i).filter((i) => i !== view.x && i !== view.second);
  return { fixed, shown: points.filter(({ at }) => fixed.every((i) => at[i] === view.at[i])) };
}

/**
 * The basis of all charts of a view: its points, the metric's scale over them (over the whole sweep they may differ by
 * less than one sees), the tooltip, and the legend of the points without a value.
 */
function viewOf(sweep, view) {
  const { axes, metrics } = sweep;
  const metric = metrics[view.metric];
  const [x, second] = [axes[view.x], axes[view.second]];
  const valueOf = (point) => point.metrics[view.metric] ?? null;
  const { fixed, shown } = sliceOf(sweep, view);
  const values = shown.map(valueOf).filter(isNumber);
  const scaled = (margin) =>
    scaleOf(values, { logarithmic: view.log, margin, title: metric.title, unit: metric.unit });
  const tip = (item) => {
    const point = item.data?.point;
    return point && tipOf(`point ${point.point}: ${point.verdict}`, [
      ...axes.map((axis, i) => [withUnit(axis.name, axis.unit), axis.text(point.at[i])]),
      [withUnit(metric.title, metric.unit), valueOf(point)],
      ...(point.reason ? [["reason", point.reason]] : [])]);
  };
  const without = shown.filter((point) => !isNumber(valueOf(point)));
  const legend = [...new Set(without.map(nameWithout))].map((name) => {
    const own = without.filter((point) => nameWithout(point) === name);
    return { name, text: `${name}: ${count(own.length, "point")}`, ...lookWithout(own[0]) };
  });
  const fixedTexts = fixed.map((i) => `${axes[i].name} = ${axes[i].text(view.at[i])} ${axes[i].unit}`.trim());
  const note = [fixedTexts.length > 0 && `At ${fixedTexts.join(", ")}.`,
                without.length === shown.length && "No point here has a value of this metric."]
    .filter(Boolean).join(" ") || null;
  return { metric, x, second, valueOf, shown, without, scaled, tip, legend, note };
}

/** An entry of the legend for points that are symbols. */
const marked = ({ name, text, mark }) => ({ name, text, ...mark, dash: "none" });

/** An entry of the legend for hollow symbols, or heavy edges, where there are any. */
const doubtfulEntry = (points, how) => (points.some(isDoubtful)
  ? [{ name: "doubtful", text: `${how}: not at rest, or active`, colour: neutral, symbol: symbols[0], hollow: true,
       dash: "none" }] : []);

/** Makes room below a scale's values for signs, one above the other. */
const addGround = (y, signs) => { y.low = y.axis.min -= (y.high - y.low) * (0.02 + 0.045 * signs); };

/** The ring around the selected point, among symbols. */
const ring = (data) => ({
  type: "scatter", id: "selected", name: "selected", silent: true, z: 6, data, symbol: outlined(symbols[0]),
  symbolSize: 17, itemStyle: { color: "none", borderColor: "var(--ink)", borderWidth: 2.5 },
});

/** Symbols of points that have no value, at position(point). */
const signSeries = (points, position, offset = () => 0) =>
  points.map((point) => {
    const { symbol, colour, hollow } = lookWithout(point).mark;
    return { point, value: position(point), symbol: outlined(symbol), symbolOffset: [0, offset(point)],
             itemStyle: { color: hollow ? "var(--paper)" : colour, borderColor: colour, borderWidth: hollow ? 1.75 : 0 } };
  });

/** The metric along one axis; a line for each value of a second one. Points without a value lie at the bottom. */
function linesChart(sweep, view) {
  const { metric, x, second, valueOf, shown, without, scaled, tip, legend, note } = viewOf(sweep, view);
  const xScale = x.scale(), y = scaled(0.08);
  // Signs stand one above the other where lines lack a value at the same position, in room of their own.
  const height = new Map(), steps = new Map();
  for (const point of without) {
    const step = steps.get(point.at[view.x]) ?? 0;
    steps.set(point.at[view.x], step + 1);
    height.set(point, -8 - 12 * (step % 6));
  }
  if (without.length > 0) addGround(y, Math.min(6, Math.max(...steps.values())));
  const families = (second?.order ?? [null]).map((i) => ({
    name: `line ${i}`, text: second?.text(i),
    points: shown.filter(({ at }) => i === null || at[view.second] === i)
      .sort((a, b) => x.rank[a.at[view.x]] - x.rank[b.at[view.x]]),
  })).filter(({ points }) => points.length > 0);
  // Colours of the ramp, where lines have an order and are more than the colours.
  const graded = second?.numeric && families.length > colours.length;
  const bar = graded && families.length > 2 * colours.length;
  const graduation = [0.22, 0.76];  // of the ramp: the rest is lost on light or dark paper
  const grade = (i) => ramp(graduation[0] + (graduation[1] - graduation[0]) * (i / (families.length - 1)));
  const looks = families.map((_, i) => (graded ? { ...lookOf(i), colour: grade(i), dash: "solid" } : lookOf(i)));
  const symbolSize = shown.length > 400 ? 4 : 8;
  const lines = families.map(({ name, points }, i) => ({
    type: "line", name, symbol: outlined(looks[i].symbol), symbolSize, showAllSymbol: true,
    ...lineStyles(looks[i]),
    data: points.map((point) => ({
      point, value: [xScale.at(point.at[view.x]), y.at(valueOf(point))],
      ...(isDoubtful(point) ? { itemStyle: { color: "var(--paper)", borderColor: looks[i].colour, borderWidth: 2 } } : {}),
    })),
  }));
  const signs = {
    type: "scatter", name: "without", symbolSize: 9, z: 5, clip: false,
    data: signSeries(without, (point) => [xScale.at(point.at[view.x]), y.low], (point) => height.get(point)),
  };
  const position = (point) => (isNumber(valueOf(point))
    ? { value: [xScale.at(point.at[view.x]), y.at(valueOf(point))] }
    : { value: [xScale.at(point.at[view.x]), y.low], symbolOffset: [0, height.get(point) ?? -8] });
  return {
    mark: (point) => [ring(point ? [{ point, ...position(point) }] : [])],
    title: `${metric.title} along ${x.name}`, note, many: shown.length > manyItems,
    bar: bar ? rampBar(second.scale(0), ...graduation) : null,
    legend: [
      ...(second && !bar ? [{ name: `${withUnit(second.name, second.unit)}:` },
                            ...families.map(({ name, text }, i) => ({ name, text, ...looks[i], series: true }))] : []),
      ...doubtfulEntry(shown, "hollow"), ...legend.map(marked),
    ],
    option: { ...chartBase(tip), xAxis: xScale.axis, yAxis: { ...y.axis, nameGap: 46 },
              series: [...lines, signs, ring([])] },
  };
}

/** The metric over two axes: a cell for each pair of their values. */
function mapChart(sweep, view) {
  const { metric, x, second, valueOf, shown, scaled, tip, legend, note } = viewOf(sweep, view);
  const [xCells, yCells] = [x.cells(), second.cells()], scale = scaled(0);
  const cellOf = (point) => {
    const [left, right] = xCells.edges[point.at[view.x]], [bottom, top] = yCells.edges[point.at[view.second]];
    return { point, value: [left, bottom, right, top] };
  };
  const look = ({ point }) => {
    if (!isNumber(valueOf(point))) return lookWithout(point);
    const fraction = fractionOf(scale, valueOf(point));
    const sign = isDoubtful(point) ? lookOfVerdict(point.verdict).sign : "";
    return { fill: ramp(fraction), sign, ink: rampInk(fraction) };
  };
  const doubtful = [...new Set(shown.filter(isDoubtful).map(({ verdict }) => verdict))].map((name) =>
    ({ name, ...lookOfVerdict(name), fill: "var(--paper)", ink: "var(--ink)" }));
  return {
    mark: (point) => [outlineSeries("selected", point ? [cellOf(point)] : [])],
    title: `${metric.title} over ${x.name} and ${second.name}`, note, many: shown.length > manyItems,
    bar: rampBar(scale), legend: [...doubtful, ...legend], height: "26rem",
    option: { ...chartBase(tip), xAxis: { ...xCells.axis, splitLine: { show: false } },
              yAxis: { ...yCells.axis, nameGap: 46, splitLine: { show: false } },
              series: [cellSeries("cells", shown.map(cellOf), look), outlineSeries("selected", [])] },
  };
}

/** Points of a Latin hypercube: the metric against one axis, or by colour over two. */
function scatterChart(sweep, view) {
  const { metric, x, second, valueOf, shown, without, scaled, tip, legend, note } = viewOf(sweep, view);
  const xScale = x.scale(), y = second ? second.scale() : scaled(0.08), colour = second && scaled(0);
  if (!second && without.length > 0) addGround(y, 1);
  const position = (point) => [xScale.at(point.at[view.x]),
                            second ? y.at(point.at[view.second]) : y.at(valueOf(point)) ?? y.low];
  const offset = (point) => (second || isNumber(valueOf(point)) ? 0 : -8);
  const size = shown.length > manyItems ? 5 : 10;
  const known = {
    type: "scatter", name: "known", symbolSize: size, symbol: outlined(symbols[0]), progressive: 0,
    data: shown.filter((point) => isNumber(valueOf(point))).map((point) => {
      const doubtful = isDoubtful(point), fill = doubtful ? "var(--paper)" : colours[0];
      return { point, value: position(point), itemStyle: colour
        ? { color: ramp(fractionOf(colour, valueOf(point))), borderColor: doubtful ? "var(--ink)" : "var(--quiet)",
            borderWidth: doubtful ? 2.25 : 0.75, opacity: 1 }
        : { color: fill, borderColor: colours[0], borderWidth: doubtful ? 2 : 0 } };
    }),
  };
  const signs = { type: "scatter", name: "without", symbolSize: 9, z: 5, clip: false,
                  data: signSeries(without, position, offset) };
  return {
    mark: (point) => [ring(point ? [{ point, value: position(point), symbolOffset: [0, offset(point)] }] : [])],
    title: second ? `${metric.title} over ${x.name} and ${second.name}` : `${metric.title} against ${x.name}`,
    note, many: shown.length > manyItems, bar: colour && rampBar(colour), height: second && "26rem",
    legend: [...doubtfulEntry(shown, colour ? "heavy edge" : "hollow"), ...legend.map(marked)],
    option: { ...chartBase(tip), xAxis: xScale.axis, yAxis: { ...y.axis, nameGap: 46 },
              series: [known, signs, ring([])] },
  };
}
