"use strict";
// The page of bench: advice (advice.js), then for each problem run time against error, error against resolution and slope errors by direction;
// then orders, estimates and all runs as tables.

/** The series, in the order of the runs. */
const seriesOf = (runs) => [...new Set(runs.map((run) => run.series))];
/** Whether the row has a position on logarithmic axes. */
const plotted = (row, ...names) => names.every((name) => isNumber(row[name]) && row[name] > 0);
const toTwo = (value) => (isNumber(value) ? withMinus(value.toFixed(2)) : "–");

drawPage((data, main) => {
  const { problems, columns, runs, orders, estimates, notes } = data;
  const looks = new Map(seriesOf(runs).map((series, i) => [series, lookOf(i)]));
  const column = (name) => columns.find((one) => one.name === name) ?? { name, title: name, unit: "" };
  const tip = (problem, run) =>
    tipOf(`${run.series} · ${run.label}`, columns.filter(({ name }) => isNumber(run[name])).map((one) =>
      [withUnit(one.name === problem.error ? problem.error_title : one.title, one.unit), run[one.name]]));

  /** The points of a series as a line with the look of the series. */
  const curve = (problem, series, points, x, y, xName) => {
    const look = looks.get(series);
    return {
      type: "line", name: series, symbol: outlined(look.symbol), symbolSize: 8, ...lineStyles(look, "series"),
      data: points.map((run) => ({ value: [x.at(run[xName]), y.at(run[problem.error])], run })),
    };
  };
  const legendOf = (shown, text = (series) => series) =>
    shown.map((series) => ({ name: series, text: text(series), series: true, ...looks.get(series) }));
  const frame = (problem, x, y, series) => ({
    ...chartBase((item) => item.data?.run && tip(problem, item.data.run)),
    xAxis: x.axis,
    yAxis: { ...y.axis, nameGap: 46 },
    series,
  });
  const errorScale = (problem, points) =>
    scaleOf([...points.map((run) => run[problem.error]), problem.converged_to],
            { logarithmic: true, title: problem.error_title, unit: problem.error_unit });
  /** A line, and its name in the legend, where the problem's reference is itself only converged so far. */
  const addReference = (problem, x, y, lines, legend) => {
    if (!plotted(problem, "converged_to")) return;
    const look = { colour: "var(--quiet)", dash: "dotted" };
    lines.push(lineOf("converged", [[x.from, problem.converged_to], [x.to, problem.converged_to]], x, y, look));
    legend.push({ name: "converged", text: "error of the reference itself", series: true, ...look });
  };

  /** Run time against error, with the points as they were run. No run beats a run on the front in both. */
  function workChart(problem, own) {
    const points = own.filter((run) => plotted(run, "wall_seconds", problem.error));
    if (points.length === 0) return null;
    const shown = seriesOf(points);
    const { title, unit } = column("wall_seconds");
    const x = scaleOf(points.map((run) => run.wall_seconds), { logarithmic: true, title, unit });
    const y = errorScale(problem, points);
    const front = points.filter((run) => run.pareto).sort((a, b) => a.wall_seconds - b.wall_seconds);
    const left = own.length - points.length;
    const note = "Lower left is better." +
      (left > 0 ? ` ${left} of ${own.length} runs cannot be drawn on logarithmic axes: see the table.` : "");
    const lines = shown.map((series) =>
      curve(problem, series, points.filter((run) => run.series === series), x, y, "wall_seconds"));
    const legend = legendOf(shown);
    if (front.length > 0) {
      const [first, last] = [front[0], front.at(-1)];
      lines.push({
        type: "line", name: "front", step: "end", silent: true, symbol: "none", z: 1,
        lineStyle: { color: neutral, width: 5, opacity: 0.16 },
        data: [[x.at(first.wall_seconds), y.high],
               ...front.map((run) => [x.at(run.wall_seconds), y.at(run[problem.error])]),
               [x.high, y.at(last[problem.error])]],
      }, {
        type: "scatter", name: "front", silent: true, symbol: "circle", symbolSize: 15, z: 4,
        itemStyle: { color: "transparent", borderColor: "var(--ink)", borderWidth: 1.5 },
        data: front.map((run) => [x.at(run.wall_seconds), y.at(run[problem.error])]),
      });
      legend.push({ name: "front", text: "Pareto front: no run is both faster and more exact", colour: "var(--ink)",
                    symbol: symbols[0], hollow: true, dash: "none", series: true });
    }
    addReference(problem, x, y, lines, legend);
    return chart({ title: "Run time against error", note, legend, option: frame(problem, x, y, lines) });
  }

  /** Error against cells, for the series that vary them: the smallest error at each number of cells. */
  function convergenceChart(problem, own) {
    const best = new Map();
    for (const run of own.filter((one) => plotted(one, "cells", problem.error))) {
      const at = best.get(run.series) ?? best.set(run.series, new Map()).get(run.series);
      if (!at.has(run.cells) || run[problem.error] < at.get(run.cells)[problem.error]) at.set(run.cells, run);
    }
    const varied = [...best].filter(([, at]) => at.size > 1)
      .map(([series, at]) => [series, [...at.values()].sort((a, b) => a.cells - b.cells)]);
    if (varied.length === 0) return null;
    const all = varied.flatMap(([, points]) => points);
    const { title, unit } = column("cells");
    const x = scaleOf(all.map((run) => run.cells), { logarithmic: true, title, unit });
    const y = errorScale(problem, all);
    const text = (series) => {
      const fit = orders.find((one) =>
        one.problem === problem.name && one.series === series && one.error === problem.error);
      return fit && isNumber(fit.order)
        ? `${series}: order ${toTwo(fit.order)} (${toTwo(fit.low)} to ${toTwo(fit.high)})` : series;
    };
    const lines = varied.map(([series, points]) => curve(problem, series, points, x, y, "cells"));
    const legend = legendOf(varied.map(([series]) => series), text);
    addReference(problem, x, y, lines, legend);
    return chart({
      title: "Error against resolution",
      note: "The smallest error of each series at each resolution. The legend gives the fitted orders " +
        "with their 95 % ranges.",
      legend, option: frame(problem, x, y, lines),
    });
  }

  /** Slope errors by direction, of each series' run with the most cells. The scale is asinh: linear within the bound
      of 0.15 degrees, logarithmic far beyond it. */
  function slopeChart(problem, own) {
    const bound = 0.15;
    const at = (error) => (isNumber(error) ? Math.asinh(error / bound) : null);
    const known = own.filter((run) => run.directions?.length && run.slope_error?.some(isNumber));
    if (known.length === 0) return null;
    const finest = seriesOf(known).map((series) => known.filter((run) => run.series === series)
      .reduce((best, run) => ((run.cells ?? 0) > (best.cells ?? 0) ? run : best)));
    const positions = finest.flatMap((run) => run.slope_error.map(at)).filter((position) => position !== null);
    const low = Math.min(at(-bound), ...positions) - 0.6, high = Math.max(at(bound), ...positions) + 0.15;
    const rings = [0, bound, 0.5, 2, 8, 30].flatMap((value) => (value > 0 ? [-value, value] : [value]))
      .filter((value) => at(value) > low + 0.4 && at(value) < high).sort((a, b) => a - b);
    const circle = (value) => ({
      type: "line", coordinateSystem: "polar", silent: true, symbol: "none", z: 1,
      ...(Math.abs(value) > bound ? { name: "grid", lineStyle: { color: "var(--faint-rule)", width: 1 } }
        : { name: "bound", lineStyle: { color: "var(--ink)", width: 1, type: value === 0 ? "solid" : "dashed" } }),
      data: Array.from({ length: 181 }, (_, i) => [at(value), 2 * i]),
    });
    const lines = finest.map((run) => {
      const look = looks.get(run.series);
      const points = run.directions.map((direction, i) => ({
        value: [at(run.slope_error[i]), direction], direction, error: run.slope_error[i], run }));
      const gap = Math.max(...run.directions.slice(1).map((direction, i) => direction - run.directions[i]));
      const closes = 360 - (run.directions.at(-1) - run.directions[0]) <= 1.5 * gap;
      if (closes) points.push({ ...points[0], value: [points[0].value[0], run.directions[0] + 360] });
      return {
        type: "line", coordinateSystem: "polar", name: run.series, symbol: outlined(look.symbol), symbolSize: 5,
        ...lineStyles(look, "series"), data: points,
      };
    });
    const tipOfPoint = ({ direction, error, run }) =>
      tipOf(`${run.series} · ${run.label}`, [["direction (°)", direction], ["slope error (°)", error]]);
    const legend = finest.map((run) => ({
      name: run.series, series: true, ...looks.get(run.series),
      text: run.series + (isNumber(run.cells) ? `, ${format(run.cells)} cells` : ""),
    }));
    legend.push({ name: "bound", text: "no error, and ±0.15°", series: true, colour: "var(--ink)", dash: "dashed" });
    return chart({
      title: "Slope error by direction",
      note: "Degrees by which the slope is too steep (outwards) or too flat (inwards), at the finest resolution. " +
        "Linear within ±0.15°, logarithmic beyond.",
      legend, height: "25rem",
      option: {
        ...chartBase((item) => item.data?.run && tipOfPoint(item.data)),
        polar: { radius: "78%", center: ["50%", "50%"] },
        angleAxis: { type: "value", min: 0, max: 360, interval: 45, startAngle: 0, clockwise: false,
                     axisLine: { lineStyle: { color: "var(--axis)" } }, axisTick: { show: false },
                     axisLabel: { formatter: (angle) => `${angle}°`, color: "var(--ink)", fontSize: 11 },
                     splitLine: { lineStyle: { color: "var(--faint-rule)" } } },
        radiusAxis: { type: "value", min: low, max: high, axisLine: { show: false }, axisTick: { show: false },
                      splitLine: { show: false }, z: 5, axisLabel: {
                        customValues: rings.filter((value) => value !== -bound).map(at), fontSize: 10,
                        backgroundColor: "var(--veil)", padding: [1, 2], color: "var(--ink)",
                        formatter: (position) => tickText(Number((bound * Math.sinh(position)).toPrecision(3))) } },
        series: [...rings.map(circle), ...lines],
      },
    });
  }

  /** A chart that comes with a problem. Curves of one name have one colour; their looks mean what `looks` says. */
  function plotChart({ title, note, x_title, x_unit, y_title, curves, looks: meanings }) {
    const x = scaleOf(curves.flatMap((curve) => curve.x), { title: x_title, unit: x_unit, margin: 0.02 });
    const y = scaleOf(curves.flatMap((curve) => curve.y), { title: y_title });
    const names = [...new Set(curves.map(({ name }) => name))];
    const lookIn = { line: { dash: "solid" }, dashed: { dash: "dashed" }, points: { dash: "none", symbol: symbols[0] } };
    const series = curves.map(({ name, look, x: positions, y: values }) => {
      const { colour } = lookOf(names.indexOf(name)), { dash, symbol } = lookIn[look];
      const data = positions.map((position, i) => ({ value: [x.at(position), y.at(values[i])], along: position,
                                                      value_there: values[i] }));
      return { type: "line", name, data, symbol: symbol ? outlined(symbol) : "none", symbolSize: 8,
               ...lineStyles({ colour, dash: dash === "none" ? "solid" : dash, width: symbol ? 0 : 1.75 }) };
    });
    const legend = [...names.map((name, i) => ({ name, series: true, colour: lookOf(i).colour })),
                    ...meanings.map(({ look, text }) => ({ name: text, colour: neutral, ...lookIn[look] }))];
    const option = {
      ...chartBase(({ seriesName, data }) => tipOf(seriesName, [[x_title, data.along], [y_title, data.value_there]])),
      xAxis: x.axis, yAxis: { ...y.axis, nameGap: 46 }, series };
    return chart({ title, note, legend, option });
  }

  /** Measurements of others, beside the law. */
  const measuredTable = (rows) => table(
    [{ name: "medium", title: "Medium" }, { name: "what", title: "What" },
     ...[["measured", "Measured"], ["model", "The law"]].map(([name, title]) =>
       ({ name, title, cell: (row) => toTwo(row[name]) })),
     { name: "off", title: "Off by", unit: "%", value: (row) => Math.round(100 * row.off) },
     { name: "source", title: "Source" }], rows, { label: "The law against measurements" }).element;

  /** Times of ticks: a row for each tool and setting, a column for each law. */
  function tickTable(own) {
    const laws = [...new Set(own.map((run) => run.force_law))], rows = new Map();
    for (const run of own) {
      const key = `${run.tool}, ${run.label}`;
      if (!rows.has(key)) rows.set(key, { tool: run.tool, label: run.label });
      Object.assign(rows.get(key), { [run.force_law]: run.tick_microseconds, [`${run.force_law} times`]: run.of_paper,
                                     [`${run.force_law} disturbed`]: run.disturbed });
    }
    return table([{ name: "tool", title: "Tool" }, { name: "label", title: "Settings" },
                  ...laws.map((law) => ({ name: law, title: law, unit: "µs",
                                cell: (row) => toTwo(row[law]) + (row[`${law} disturbed`] ? " *" : "") })),
                  ...laws.filter((law) => law !== "paper").map((law) =>
                    ({ name: `${law} times`, title: `${law} over paper`, cell: (row) => toTwo(row[`${law} times`]) }))],
                 [...rows.values()], { label: "Time of a tick" }).element;
  }

  main.append(el("h1", {}, document.title), machineLine(data.machine));
  const warnings = [data.quick ? "A quick bench: few and coarse runs, to check that everything works." : "",
                    data.disturbance].filter(Boolean);
  if (warnings.length > 0) main.append(el("p", { class: "warning" }, warnings.join(" ")));
  if (data.advice.length > 0) main.append(adviceSection(data.advice, data.asked_errors));
  if (runs.length === 0) {
    main.append(el("p", {}, "Nothing was measured: this bench holds no runs."));
  } else {
    main.append(el("p", {},
      "Each point is a run. Its run time is the shortest of several repeats. The runs take turns, so a change of " +
      "the machine's speed affects all of them alike. The error is the distance to the known answer, or to a " +
      "converged solution. Errors below the dotted line mean nothing, because the converged solution is no more " +
      "exact. Point at a symbol for its figures. Click on a name to hide its line."));
  }
  const titleOf = new Map(problems.map((problem) => [problem.name, problem.title]));
  const sections = problems.map((problem, i) => [`problem-${i + 1}`, problem.title]);
  const tables = [["orders", "Orders of convergence", orders],
                  ["estimates", "Estimated and true errors", estimates], ["runs", "All runs", runs]]
    .filter(([, , rows]) => rows.length > 0);
  main.append(contents([...sections, ...tables]));

  problems.forEach((problem, i) => {
    const own = runs.filter((run) => run.problem === problem.name);
    const section = el("section", { id: sections[i][0] }, el("h2", {}, problem.title), el("p", {}, problem.text));
    main.append(section);
    if (problem.times_ticks) return section.append(tickTable(own));
    const drawn = [...[workChart, convergenceChart, slopeChart].map((draw) => draw(problem, own)).filter(Boolean),
                   ...(problem.plots ?? []).map(plotChart)];
    section.append(drawn.length ? el("div", { class: "charts lead" }, ...drawn)
                                : el("p", { class: "quiet" }, "No run of this problem can be drawn."));
    if (problem.measured?.length)
      section.append(el("h3", {}, "The law against measurements"), el("p", {}, problem.measured_text),
                     measuredTable(problem.measured));
  });

  const problemColumn = { name: "problem", title: "Problem",
                          value: (row) => titleOf.get(row.problem) ?? row.problem };
  const bodies = {
    orders: () => [
      el("p", {}, "The error is proportional to the step (such as the cell size) to the power of the order. " +
                  "The range is the 95 % confidence interval."),
      table([problemColumn, { name: "series", title: "Series" },
             { name: "error", title: "Error", value: (row) => column(row.error).title },
             ...[["order", "Order"], ["low", "from"], ["high", "to"]].map(([name, title]) =>
               ({ name, title, cell: (row) => toTwo(row[name]) })),
             { name: "points", title: "Points" }], orders, { label: "Orders of convergence" }).element],
    estimates: () => {
      const outside = (row) => isNumber(row.ratio) && (row.ratio < 1 / 3 || row.ratio > 3);
      const known = estimates.filter((row) => isNumber(row.ratio)), count = known.filter(outside).length;
      return [
        el("p", {}, "The error that a run estimates for itself, against the true error. ",
           el("span", { class: count ? "bad" : "good" },
              count ? `${count} of ${known.length} are not within a factor of 3.`
                    : `All ${known.length} are within a factor of 3.`)),
        table([problemColumn, { name: "label", title: "Run" }, { name: "quantity", title: "Quantity" },
               { name: "estimate", title: "Estimate" }, { name: "truth", title: "Truth" },
               { name: "ratio", title: "Ratio", cell: (row) => outside(row)
                 ? el("span", { class: "bad" }, `${format(row.ratio, false)} ✗`) : null }],
              estimates, { label: "Estimated and true errors",
                           rowClass: (row) => (outside(row) ? "surprise" : null) }).element];
    },
    runs: () => {
      const all = table([problemColumn, { name: "series", title: "Series" }, { name: "label", title: "Run" },
                         ...columns.filter(({ name }) => !["problem", "series", "label", "disturbed", "pareto"].includes(name)),
                         ...[["disturbed", "Disturbed", "*"], ["pareto", "Front", "●"]].map(([name, title, mark]) =>
                           ({ name, title, value: (row) => (row[name] ? mark : null),
                              cell: (row) => (row[name] ? mark : "") }))],
                        runs, { label: "All runs" });
      const choice = el("select", { change: (event) => all.show((row) =>
        event.target.value === "" || row.problem === problems[Number(event.target.value)].name) },
        el("option", { value: "" }, "all"),
        ...problems.map((problem, i) => el("option", { value: i }, problem.title)));
      return [el("div", { class: "controls" }, el("label", {}, "Problem ", choice)), all.element];
    },
  };
  for (const [id, title] of tables) main.append(el("section", { id }, el("h2", {}, title), ...bodies[id]()));
  if (notes.length > 0)
    main.append(el("section", { id: "notes" }, el("h2", {}, "Notes"), ...notes.map((note) => el("p", {}, note))));
});
