"use strict";
// What every page shares (but for its charts, see plot.js): elements, numbers, tables, and drawPage(), which
// says on <html data-ready data-charts data-errors> how it went. Text from the data only becomes text nodes.

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

/** An element; children are elements or text, null ones are left out. */
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
const powerOfTen = (exponent) =>
  "10" + String(exponent).replace(/[-0-9]/g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));
const withMinus = (text) => text.replace("-", "−");

const grouped = (value) =>
  withMinus(Math.abs(value) < 1e4 ? String(value) : String(value).replace(/\B(?=(\d{3})+$)/g, "\u202f"));

/** A number as text: to four digits, or in full where it is `whole`; "–" for none. */
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

/** The label of a tick: as short as it can be. */
function tickText(value) {
  const size = Math.abs(value);
  const short = Number(value.toPrecision(6));
  if (size === 0 || (size >= 0.9999e-4 && size < 9.999e3)) return withMinus(String(short));
  const [mantissa, exponent] = short.toExponential().split("e");
  const power = powerOfTen(Number(exponent));
  return mantissa === "1" ? power : `${withMinus(mantissa)}×${power}`;
}

const withUnit = (title, unit) => (unit ? `${title} (${unit})` : title);

// ---- Tables.

/**
 * A table that sorts by a click (or Enter) on a column's head: numbers by size, text by its order, none last.
 * columns: {name, title, unit, value(row) to sort by, cell(row) to show}; only name is needed.
 * Returns its element, and show(keep), which hides the rows that keep(row) refuses.
 */
function table(columns, rows, { label, rowClass = () => null } = {}) {
  const valueOf = (column) => column.value ?? ((row) => row[column.name]);
  const kinds = columns.map((column) => {
    const values = rows.map(valueOf(column)).filter((value) => value !== null && value !== undefined);
    return { numeric: values.length > 0 && values.every(isNumber), whole: values.every(Number.isInteger) };
  });
  const lines = rows.map((row) => ({
    row,
    line: el("tr", { class: rowClass(row) }, ...columns.map((column, i) =>
      el("td", { class: kinds[i].numeric ? "number" : null },
         column.cell?.(row) ?? format(valueOf(column)(row), kinds[i].whole)))),
  }));
  const body = el("tbody", {}, ...lines.map(({ line }) => line));

  const sort = (column, head) => {
    const down = head.getAttribute("aria-sort") === "ascending";
    for (const other of heads) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const none = (value) => value === null || value === undefined;
    const order = (a, b) => (isNumber(a) && isNumber(b)
      ? a - b
      : String(a).localeCompare(String(b), "en", { numeric: true }));
    lines.sort((a, b) => {
      const [p, q] = [valueOf(column)(a.row), valueOf(column)(b.row)];
      if (none(p) || none(q)) return none(p) - none(q);
      return down ? order(q, p) : order(p, q);
    });
    body.append(...lines.map(({ line }) => line));
  };
  const heads = columns.map((column, i) => {
    const head = el("th", { scope: "col", class: kinds[i].numeric ? "number" : null });
    head.append(el("button", { type: "button", click: () => sort(column, head) }, column.title ?? column.name,
                   column.unit ? el("small", {}, ` ${column.unit}`) : null));
    return head;
  });
  return {
    element: el("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": label },
                el("table", {}, el("thead", {}, el("tr", {}, ...heads)), body)),
    show: (keep) => lines.forEach(({ row, line }) => { line.hidden = !keep(row); }),
  };
}

// ---- The page.

/** The machine and the build that measured, in a line. */
function machineLine(machine = {}) {
  const { cpu, cores, instruction_set, compiler, version, commit } = machine;
  const parts = [cpu, cores && `${cores} cores`, instruction_set, compiler,
                 version && `sandstroke ${version}`, commit && `commit ${commit}`];
  return el("p", { class: "machine" }, parts.filter(Boolean).join(" · "));
}

/** Links to the sections: [id, title]. */
const contents = (sections) =>
  el("ul", { class: "contents" }, ...sections.map(([id, title]) =>
    el("li", {}, el("a", { href: `#${id}` }, title))));

/** Reads the data, lets draw(data, main) fill the page, draws its charts, and says that it is ready. */
function drawPage(draw) {
  const status = document.documentElement.dataset;
  const main = document.getElementById("page");
  const resize = () => charts.forEach(({ drawn }) => drawn?.resize());
  const printing = (on) => () => {
    document.documentElement.classList.toggle("printing", on);
    resize();
  };
  try {
    draw(JSON.parse(document.getElementById("data").textContent), main);
    for (const one of charts) {
      one.drawn = echarts.init(one.canvas, null, { renderer: "svg" });
      one.drawn.setOption(one.option);
      new ResizeObserver(() => one.drawn.resize()).observe(one.canvas);
    }
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
