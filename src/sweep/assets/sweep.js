"use strict";
// The report of a sweep: what was swept, what matters (sweep_effects.js), charts of any metric over any one or two axes, the selected point with its
// command line, pictures, and a table of all points. One point is always selected. It gives the values of the axes that
// a chart does not show.

function readSweep(data) {
  const shown = (one) => ({ ...one, unit: unitText(one.unit) });
  const axes = data.axes.map(shown).map(prepareAxis), metrics = data.metrics.map(shown);
  const byPosition = new Map(data.points.map((point) => [point.at.join(), point]));
  return { ...data, axes, metrics, latin: data.design === "latin", pointAt: (at) => byPosition.get(at.join()) ?? null };
}

/** The axes and the size of the sweep, in words. */
function summary({ axes, latin, points, scene }) {
  const range = ({ name, unit, numeric, logarithmic, values, order, text }) => {
    const notes = [!latin && count(values.length, "value"), logarithmic && "logarithmic"].filter(Boolean).join(", ");
    const of = numeric ? `from ${text(order[0])} to ${text(order.at(-1))} ${unit}`.trim() + (notes && ` (${notes})`)
                       : `(${values.slice(0, 6).join(", ")}${values.length > 6 ? ", …" : ""})`;
    return [el("strong", {}, name), ` ${of}`];
  };
  const size = latin || axes.length === 1 ? count(points.length, "point")
                                          : axes.map(({ values }) => format(values.length)).join(" × ");
  return el("p", {}, `A ${latin ? "Latin hypercube" : "grid"} of ${size} over `,
            ...axes.flatMap((axis, i) => [i === 0 ? "" : i === axes.length - 1 ? " and " : ", ", ...range(axis)]),
            `, from the scene ${scene}.`);
}

/** The kind of chart that is drawn: one axis alone is always drawn as lines. */
const kindOf = ({ chart, second }) => (second === null ? "lines" : chart);

/** Choices of the view. Calls changed() after a choice, and move(axis, i) when a slider was moved. */
function viewControls({ axes, metrics, points, latin }, view, changed, move) {
  const field = (label, input) => el("label", {}, label, input);
  const choice = (name, options, change) =>
    el("select", { name, change: (event) => { change(event.target.value); changed(); } },
       ...options.map(([value, text]) => el("option", { value }, text)));
  const titled = axes.map(({ name }, i) => [i, name]);
  const metric = choice("metric", metrics.map(({ title, unit }, i) => [i, withUnit(title, unit)]),
                        (value) => { view.metric = Number(value); });
  const x = choice("x", titled, (value) => {
    if (view.second === Number(value)) view.second = view.x;
    view.x = Number(value);
  });
  const second = choice("second", [["", "none"], ...titled],
                        (value) => { view.second = value === "" ? null : Number(value); });
  const kind = choice("chart", [["lines", "lines"], ["map", "heat map"]], (value) => {
    view.chart = value;
    if (value === "map") view.second ??= view.x === 0 ? 1 : 0;
  });
  const log = el("input", { type: "checkbox", name: "log",
                            change: () => { view.log = log.checked; changed(); } });
  const sliders = latin ? [] : axes.map(({ name, unit, values, order, numeric, text }, i) => {
    const input = numeric
      ? el("input", { type: "range", name: `at-${i}`, min: 0, max: values.length - 1, step: 1,
                      input: () => move(i, order[Number(input.value)]) })
      : el("select", { name: `at-${i}`, change: () => move(i, Number(input.value)) },
           ...values.map((value, k) => el("option", { value: k }, String(value))));
    const output = numeric ? el("output", {}) : null;
    return { label: el("label", { class: "slider" }, name, input, output), show: (at) => {
      input.value = numeric ? order.indexOf(at) : at;
      if (!numeric) return;
      output.textContent = `${text(at)} ${unit}`.trim();
      input.setAttribute("aria-valuetext", output.textContent);
    } };
  });
  return {
    element: el("form", { class: "controls view", submit: (event) => event.preventDefault(), autocomplete: "off" },
      field("Metric", metric), latin ? null : field("Chart", kind), field("Horizontal axis", x),
      field("Second axis", second), field(log, "log scale"), ...sliders.map(({ label }) => label)),
    /** Corrects the view so that it can be drawn, and shows it. */
    sync: () => {
      const values = points.map((point) => point.metrics[view.metric]).filter(isNumber);
      log.disabled = values.length === 0 || values.some((value) => value <= 0);
      view.log = view.log && !log.disabled;
      metric.value = view.metric;
      metric.title = metrics[view.metric]?.definition ?? "";
      x.value = view.x;
      for (const option of second.options) option.disabled = option.value === String(view.x);
      second.value = view.second ?? "";
      second.disabled = kind.disabled = axes.length < 2;
      kind.value = kindOf(view);
      log.checked = view.log;
      sliders.forEach(({ label, show }, i) => {
        label.hidden = i === view.x || i === view.second;
        show(view.at[i]);
      });
    },
  };
}

drawPage((data, main) => {
  const sweep = readSweep(data), { axes, metrics, points, counts, latin } = sweep;
  main.append(el("h1", {}, document.title), machineLine(data.machine));
  if (points.length === 0 || axes.length === 0) {
    main.append(el("p", {}, "Nothing was swept: this sweep holds no points."));
    return;
  }
  const bad = (n) => (n ? "bad" : "good");
  main.append(summary(sweep), el("dl", { class: "facts short" }, fact("Points", format(counts.points)),
    fact("Done", format(counts.done)), fact("Failed", format(counts.failed), bad(counts.failed)),
    fact("Missing", format(counts.missing), bad(counts.missing))));

  // At first: the first metric that varies, over the two axes that matter most for it.
  const metric = Math.max(0, data.effects.findIndex((own) => own.length > 0));
  const alone = (data.effects[metric] ?? []).filter((one) => one.axes.length === 1).map((one) => one.axes[0]);
  const [first, next] = [...alone, ...axes.map((_, i) => i).filter((i) => !alone.includes(i))];
  const few = axes.length < 2 || axes[next].values.length <= 4;
  const view = { metric, log: false, chart: few ? "lines" : "map", x: first,
                 second: axes.length < 2 || latin ? null : next, at: points[0].at };

  /** Puts the view into the address, so that a link leads back to it. */
  const write = () => {
    const state = { metric: metrics[view.metric]?.name ?? "", chart: kindOf(view), x: axes[view.x].name,
                    second: axes[view.second]?.name ?? "", ...(view.log ? { log: "1" } : {}),
                    point: sweep.pointAt(view.at)?.point ?? "" };
    history.replaceState(null, "", `#${new URLSearchParams(state)}`);
  };
  const read = () => {
    const state = new URLSearchParams(location.hash.slice(1));
    const find = (all, key) => {
      const i = all.findIndex(({ name }) => name === state.get(key));
      return i < 0 ? null : i;
    };
    view.metric = find(metrics, "metric") ?? view.metric;
    view.x = find(axes, "x") ?? view.x;
    if (state.has("second")) view.second = find(axes, "second");
    if (view.second === view.x) view.second = null;
    if (state.has("chart")) view.chart = state.get("chart") === "map" ? "map" : "lines";
    view.log = state.has("log");
    view.at = points.find(({ point }) => String(point) === state.get("point"))?.at ?? view.at;
  };

  const selectAt = (at) => {
    const stays = latin || axes.every((_, i) => i === view.x || i === view.second || at[i] === view.at[i]);
    view.at = at;
    if (stays) mark();
    else redraw();
  };
  const select = (point) => selectAt(point.at);
  /** One step along the chart's axes; where there is no grid, over the points in their order. */
  const step = (dx, dy) => {
    if (latin) {
      const along = (k) => ({ at }) => axes[k].position(at[k]);
      const position = dx ? along(view.x) : view.second !== null ? along(view.second)
        : ({ metrics: values }) => values[view.metric] ?? -Number.MAX_VALUE;
      const order = [...points].sort((a, b) => position(a) - position(b));
      const next = order[order.indexOf(sweep.pointAt(view.at)) + dx + dy];
      if (next) select(next);
      return;
    }
    const [k, by] = dx ? [view.x, dx] : [view.second, dy];
    if (k === null) return;
    const next = axes[k].order[axes[k].rank[view.at[k]] + by];
    if (next !== undefined) selectAt(view.at.map((i, other) => (other === k ? next : i)));
  };
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const keys = (after) => (event) => {
    const by = arrows[event.key];
    if (!by || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    step(...by);
    after();
  };

  const chart = chartFrame({ class: "keys", tabindex: "0", role: "application", keydown: keys(() => {}),
                             "aria-label": "Chart: the arrow keys select the next point along its axes" });
  const controls = viewControls(sweep, view, () => redraw(), (axis, i) =>
    selectAt(view.at.map((old, k) => (k === axis ? i : old))));
  const effects = effectList(sweep, ([x, second = null]) => {
    view.x = x;
    view.second = second ?? (view.second === x ? null : view.second);
    redraw();
  });
  const detail = detailPanel(sweep), rows = pointTable(sweep, select);
  const pictures = points.some(thumbnailOf) ? gallery(sweep, view, select, keys(() => pictures.focus())) : null;
  let drawn = null;
  const mark = () => {
    const point = sweep.pointAt(view.at);
    detail.show(point);
    rows.mark(point);
    pictures?.mark(point);
    if (drawn) chart.change({ series: drawn.mark(point) });
    write();
  };
  const redraw = () => {
    controls.sync();
    effects.show(view.metric);
    if (metrics.length > 0) {
      drawn = (latin ? scatterChart : kindOf(view) === "map" ? mapChart : linesChart)(sweep, view);
      chart.show({ ...drawn, click: ({ data }) => data?.point && select(data.point) });
    }
    pictures?.show();
    mark();
  };

  const reasons = mishaps(points, select);
  if (reasons) main.append(reasons);
  if (metrics.length > 0) main.append(effects.element);
  main.append(el("div", { class: "explore" },
    el("div", {}, metrics.length > 0 ? el("section", {}, controls.element, chart.element)
                                     : el("p", { class: "quiet" }, "No metrics were collected."),
       pictures?.element, rows.element),
    detail.element));
  read();
  redraw();
  addEventListener("hashchange", () => { read(); redraw(); });
});
