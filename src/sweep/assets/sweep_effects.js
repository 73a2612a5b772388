"use strict";
// What matters in a sweep: the effects of axes, and of pairs of axes, on the metric that is shown.

/** A list of effects; choose(axes) gets those of the one that was clicked. show(metric) fills it. */
function effectList({ axes, metrics, effects, idle, latin, points }, choose) {
  const element = el("section", { class: "answer effects" });
  const nameOf = ({ axes: own }) => own.map((i) => axes[i].name).join(" and ");
  const most = 8, least = 0.001;  // an effect below a thousandth of the variance is not worth a line
  /** Both numbers with as few digits as tell them apart. */
  const bothShort = (a, b) => {
    for (let digits = 3; ; digits += 1) {
      const texts = [a, b].map((value) => tickText(Number(value.toPrecision(digits))));
      if (texts[0] !== texts[1] || digits >= 6) return texts;
    }
  };
  const row = (effect, unit) => {
    const percent = 100 * effect.share, name = nameOf(effect);
    const text = effect.axes.length > 1 ? "together, beyond what each does alone"
      : `mean from ${bothShort(effect.least, effect.greatest).join(" to ")} ${unit}`.trim();
    return el("tr", {},
      el("th", { scope: "row" }, el("button", { type: "button", class: "link", click: () => choose(effect.axes) }, name)),
      el("td", { class: "number" }, `${tickText(Number(percent.toPrecision(percent < 1 ? 1 : 2)))} %`),
      el("td", { class: "share" }, el("div", { style: `width: ${Math.min(100, percent)}%` })),
      el("td", {}, el("small", {}, text)));
  };
  return {
    element,
    show: (index) => {
      const own = (effects[index] ?? []).filter((one) => !one.axes.some((i) => idle.includes(i))), metric = metrics[index];
      const values = points.map((point) => point.metrics[index]).filter(isNumber), lost = points.length - values.length;
      const nothing = values.length < 2 ? "Fewer than two points have a value."
        : (effects[index] ?? []).length === 0 ? "Nothing: it is the same at all points."
          : "No axis alone, and no two together, explain it; more points may.";
      const shown = own.filter(({ share }) => share >= least).slice(0, most);
      const rest = own.filter((one) => one.axes.length === 1 && !shown.includes(one) && !idle.includes(one.axes[0]));
      const notes = [
        idle.length > 0 && `Without any effect on any metric: ${idle.map((i) => axes[i].name).join(", ")}.`,
        shown.length > 0 && rest.length > 0 && `Less than these: ${rest.map(nameOf).join(", ")}.`,
        lost > 0 && shown.length > 0 &&
          `${format(lost)} of ${format(points.length)} points have no value, so an axis's part may hold some of another's.`,
        latin && shown.length > 0 && "A Latin hypercube shows each axis alone.",
      ].filter(Boolean);
      element.replaceChildren(el("h2", {}, `What matters for ${metric?.title ?? "the metrics"}`),
        shown.length > 0
          ? el("p", {}, "How much of the metric's variance over this sweep is due to an axis, or to two together. Other ranges " +
              "give other numbers. Click on a name to draw the metric over it.")
          : el("p", {}, nothing),
        ...(shown.length > 0 ? [el("table", {}, el("tbody", {}, ...shown.map((one) => row(one, metric.unit))))] : []),
        ...notes.map((note) => el("p", { class: "note" }, note)));
    },
  };
}
