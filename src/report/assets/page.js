"use strict";
// Functions that all pages share (charts are in plot.js): elements, numbers, tables, and drawPage(), which says on
// <html data-ready data-charts data-errors> how it went. Text from the data only becomes text nodes.

const errors = { count: 0 };
const countError = () => {
  errors.count += 1;
  document.documentElement.dataset.errors = errors.count;
};
addEventListener("error", countError);
addEventListener("unhandledrejection", countError);
const consoleError = console.error;
console.error = (...values) => {
  countError();
  consoleError.apply(console, values);
};

/** An element. Children are elements or text; null children are left out. */
function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value !== null && value !== false) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

// ---- Numbers.
const isNumber = (value) => typeof value === "number" && Number.isFinite(value);
const raised = (exponent) => String(exponent).replace(/[-0-9]/g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));
const powerOfTen = (exponent) => `10${raised(exponent)}`;
const withMinus = (text) => text.replace("-", "−");

const grouped = (value) => {
  const [whole, ...rest] = String(value).split(".");
  return withMinus([Math.abs(value) < 1e4 ? whole : whole.replace(/\B(?=(\d{3})+$)/g, "\u202f"), ...rest].join("."));
};

/** A number as text: to four digits, or in full if it is `whole`; "–" for none. */
function format(value, whole = Number.isInteger(value)) {
  if (value === null || value === undefined) return "–";
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (!isNumber(value)) return String(value);
  const size = Math.abs(value);
  if (value === 0 || (whole && size < 1e9)) return grouped(value);
  if (size >= 1e-3 && size < 999.95) return withMinus(value.toPrecision(4));
  if (size >= 1 && size < 1e6) return grouped(Number(value.toPrecision(4)));
  const [mantissa, exponent] = value.toExponential(2).split("e");
  return `${withMinus(mantissa)}×${powerOfTen(Number(exponent))}`;
}

/** A setting as text: as it was given, up to six digits. */
function exact(value) {
  const size = Math.abs(value);
  return size === 0 || (size >= 1e-4 && size < 1e9) ? grouped(Number(value.toPrecision(6))) : tickText(value);
}

/** The label of a tick: as short as it can be. */
function tickText(value) {
  const size = Math.abs(value);
  const short = Number(value.toPrecision(6));
  if (size === 0 || (size >= 0.9999e-4 && size < 9.999e3)) return withMinus(String(short));
  const [mantissa, exponent] = short.toExponential().split("e");
  const power = powerOfTen(Number(exponent));
  return mantissa === "1" ? power : `${withMinus(mantissa)}×${power}`;
}

/** A unit as it is printed: um as µm, m^3 as m³. */
const unitText = (unit) => unit.replace(/^um$/, "µm").replace(/\^(-?\d+)/g, (all, power) => raised(power));
const withUnit = (title, unit) => (unit ? `${title} (${unit})` : title);
const count = (n, one, many = `${one}s`) => `${format(n)} ${n === 1 ? one : many}`;
/** Orders text; numbers within it by size. */
const collator = new Intl.Collator("en", { numeric: true });

// ---- Tables.

/**
 * Shows rows page by page, `perPage` at a time: draw(part) shows a part. Returns its element; take(rows); and
 * reveal(row), which turns to the page of a row.
 */
function pager(perPage, draw) {
  let rows = [], start = 0;
  const turn = (pages) => () => {
    start = Math.max(0, Math.min(start + pages * perPage, rows.length - 1));
    show();
  };
  const text = el("span", { role: "status" });
  const [back, on] = [el("button", { type: "button", click: turn(-1) }, "‹ previous"),
                      el("button", { type: "button", click: turn(1) }, "next ›")];
  const element = el("div", { class: "controls pager" }, back, text, on);
  const show = () => {
    const end = Math.min(start + perPage, rows.length);
    element.hidden = rows.length <= perPage;
    text.textContent = `${format(start + 1)} to ${format(end)} of ${format(rows.length)}`;
    back.disabled = start === 0;
    on.disabled = end === rows.length;
    draw(rows.slice(start, end));
  };
  return {
    element,
    take: (all) => { rows = all; start = 0; show(); },
    reveal: (row) => {
      const i = rows.indexOf(row), first = i - (i % perPage);
      if (i < 0 || first === start) return;
      start = first;
      show();
    },
  };
}

/**
 * A table that sorts by a click (or Enter) on a column's head: numbers by size, text in order, empty cells last.
 * columns: {name, title, unit, value(row) to sort by, cell(row) to show}; only name is needed. `perPage` rows are shown
 * at a time; choose(row) is called for the row that is clicked.
 * Returns its element; show(keep), which keeps the rows for which keep(row) is true and returns how many; mark(row),
 * which highlights a row and brings it into sight; and texts(row), the texts of its cells.
 */
function table(columns, rows, { label, rowClass = () => null, perPage = Infinity, choose = null } = {}) {
  const valueOf = (column) => column.value ?? ((row) => row[column.name]);
  const kinds = columns.map((column) => {
    const values = rows.map(valueOf(column)).filter((value) => value !== null && value !== undefined);
    return { numeric: values.length > 0 && values.every(isNumber), whole: values.every(Number.isInteger) };
  });
  const textOf = (row, i) => format(valueOf(columns[i])(row), kinds[i].whole);
  let sorted = [...rows], keep = () => true, marked = null;
  const lines = new Map();  // made when first shown
  const lineOf = (row) => {
    if (!lines.has(row))
      lines.set(row, el("tr", { class: rowClass(row), click: choose && (() => choose(row)) },
        ...columns.map((column, i) =>
          el("td", { class: kinds[i].numeric ? "number" : null }, column.cell?.(row) ?? textOf(row, i)))));
    lines.get(row).toggleAttribute("data-marked", row === marked);
    return lines.get(row);
  };
  const body = el("tbody");
  const pages = pager(perPage, (part) => body.replaceChildren(...part.map(lineOf)));
  const show = () => {
    const kept = sorted.filter(keep);
    pages.take(kept);
    return kept.length;
  };

  const sort = (column, head) => {
    const down = head.getAttribute("aria-sort") === "ascending";
    for (const other of heads) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const none = (value) => value === null || value === undefined;
    const order = (a, b) => (isNumber(a) && isNumber(b) ? a - b : collator.compare(String(a), String(b)));
    sorted.sort((a, b) => {
      const [p, q] = [valueOf(column)(a), valueOf(column)(b)];
      if (none(p) || none(q)) return none(p) - none(q);
      return down ? order(q, p) : order(p, q);
    });
    show();
  };
  const heads = columns.map((column, i) => {
    const title = column.title ?? column.name;
    const head = el("th", { scope: "col", class: kinds[i].numeric ? "number" : null,
                            title: column.definition ?? null,
                            style: `min-width: ${Math.min(title.length + 4, 20)}ch` });
    head.append(el("button", { type: "button", click: () => sort(column, head) }, title,
                   column.unit ? el("small", {}, ` ${column.unit}`) : null));
    return head;
  });
  show();
  const head = el("thead", {}, el("tr", {}, ...heads));
  const box = el("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": label },
                 el("table", { class: choose && "choice" }, head, body));
  /** Scrolls within the box, not the page: the reader may look at something else there. */
  const reveal = (line) => {
    const low = line.offsetTop + line.offsetHeight - box.clientHeight, high = line.offsetTop - head.offsetHeight;
    if (box.scrollTop < low || box.scrollTop > high) box.scrollTop = (low + high) / 2;
  };
  return {
    element: el("div", {}, box, perPage < rows.length ? pages.element : null),
    show: (wanted) => { keep = wanted; return show(); },
    mark: (row) => {
      if (row === marked) return;
      lines.get(marked)?.removeAttribute("data-marked");
      marked = row;
      pages.reveal(row);
      const line = lines.get(row);
      line?.setAttribute("data-marked", "");
      if (line?.isConnected) reveal(line);
    },
    texts: (row) => columns.map((column, i) => textOf(row, i)),
  };
}

// ---- The page.

const charts = [];  // of plot.js

/** The machine and the build that measured, in a line. */
function machineLine(machine = {}) {
  const { cpu, cores, instruction_set, compiler, version, commit } = machine;
  const parts = [cpu, cores && `${cores} cores`, instruction_set, compiler,
                 version && `sandstroke ${version}`, commit && `commit ${commit}`];
  return el("p", { class: "machine" }, parts.filter(Boolean).join(" · "));
}

/** One of the figures that state the outcome. */
const fact = (name, value, kind = null) => el("div", {}, el("dt", {}, name), el("dd", { class: kind }, value));

/** Links to the sections: [id, title]. */
const contents = (sections) =>
  el("ul", { class: "contents" }, ...sections.map(([id, title]) =>
    el("li", {}, el("a", { href: `#${id}` }, title))));

/** Reads the data, lets draw(data, main) fill the page, draws its charts, and says that it is ready. */
function drawPage(draw) {
  const status = document.documentElement.dataset;
  const main = document.getElementById("page");
  const resize = () => charts.forEach(({ drawn }) => {
    drawn?.resize();
    drawn?.getZr().flush();  // at once: paper takes canvases as they are
  });
  const printing = (on) => () => {
    document.documentElement.classList.toggle("printing", on);
    resize();
  };
  try {
    draw(JSON.parse(document.getElementById("data").textContent), main);
    charts.filter(({ drawn }) => !drawn).forEach((one) => drawChart(one));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", resize);  // paints canvases anew
    addEventListener("beforeprint", printing(true));
    addEventListener("afterprint", printing(false));
  } catch (error) {
    console.error(error);
    main.prepend(el("p", { class: "warning" }, `This page could not be drawn in full: ${error.message}`));
  }
  status.charts = charts.filter(({ drawn }) => drawn).length;
  status.errors = errors.count;
  status.ready = "true";
}
