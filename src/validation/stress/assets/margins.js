"use strict";
// The answer of a stress test: how far loops are from their boundaries of stability.

/** A margin in words: how many times over. */
const timesText = (factor) => `${tickText(Number(factor.toPrecision(2)))} ×`;
/** The margin that is nearest to its boundary; null: there is no boundary. */
const worstOf = ({ margins }) =>
  margins.filter(({ factor }) => isNumber(factor)).reduce((worst, one) => (worst && worst.factor <= one.factor ? worst : one), null);

function marginTable(loops) {
  const settings = loops[0].margins;
  const cell = ({ what, value, boundary, factor, unit }) => {
    if (!isNumber(factor)) return el("td", {}, "any value is stable");
    if (!isNumber(boundary)) return el("td", { class: "bad" }, "no value is stable");
    const short = (number) => tickText(Number(number.toPrecision(3)));
    const rises = boundary === value ? what.startsWith("delay") : (boundary > value) === (factor > 1);  // the harmful way
    const limit = `${short(value)} now, stable ${rises ? "up to" : "from"} ${short(boundary)} ${unitText(unit)}`;
    return el("td", {}, el("strong", { class: factor >= 1 ? "good" : "bad" }, timesText(factor)), " ",
              el("small", {}, limit));
  };
  return el("div", { class: "scroll" }, el("table", {},
    el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "Margin"),
                       ...loops.map((loop) => el("th", { scope: "col", title: loop.settings }, loop.name)))),
    el("tbody", {}, ...settings.map(({ what }, i) => el("tr", {}, el("th", { scope: "row" }, what),
                                                        ...loops.map((loop) => cell(loop.margins[i])))))));
}

/** The first part of the page. */
function marginSection(loops) {
  const sentence = (loop) => el("li", {}, `${loop.name}: `, el("span", { class: loop.stable ? "good" : "bad" },
    loop.stable ? "stable" : "unstable"), loop.stable && worstOf(loop)
    ? `, ${timesText(worstOf(loop).factor)} from its nearest boundary, that of the ${worstOf(loop).what}` : "",
    el("small", {}, ` (${loop.settings})`));
  return el("section", { id: "margins", class: "answer" }, el("h2", {}, "Stable, and by how much"),
    el("ul", {}, ...loops.map(sentence)),
    el("p", {}, "The factor by which one setting alone may change for the worse until the loop of hand, device and " +
      "sand becomes unstable. The boundary is where an eigenvalue of the exact tick leaves the unit circle. " +
      "A delay counts with the tick in which the force acts: 14 ticks late is 15 times none."),
    marginTable(loops));
}
