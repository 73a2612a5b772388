"use strict";
// The answer of a bench: for each error that one may bear, the fastest setting that keeps it, and the curves behind it.

/** A time as people say it. */
const timeText = (seconds) => {
  const [factor, unit] = seconds < 1e-3 ? [1e6, "µs"] : seconds < 1 ? [1e3, "ms"] : [1, "s"];
  return `${withMinus(String(Number((factor * seconds).toPrecision(2))))} ${unit}`;
};
const percentText = (fraction) => `${Number((100 * fraction).toPrecision(2))} %`;

function adviceTable(advice, askedErrors) {
  const cellOf = ({ settings }) => (error) => {
    const setting = settings.find((one) => one.error <= error);
    if (!setting) return "–";
    return el("div", {}, el("strong", {}, timeText(setting.seconds), setting.disturbed ? " *" : ""), " ",
              el("small", {}, `${setting.series}, ${setting.label}`));
  };
  const reached = ({ settings }) => Math.min(...settings.map(({ error }) => error));
  const rows = askedErrors.map((error) => el("tr", {}, el("th", { scope: "row" }, percentText(error)),
                                             ...advice.map((one) => el("td", {}, cellOf(one)(error)))));
  const best = el("tr", {}, el("th", { scope: "row" }, "least error"),
                  ...advice.map((one) => el("td", {}, percentText(reached(one)))));
  return el("div", { class: "scroll" }, el("table", {},
    el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "Error at most"),
                       ...advice.map((one) => el("th", { scope: "col", title: one.problems.join("; ") }, one.subject)))),
    el("tbody", {}, ...rows, best)));
}

/** Each subject's settings: points, and the front as a line. */
function adviceChart(advice) {
  const all = advice.flatMap(({ settings }) => settings).filter(({ error }) => error > 0);
  const x = scaleOf(all.map(({ seconds }) => seconds), { logarithmic: true, title: "time of a run", unit: "s" });
  const y = scaleOf(all.map(({ error }) => error), { logarithmic: true, title: "error" });
  const series = advice.flatMap(({ subject, settings }, i) => {
    const { colour, symbol } = lookOf(i);
    const place = (one) => ({ value: [x.at(one.seconds), y.at(one.error)], one });
    const drawn = settings.filter(({ error }) => error > 0), front = drawn.filter((one) => one.front);
    return [
      { type: "scatter", name: subject, symbol: outlined(symbol), symbolSize: 5, data: drawn.map(place),
        itemStyle: { color: colour, opacity: 0.3 } },
      { type: "line", name: subject, step: "end", symbol: outlined(symbol), symbolSize: 8, data: front.map(place),
        ...lineStyles({ colour }) },
    ];
  });
  const tip = ({ series: name, label, seconds, error }) =>
    tipOf(`${name}, ${label}`, [["time", timeText(seconds)], ["error", percentText(error)]]);
  return chart({
    title: "Error against run time",
    note: "Lower left is better. The lines join the settings that no other setting beats in both; faint points are beaten.",
    legend: advice.map(({ subject }, i) => ({ name: subject, series: true, ...lookOf(i) })),
    height: "13rem",
    option: { ...chartBase((item) => item.data?.one && tip(item.data.one)), xAxis: x.axis,
              yAxis: { ...y.axis, nameGap: 46 }, series },
  });
}

/** The first part of the page. */
function adviceSection(advice, askedErrors) {
  return el("section", { id: "advice", class: "answer" },
    el("h2", {}, "For this error, take this setting"),
    el("p", {}, "The fastest setting that keeps the error, and how long its whole run takes here. The error is the " +
      "misplaced sand, as a fraction of the sand that moves: against exact shapes (heaps, the worst of several), or " +
      "against the same stroke in much finer steps."),
    adviceTable(advice, askedErrors), el("div", { class: "charts" }, adviceChart(advice)));
}
