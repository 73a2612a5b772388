"use strict";
// The stability report: the margins (margins.js), the outcome, maps of verdicts over two settings, measured boundaries against exact ones,
// traces, and every case.

const verdicts = new Map([
  ["stable", { ...verdictLooks.fine, sign: "" }],
  ["limit cycle", { ...verdictLooks.restless, sign: "~" }],
  ["refused", { fill: "#c3c9ce", sign: "–", ink: darkInk }],
  ["not converged", { ...verdictLooks.worse, sign: "⋯" }],
  ["diverged", { ...verdictLooks.lost, sign: "×" }],
  ["broken", { fill: "#111111", sign: "!", ink: lightInk }],
]);
const unknownVerdict = { fill: lightInk, sign: "?", ink: darkInk };
const lookOfVerdict = (name) => verdicts.get(name) ?? unknownVerdict;
const theory = [{ colour: "var(--ink)", dash: "solid" }, { colour: "var(--good)", dash: "dashed" },
                { colour: "var(--violet)", dash: "dotted" }, { colour: "var(--accent)", dash: "solid" }];

function mapChart(map) {
  const named = ({ name, unit, logarithmic }) => ({ logarithmic, margin: 0, title: name, unit });
  const edges = ({ values, logarithmic }) => {
    const found = borders(logarithmic ? values.map(Math.log10) : values);
    return logarithmic ? found.map((position) => 10 ** position) : found;
  };
  const [xEdges, yEdges] = [edges(map.x), edges(map.y)];
  const x = scaleOf(xEdges, named(map.x)), y = scaleOf(yEdges, named(map.y));
  const cells = map.verdict.flatMap((row, j) => row.map((verdict, i) => ({
    value: [x.at(xEdges[i]), y.at(yEdges[j]), x.at(xEdges[i + 1]), y.at(yEdges[j + 1])],
    verdict, i, j, surprise: map.surprise[j]?.[i] === true,
  })));
  const surprises = cells.filter((cell) => cell.surprise);
  // A line of the paper's colour beneath each curve, because curves cross dark and light.
  const curves = map.curves.flatMap((curve, i) => [
    lineOf(curve.name, curve.points, x, y, { colour: "var(--paper)", width: 5 }, { z: 2, clip: true }),
    lineOf(curve.name, curve.points, x, y, { ...theory[i % theory.length], width: 2 }, { z: 3, clip: true }),
  ]);
  const present = [...verdicts.keys()].map((name) => [name, cells.filter((cell) => cell.verdict === name).length])
    .filter(([, cellCount]) => cellCount > 0);
  const legend = present.map(([name, cellCount]) =>
    ({ name, text: `${name}, ${count(cellCount, "cell")}`, ...lookOfVerdict(name) }));
  if (surprises.length > 0)
    legend.push({ name: "surprise", text: count(surprises.length, "surprise"), fill: "var(--paper)",
                  colour: outlineColour });
  const seen = map.marks.filter((mark) => [[x, mark.x], [y, mark.y]].every(([scale, value]) =>
    value >= scale.from * 0.999 && value <= scale.to * 1.001));
  const lookOfMark = (mark) => ({ symbol: symbols[map.marks.indexOf(mark)], colour: "var(--ink)", dash: "none" });
  for (const mark of map.marks) {
    const where = seen.includes(mark) ? mark.same ? "" : " (its other settings differ from the map's)"
                                      : ", which is outside this map";
    legend.push({ name: mark.name, text: `${mark.name}: ${mark.stable ? "stable" : "unstable"}${where}`, ...lookOfMark(mark) });
  }
  const marks = seen.map((mark) => ({
    type: "scatter", name: mark.name, silent: true, symbol: outlined(lookOfMark(mark).symbol), symbolSize: 13, z: 5,
    itemStyle: { color: mark.same ? darkInk : lightInk, borderColor: mark.same ? lightInk : darkInk, borderWidth: 2 },
    data: [[x.at(mark.x), y.at(mark.y)]],
  }));
  legend.push(...map.curves.map((curve, i) => ({ name: curve.name, series: true, ...theory[i % theory.length] })));
  const tip = ({ verdict, surprise, i, j }) =>
    tipOf(surprise ? `${verdict}: a surprise` : verdict, [[withUnit(map.x.name, map.x.unit), map.x.values[i]],
                                                          [withUnit(map.y.name, map.y.unit), map.y.values[j]]]);
  return chart({
    title: map.title, note: map.text, legend,
    option: {
      ...chartBase(({ data }) => data.verdict && tip(data)),
      xAxis: { ...x.axis, splitLine: { show: false } },
      yAxis: { ...y.axis, nameGap: 46, splitLine: { show: false } },
      series: [cellSeries("verdict", cells, ({ verdict }) => lookOfVerdict(verdict)), ...curves,
               outlineSeries("surprise", surprises), ...marks],
    },
  });
}

/** The measured boundaries against the exact ones, and against the passive ones, which should lie inside. */
function boundaryCharts(boundaries) {
  const usable = boundaries.filter((one) => one.exact > 0 && isNumber(one.measured));
  if (usable.length === 0) return [];
  const [blue, orange] = [lookOf(0), lookOf(1)];
  const exactAxis = { logarithmic: true, title: "exact boundary", unit: "N/m" };
  const base = chartBase(({ data }) => data.one && tipOf(data.one.settings, [
    ["measured (N/m)", data.one.measured], ["exact (N/m)", data.one.exact],
    ["measured / exact", data.one.measured / data.one.exact], ["passive up to (N/m)", data.one.passive]]));
  const points = (name, look, x, y, value, among = usable) => ({
    type: "scatter", name, symbol: outlined(look.symbol), symbolSize: 8,
    itemStyle: { color: look.colour, opacity: 0.75 },
    data: among.map((one) => ({ value: [x.at(one.exact), y.at(value(one))], one })),
  });

  const x = scaleOf(usable.map((one) => one.exact), exactAxis);
  const ratio = scaleOf([0.97, 1.03, ...usable.map((one) => one.measured / one.exact)],
                        { title: "measured / exact" });
  const measured = { ...points("measured", blue, x, ratio, (one) => one.measured / one.exact),
                     markArea: { silent: true, itemStyle: { color: "var(--within)" },
                                 data: [[{ yAxis: 0.98 }, { yAxis: 1.02 }]] } };
  const one = lineOf("exact", [[x.from, 1], [x.to, 1]], x, ratio, { colour: neutral, width: 1 });
  const charts = [chart({
    title: "Measured against exact boundary",
    note: "The largest stable stiffness, found by bisection, divided by the stiffness at which an eigenvalue of the " +
      "one-tick map leaves the unit circle.",
    legend: [{ name: "measured", ...blue, dash: "none", series: true },
             { name: "band", text: "within 2 %", fill: "var(--within)" }],
    option: { ...base, xAxis: x.axis, yAxis: { ...ratio.axis, nameGap: 46 }, series: [one, measured] },
  })];

  const passive = usable.filter((item) => item.passive > 0);
  if (passive.length > 0) {
    const y = scaleOf(usable.flatMap((item) => [item.measured, item.passive]),
                      { logarithmic: true, title: "stiffness", unit: "N/m" });
    charts.push(chart({
      title: "The passivity condition is stricter than stability",
      note: "The stiffness up to which Colgate & Schenkel's condition promises stability, and the stiffness " +
        "up to which the loop is stable.",
      legend: [{ name: "measured", text: "stable up to, measured", ...blue, dash: "none", series: true },
               { name: "passive", text: "passive up to", ...orange, dash: "none", series: true },
               { name: "exact", text: "exact boundary", colour: neutral, dash: "solid", series: true }],
      option: { ...base, xAxis: x.axis, yAxis: { ...y.axis, nameGap: 46 }, series: [
        lineOf("exact", [[x.from, x.from], [x.to, x.to]], x, y, { colour: neutral, width: 1 }, { clip: true }),
        points("measured", blue, x, y, (item) => item.measured, usable.filter((item) => item.measured > 0)),
        points("passive", orange, x, y, (item) => item.passive, passive)] },
    }));
  }
  return charts;
}

/** The result in words: how far off the worst is, and whether passive loops were stable. A boundary without a
    measurement fails both. */
function boundaryText(boundaries) {
  const off = boundaries.filter((one) => isNumber(one.measured) && one.exact > 0)
    .map((one) => Math.abs(one.measured / one.exact - 1));
  const all = boundaries.length, outside = all - off.filter((value) => value <= 0.02).length;
  const unstable = all - boundaries.filter((one) => isNumber(one.measured) && one.measured >= one.passive).length;
  const say = (bad, ifBad, ifGood) => el("span", { class: bad ? "bad" : "good" }, bad ? ifBad : ifGood);
  return el("p", {}, say(outside, `${outside} of ${all} are not within 2 % of the exact boundary`,
                         `All ${all} are within 2 % of the exact boundary`),
            off.length ? ` (at most ${(100 * Math.max(...off)).toFixed(2)} % off); ` : "; ",
            say(unstable, `${unstable} of ${all} were not found stable wherever the passivity condition holds.`,
                "every loop is stable where the passivity condition holds."));
}

function traceChart(trace) {
  const lookOfTrace = (i) => ({ ...lookOf(i), dash: dashes[i % dashes.length], symbol: null });
  const x = scaleOf(trace.time, { margin: 0, title: "time", unit: "s" });
  const y = scaleOf(trace.series.flatMap(({ values }) => values), { title: trace.y_name });
  return chart({
    title: trace.title, note: trace.text,
    legend: trace.series.map(({ name }, i) => ({ name, ...lookOfTrace(i), series: true })),
    option: {
      ...chartBase(() => null),
      xAxis: x.axis,
      yAxis: { ...y.axis, nameGap: 46 },
      series: trace.series.map(({ name, values }, i) =>
        lineOf(name, values.map((value, k) => [trace.time[k], value]), x, y, lookOfTrace(i),
               { sampling: "minmax" })),
    },
  });
}

/** The cases group by group, with a switch that shows surprises only. */
function caseTables(cases) {
  const groups = [...new Set(cases.map((one) => one.group))].map((name) => {
    const own = cases.filter((one) => one.group === name);
    const surprises = own.filter((one) => one.surprise).length;
    const rows = table([
      { name: "name", title: "Case" }, { name: "settings", title: "Settings" },
      { name: "verdict", title: "Verdict", cell: (one) => verdictMark(lookOfVerdict(one.verdict), one.verdict) },
      { name: "expected", title: "Expected", value: (one) => one.expected.join(" or ") },
      { name: "surprise", title: "Surprise", value: (one) => (one.surprise ? 1 : 0),
        cell: (one) => (one.surprise ? el("span", { class: "bad" }, "surprise") : "") },
      { name: "detail", title: "Detail" },
    ], own, { label: name, rowClass: (one) => (one.surprise ? "surprise" : null) });
    const summary = `${count(own.length, "case")}, ${count(surprises, "surprise")}`;
    const section = el("div", {}, el("h3", {}, name, " ", el("span", { class: "quiet" }, summary)), rows.element);
    return { section, rows, surprises };
  });
  const filter = (event) => groups.forEach(({ section, rows, surprises }) => {
    rows.show((one) => one.surprise || !event.target.checked);
    section.hidden = event.target.checked && surprises === 0;
  });
  return [el("div", { class: "controls" }, el("label", {}, el("input", { type: "checkbox", change: filter }),
                                              "surprises only")),
          ...groups.map(({ section }) => section)];
}

drawPage((data, main) => {
  const { cases, maps, boundaries, traces, surprises } = data;
  const mapCells = maps.reduce((sum, map) => sum + map.verdict.reduce((cells, row) => cells + row.length, 0), 0);
  main.append(el("h1", {}, document.title), machineLine(data.machine));
  if (data.quick)
    main.append(el("p", { class: "warning" }, "A quick run: coarser maps, fewer and shorter cases."));
  if (data.margins.length > 0) main.append(marginSection(data.margins));
  const nothing = cases.length + mapCells + boundaries.length === 0;
  if (nothing) {
    main.append(el("p", {}, "Nothing was tested: this report holds no cases and no maps."));
  } else {
    main.append(...[
      el("dl", { class: "facts" }, fact("Surprises", format(surprises), surprises ? "bad" : "good"),
         fact("Cases", format(cases.length)), fact("Map cells", format(mapCells)),
         fact("Boundaries", format(boundaries.length)),
         isNumber(data.seconds) ? fact("Run time", `${tickText(Number(data.seconds.toPrecision(3)))} s`) : null),
      el("p", {}, surprises
        ? el("span", { class: "bad" }, `${count(surprises, "verdict was", "verdicts were")} not as expected.`)
        : "Every case ended as expected."),
      maps.some((map) => map.marks.length > 0) ? el("p", {}, "Symbols in the maps show where the settings above are on " +
        "the axes. A symbol is filled where the map's other settings are the same too.") : null,
      el("p", {}, "Each case and each cell of a map has a verdict. Theory or common sense expects one or several. Any " +
        "other verdict is a surprise and is outlined. The signs are:"),
      el("ul", { class: "legend" },
         ...[...verdicts].map(([name, look]) => el("li", {}, verdictMark(look, name))))].filter(Boolean));
  }
  const sections = [
    ["maps", "Maps", maps, () => [el("div", { class: "charts" }, ...maps.map(mapChart))]],
    ["boundaries", "Boundaries of stability", boundaries, () => [
      boundaryText(boundaries), el("div", { class: "charts" }, ...boundaryCharts(boundaries)),
      table([{ name: "settings", title: "Settings" }, { name: "measured", title: "Measured", unit: "N/m" },
             { name: "exact", title: "Exact", unit: "N/m" },
             { name: "ratio", title: "Measured / exact",
               value: (one) => (one.exact && isNumber(one.measured) ? one.measured / one.exact : null) },
             { name: "passive", title: "Passive up to", unit: "N/m" }],
            boundaries, { label: "Boundaries of stability" }).element]],
    ["traces", "Traces", traces, () => [el("div", { class: "charts" }, ...traces.map(traceChart))]],
    ["cases", "Cases", cases, () => caseTables(cases)],
  ].filter(([, , content]) => content.length > 0);
  main.append(contents(sections));
  for (const [id, title, , parts] of sections) main.append(el("section", { id }, el("h2", {}, title), ...parts()));
});
