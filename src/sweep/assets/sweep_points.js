"use strict";
// The points in a sweep's report: those without results, the selected one with its command line, pictures, and a table
// of all.

const thumbnailOf = ({ thumbnail }) =>
  (typeof thumbnail === "string" && thumbnail.startsWith("data:image/png;base64,") ? thumbnail : null);
const hasFailed = ({ verdict }) => verdict === "unstable" || verdict === "refused";
const isDone = ({ verdict }) => verdict !== "missing" && !hasFailed({ verdict });

/** Points that failed or are missing, with their reasons; only as many as one can read. */
function mishaps(points, select) {
  const groups = new Map();
  for (const point of points.filter((one) => !isDone(one))) {
    const key = JSON.stringify([point.verdict, point.reason]);
    groups.set(key, [...(groups.get(key) ?? []), point]);
  }
  if (groups.size === 0) return null;
  const [most, each] = [8, 12];
  const order = [...verdicts.keys()], rank = ([{ verdict }]) => order.indexOf(verdict);
  const lines = [...groups.values()].sort((a, b) => rank(a) - rank(b)).slice(0, most).map((own) => el("li", {},
    verdictMark(lookOfVerdict(own[0].verdict), own[0].verdict), own[0].reason ? `: ${own[0].reason} ` : " ",
    el("span", { class: "quiet" }, own.length === 1 ? "Point " : `${format(own.length)} points: `),
    ...own.slice(0, each).flatMap((point, i) => [i ? ", " : "",
      el("button", { type: "button", class: "link", click: () => select(point) }, String(point.point))]),
    own.length > each ? ", …" : ""));
  return el("div", { class: "warning mishaps", role: "region", "aria-label": "Points without results" },
            el("ul", {}, ...lines),
            groups.size > most ? el("p", {}, `${count(groups.size - most, "more reason")} in the table.`) : null);
}

/** The command line and a button that copies it, or selects it where the browser does not allow copying. */
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

/** The panel of the selected point. */
function detailPanel({ axes, metrics }) {
  const body = el("div"), said = el("p", { class: "unseen", "aria-live": "polite" });
  const rows = (pairs) => el("dl", {}, ...pairs.flatMap(([name, value, unit, definition]) =>
    [el("dt", { title: definition ?? null }, name), el("dd", {}, value, unit ? el("small", {}, ` ${unit}`) : null)]));
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
        el("h3", {}, "Axes"), rows(values), el("h3", {}, "Command"), commandLine(point.command),
        metrics.length > 0 && el("h3", {}, "Metrics"), rows(metrics.map(({ title, unit, definition }, i) =>
          [title, format(point.metrics[i] ?? null), isNumber(point.metrics[i]) && unit, definition])),
      ].filter(Boolean));
    },
  };
}

/** Pictures of the chart's points: in rows and columns as its axes where they fit, otherwise one after the other. */
function gallery(sweep, view, select, keys) {
  const { axes, latin } = sweep;
  const arrangement = el("p", { class: "quiet" });
  const body = el("div", { role: "group", "aria-label": "Pictures", keydown: keys });
  const buttons = new Map();
  const button = (point) => {
    const positions = axes.map((axis, i) => `${axis.name} ${axis.text(point.at[i])}`).join(", ");
    const source = thumbnailOf(point), look = lookOfVerdict(point.verdict);
    const one = el("button", { type: "button", class: "picture", tabindex: "-1", click: () => select(point),
                               title: `point ${point.point}: ${positions}`,
                               "aria-label": `point ${point.point}, ${point.verdict}, ${positions}` },
                   source ? el("img", { src: source, alt: "", loading: "lazy" })
                          : el("span", { style: `background: ${look.fill}; color: ${look.ink}` }, look.sign || "∅"));
    buttons.set(point, one);
    return one;
  };
  // All pictures get the shape of the first one.
  const first = new Image();
  first.onload = () => body.style.setProperty("--aspect", first.naturalWidth / first.naturalHeight);
  first.src = thumbnailOf(sweep.points.find(thumbnailOf));
  let marked = null, shown = [];
  const mark = (point) => {
    buttons.get(marked)?.removeAttribute("data-marked");
    (buttons.get(marked) ?? body.querySelector("[tabindex='0']"))?.setAttribute("tabindex", "-1");
    marked = point;
    if (body.className === "turn") pages.reveal(point);
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
    body.style.gridTemplateColumns = `max-content repeat(${x.order.length}, minmax(0, 10rem))`;
    const at = new Map(shown.map((point) => [`${point.at[view.x]},${point.at[view.second]}`, point]));
    const label = (text) => el("small", {}, text);
    body.replaceChildren(
      ...[...second.order].reverse().flatMap((j) => [label(second.text(j)), ...x.order.map((i) =>
        (at.has(`${i},${j}`) ? button(at.get(`${i},${j}`)) : el("span")))]),
      label(""), ...x.order.map((i) => label(x.text(i))));
    mark(marked);
  };
  return {
    element: el("section", { class: "gallery" }, el("h2", {}, "Pictures"), arrangement, body, pages.element),
    mark,
    focus: () => buttons.get(marked)?.focus(),
    show: () => {
      const x = axes[view.x], rows = latin ? null : axes[view.second] ?? null;
      shown = sliceOf(sweep, view).shown;
      if (rows && x.order.length <= 12 && rows.order.length <= 40) {
        arrangement.textContent =
          `From left to right: ${withUnit(x.name, x.unit)}. From bottom to top: ${withUnit(rows.name, rows.unit)}.`;
        drawRows(x, rows);
        return;
      }
      arrangement.textContent = `In the order of ${[rows, x].filter(Boolean).map(({ name }) => name).join(" and ")}.`;
      const byRow = (a, b) => (rows ? rows.rank[a.at[view.second]] - rows.rank[b.at[view.second]] : 0);
      pages.take([...shown].sort((a, b) => byRow(a, b) || x.rank[a.at[view.x]] - x.rank[b.at[view.x]]));
    },
  };
}

/** All points, in a table that sorts and filters. */
function pointTable({ axes, metrics, points }, select) {
  const all = table([
    { name: "point", title: "Point",
      cell: ({ point }) => el("button", { type: "button", class: "link" }, String(point)) },
    ...axes.map(({ name, unit, values, text }, i) => ({
      name, unit, value: ({ at }) => values[at[i]], cell: ({ at }) => el("span", {}, text(at[i])) })),
    { name: "verdict", title: "Verdict", cell: ({ verdict }) => verdictMark(lookOfVerdict(verdict), verdict) },
    ...metrics.map((metric, i) => ({ ...metric, value: (row) => row.metrics[i] ?? null })),
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
    found.textContent = (kept < points.length ? `${format(kept)} of ` : "") + count(points.length, "point");
  };
  filter();
  return {
    element: el("section", { id: "points" }, el("h2", {}, "All points"),
      el("div", { class: "controls" }, el("label", {}, "Filter", search),
         el("label", {}, failed, "failed or missing only"), found), all.element),
    mark: all.mark,
  };
}
