"use strict";
// The report of a sweep: what was swept, charts of any metric over any one or two axes, the selected point with
// its command line, pictures, and a table of all points. One point is always the selected one: the values of
// the axes that a chart does not show are its own.

const thumbnailOf = ({ thumbnail }) =>
  (typeof thumbnail === "string" && thumbnail.startsWith("data:image/png;base64,") ? thumbnail : null);
const hasFailed = ({ verdict }) => verdict === "unstable" || verdict === "refused";
const isDone = ({ verdict }) => verdict !== "missing" && !hasFailed({ verdict });

function readSweep(data) {
  const axes = data.axes.map(prepareAxis);
  const byPlace = new Map(data.points.map((point) => [point.at.join(), point]));
  return { ...data, axes, latin: data.design === "latin", pointAt: (at) => byPlace.get(at.join()) ?? null };
}

/** What was swept, in words. */
function summary({ axes, latin, points, scene }) {
  const range = ({ name, unit, numeric, logarithmic, values, order, text }) => {
    const notes = [latin ? "" : count(values.length, "value"), logarithmic ? "logarithmic" : ""].filter(Boolean).join(", ");
    const of = numeric ? `from ${text(order[0])} to ${text(order.at(-1))} ${unit}`.trim() + (notes && ` (${notes})`)
                       : `(${values.slice(0, 6).join(", ")}${values.length > 6 ? ", …" : ""})`;
    return [el("strong", {}, name), ` ${of}`];
  };
  const size = latin ? `A Latin hypercube of ${count(points.length, "point")}`
    : `A grid of ${axes.length > 1 ? axes.map(({ values }) => format(values.length)).join(" × ") : count(points.length, "point")}`;
  return el("p", {}, `${size} over `,
            ...axes.flatMap((axis, i) => [i === 0 ? "" : i === axes.length - 1 ? " and " : ", ", ...range(axis)]),
            `, from the scene ${scene}.`);
}

/** Points that failed or are missing, with their reasons: as many as one reads. */
function mishaps(points, select) {
  const groups = new Map();
  for (const point of points.filter((one) => !isDone(one))) {
    const key = JSON.stringify([point.verdict, point.reason]);
    groups.set(key, [...(groups.get(key) ?? []), point]);
  }
  if (groups.size === 0) return null;
  const [most, each] = [8, 12];
  const lines = [...groups.values()].slice(0, most).map((own) => el("li", {},
    verdictMark(lookOfVerdict(own[0].verdict), own[0].verdict), own[0].reason ? `: ${own[0].reason} ` : " ",
    el("span", { class: "quiet" }, own.length === 1 ? "Point " : `${format(own.length)} points: `),
    ...own.slice(0, each).flatMap((point, i) => [i ? ", " : "",
      el("button", { type: "button", class: "link", click: () => select(point) }, String(point.point))]),
    own.length > each ? ", …" : ""));
  return el("div", { class: "warning mishaps", role: "region", "aria-label": "Points without results" },
            el("ul", {}, ...lines),
            groups.size > most ? el("p", {}, `${count(groups.size - most, "more reason")} in the table.`) : null);
}

/** The command line, and a button that copies it: or selects it, where the browser does not allow more. */
function commandLine(text) {
  const code = el("code", { tabindex: "0" }, text), said = el("span", { role: "status" });
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(text);
      said.textContent = "copied";
    } catch {
      getSelection().selectAllChildren(code);
      said.textContent = document.execCommand("copy") ? "copied" : "selected: copy it with Ctrl+C";
    }
  };
  return el("div", { class: "command" }, code,
            el("div", { class: "controls" }, el("button", { type: "button", click: copy }, "Copy"), said));
}

/** The selected point. */
function detailPanel({ axes, metrics }) {
  const body = el("div"), said = el("p", { class: "unseen", "aria-live": "polite" });
  const rows = (pairs) => el("dl", {}, ...pairs.flatMap(([name, value, unit]) =>
    [el("dt", {}, name), el("dd", {}, value, unit ? el("small", {}, ` ${unit}`) : null)]));
  return {
    element: el("aside", { class: "detail", role: "region", "aria-label": "Selected point" }, said, body),
    show: (point) => {
      if (!point) {
        said.textContent = "No point here.";
        body.replaceChildren(el("p", { class: "quiet" }, "The sweep has no point here."));
        return;
      }
      const values = axes.map((axis, i) => [axis.name, axis.text(point.at[i]), axis.unit]);
      said.textContent = [`Point ${point.point}, ${point.verdict}`,
                          ...values.map((parts) => parts.join(" ").trim())].join(", ");
      const picture = thumbnailOf(point);
      body.replaceChildren(...[
        el("h2", {}, `Point ${point.point}`), verdictMark(lookOfVerdict(point.verdict), point.verdict),
        point.reason ? el("p", { class: isDone(point) ? "quiet" : "bad" }, point.reason) : null,
        picture && el("img", { src: picture, alt: `The sand of point ${point.point}` }),
        el("h3", {}, "Axes"), rows(values), el("h3", {}, "Metrics"),
        rows(metrics.map(({ title, unit }, i) => [title, format(point.metrics[i] ?? null), isNumber(point.metrics[i]) && unit])),
        el("h3", {}, "Command"), commandLine(point.command),
      ].filter(Boolean));
    },
  };
}

/** Choices of the view; changed() once one was made, move(axis, i) when a slider was moved. */
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
  const second = choice("second", [["", "none"], ...titled], (value) => {
    const chosen = value === "" ? null : Number(value);
    if (chosen === view.x) view.x = view.second ?? (chosen + 1) % axes.length;
    view.second = chosen;
  });
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
    /** Makes the view one that can be drawn, and shows it. */
    sync: () => {
      const values = points.map((point) => point.metrics[view.metric]).filter(isNumber);
      log.disabled = values.length === 0 || values.some((value) => value <= 0);
      view.log = view.log && !log.disabled;
      if (view.second === null) view.chart = "lines";
      metric.value = view.metric;
      x.value = view.x;
      second.value = view.second ?? "";
      second.disabled = kind.disabled = axes.length < 2;
      kind.value = view.chart;
      log.checked = view.log;
      sliders.forEach(({ label, show }, i) => {
        label.hidden = i === view.x || i === view.second;
        show(view.at[i]);
      });
    },
  };
}

/** Pictures of the points that the chart shows: by rows and columns as its axes where they fit, or in turn. */
function gallery({ axes, points, latin }, view, select, keys) {
  const body = el("div", { role: "group", "aria-label": "Pictures", keydown: keys });
  const buttons = new Map();
  const button = (point) => {
    const places = axes.map((axis, i) => `${axis.name} ${axis.text(point.at[i])}`).join(", ");
    const source = thumbnailOf(point), look = lookOfVerdict(point.verdict);
    const one = el("button", { type: "button", class: "picture", tabindex: "-1", title: `point ${point.point}: ${places}`,
                               "aria-label": `point ${point.point}, ${point.verdict}, ${places}`,
                               click: () => select(point) },
                   source ? el("img", { src: source, alt: "", loading: "lazy" })
                          : el("span", { style: `background: ${look.fill}; color: ${look.ink}` }, look.sign || "∅"));
    buttons.set(point, one);
    return one;
  };
  let marked = null, shown = [];
  const mark = (point) => {
    buttons.get(marked)?.removeAttribute("data-marked");
    (buttons.get(marked) ?? body.querySelector("[tabindex='0']"))?.setAttribute("tabindex", "-1");
    marked = point;
    buttons.get(point)?.setAttribute("data-marked", "");
    (buttons.get(point) ?? body.querySelector(".picture"))?.setAttribute("tabindex", "0");
  };
  const drawTurn = (part) => {
    buttons.clear();
    body.className = "turn";
    body.style.gridTemplateColumns = "";
    body.replaceChildren(...part.map((point) => el("figure", {}, button(point), el("small", {},
      [...(latin ? [`point ${point.point}`] : []), ...[view.x, view.second].filter((i) => i !== null)
        .map((i) => `${axes[i].text(point.at[i])} ${axes[i].unit}`.trim())].join(" · ")))));
    mark(marked);
  };
  const pages = pager(120, drawTurn);
  const drawRows = (x, second) => {
    buttons.clear();
    pages.element.hidden = true;
    body.className = "rows";
    body.style.gridTemplateColumns = `max-content repeat(${x.order.length}, minmax(0, 7rem))`;
    const at = new Map(shown.map((point) => [`${point.at[view.x]},${point.at[view.second]}`, point]));
    const label = (text) => el("small", {}, text);
    body.replaceChildren(
      ...[...second.order].reverse().flatMap((j) => [label(second.text(j)), ...x.order.map((i) =>
        (at.has(`${i},${j}`) ? button(at.get(`${i},${j}`)) : el("span")))]),
      label(""), ...x.order.map((i) => label(x.text(i))));
    mark(marked);
  };
  return {
    element: el("section", { class: "gallery" }, el("h2", {}, "Pictures"), body, pages.element),
    mark,
    focus: () => buttons.get(marked)?.focus(),
    show: () => {
      const [x, second] = [axes[view.x], axes[view.second] ?? null];
      shown = latin ? [...points]
        : points.filter(({ at }) => at.every((i, k) => k === view.x || k === view.second || i === view.at[k]));
      if (!latin && second && x.order.length <= 12 && second.order.length <= 40) {
        drawRows(x, second);
      } else {
        shown.sort((a, b) => (second && !latin ? second.rank[a.at[view.second]] - second.rank[b.at[view.second]] : 0)
          || x.rank[a.at[view.x]] - x.rank[b.at[view.x]]);
        pages.take(shown);
      }
    },
  };
}

/** All points, in a table that sorts and filters. */
function pointTable({ axes, metrics, points }, select) {
  const all = table([
    { name: "point", title: "Point", cell: ({ point }) => el("button", { type: "button", class: "link" }, String(point)) },
    ...axes.map(({ name, unit, values, text }, i) => ({
      name, unit, value: ({ at }) => values[at[i]], cell: ({ at }) => el("span", {}, text(at[i])) })),
    { name: "verdict", title: "Verdict", cell: ({ verdict }) => verdictMark(lookOfVerdict(verdict), verdict) },
    ...metrics.map(({ name, title, unit }, i) => ({ name, title, unit, value: (row) => row.metrics[i] ?? null })),
    { name: "reason", title: "Reason", cell: ({ reason }) => el("span", { class: "long" }, reason ?? "") },
  ], points, { label: "All points", perPage: 100, choose: select,
               rowClass: (row) => (isDone(row) ? null : "surprise") });
  const found = el("span", { role: "status" });
  const texts = new Map();
  const textOf = (row) => {
    if (!texts.has(row))
      texts.set(row, [...all.texts(row), ...axes.map((axis, i) => axis.text(row.at[i])), ...row.metrics]
        .join("\n").toLowerCase());
    return texts.get(row);
  };
  const search = el("input", { type: "search", name: "filter", input: () => filter() });
  const failed = el("input", { type: "checkbox", name: "failed", change: () => filter() });
  const filter = () => {
    const wanted = search.value.trim().toLowerCase();
    const kept = all.show((row) => (!failed.checked || !isDone(row)) && textOf(row).includes(wanted));
    found.textContent = kept === points.length ? count(kept, "point") : `${format(kept)} of ${count(points.length, "point")}`;
  };
  filter();
  return {
    element: el("section", { id: "points" }, el("h2", {}, "All points"),
      el("div", { class: "controls" }, el("label", {}, "Filter", search),
         el("label", {}, failed, "failed or missing only"), found), all.element),
    mark: all.mark,
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
  main.append(summary(sweep), el("dl", { class: "facts" }, fact("Points", format(counts.points)),
    fact("Done", format(counts.done)), fact("Failed", format(counts.failed), bad(counts.failed)),
    fact("Missing", format(counts.missing), bad(counts.missing))));

  const few = axes.length < 2 || axes[1].values.length <= 4;
  const view = { metric: 0, chart: few ? "lines" : "map", x: 0, second: axes.length < 2 || latin ? null : 1, log: false,
                 at: points[0].at };

  /** The view stands in the address, so that a link leads back to it. */
  const write = () => {
    const state = { metric: metrics[view.metric]?.name ?? "", chart: view.chart, x: axes[view.x].name,
                    second: axes[view.second]?.name ?? "", ...(view.log ? { log: "1" } : {}),
                    point: sweep.pointAt(view.at)?.point ?? "" };
    history.replaceState(null, "", `#${new URLSearchParams(state)}`);
  };
  const read = () => {
    const state = new URLSearchParams(location.hash.slice(1));
    const find = (all, key) => { const i = all.findIndex(({ name }) => name === state.get(key)); return i < 0 ? null : i; };
    if (!state.has("x")) return;
    view.metric = find(metrics, "metric") ?? view.metric;
    view.x = find(axes, "x") ?? view.x;
    view.second = find(axes, "second");
    if (view.second === view.x) view.second = null;
    view.chart = state.get("chart") === "map" && view.second !== null ? "map" : "lines";
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
  /** One step along the chart's axes; over the points in their order where there is no grid. */
  const step = (dx, dy) => {
    if (latin) {
      const y = axes[view.second] ? (one) => axes[view.second].place(one.at[view.second])
                                  : (one) => one.metrics[view.metric] ?? -Infinity;
      const order = [...points].sort(dx ? (a, b) => axes[view.x].place(a.at[view.x]) - axes[view.x].place(b.at[view.x])
                                        : (a, b) => y(a) - y(b));
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

  const place = chartPlace({ class: "keys", tabindex: "0", role: "application", "aria-label": "Chart: the arrow keys " +
    "select the next point along its axes", keydown: keys(() => {}) });
  const controls = viewControls(sweep, view, () => redraw(), (axis, i) =>
    selectAt(view.at.map((old, k) => (k === axis ? i : old))));
  const detail = detailPanel(sweep), rows = pointTable(sweep, select);
  const pictures = points.some(thumbnailOf) ? gallery(sweep, view, select, keys(() => pictures.focus())) : null;
  let drawn = null;
  const mark = () => {
    const point = sweep.pointAt(view.at);
    detail.show(point);
    rows.mark(point);
    pictures?.mark(point);
    if (drawn) place.change({ series: drawn.mark(point) });
    write();
  };
  const redraw = () => {
    controls.sync();
    if (metrics.length > 0) {
      drawn = (latin ? scatterChart : view.chart === "map" ? mapChart : linesChart)(sweep, view);
      place.show({ ...drawn, click: ({ data }) => data?.point && select(data.point) });
    }
    pictures?.show();
    mark();
  };

  const reasons = mishaps(points, select);
  if (reasons) main.append(reasons);
  main.append(el("div", { class: "explore" },
    el("div", {}, metrics.length > 0 ? el("section", {}, controls.element, place.element)
                                     : el("p", { class: "quiet" }, "No metrics were collected."),
       pictures?.element, rows.element),
    detail.element));
  read();
  redraw();
  addEventListener("hashchange", () => { read(); redraw(); });
});
