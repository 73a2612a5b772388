"use strict";
// A comparison: the outcome and its checks, maps and traces (parts.js), and what is known about the files.

// ---- The files.

/** Rows of the entries of golden and run, from two maps. */
const rowsOf = (golden, run) => [...new Set([...golden.keys(), ...run.keys()])].map((name) =>
  ({ name, golden: golden.get(name) ?? null, run: run.get(name) ?? null }));

function sideTable(rows, title, label) {
  return table([{ name: "name", title }, { name: "golden", title: titleOf("golden") },
                { name: "run", title: titleOf("run") }],
               rows, { label, rowClass: (row) => (row.name !== "file" && row.golden !== row.run ? "surprise" : null) })
    .element;
}

function drawFiles({ golden, run }) {
  const parts = [sideTable(rowsOf(new Map([["file", golden.name], ...golden.provenance]),
                                  new Map([["file", run.name], ...run.provenance])), "Entry", "Files")];
  if (golden.scene && run.scene) {
    const changed = rowsOf(settingsOf(golden.scene), settingsOf(run.scene)).filter((row) => row.golden !== row.run);
    parts.push(changed.length ? el("h3", {}, "Settings that differ") : el("p", {}, "The scenes have the same settings."),
               changed.length ? sideTable(changed, "Setting", "Settings that differ") : null);
  }
  return parts;
}

// ---- The page.

function checkTable(checks) {
  const failedFirst = [...checks].sort((a, b) => a.passed - b.passed);
  return table([
    { name: "name", title: "Check" },
    { name: "passed", title: "Verdict", value: (check) => (check.passed ? "passed" : "failed"),
      cell: (check) => el("span", { class: check.passed ? "good" : "bad" }, check.passed ? "passed" : "failed") },
    { name: "measured", title: "Measured", cell: (check) => format(check.measured) },
    { name: "limit", title: "Limit", cell: (check) => format(check.limit) }, { name: "unit", title: "Unit" },
    { name: "sentence", title: "What was found" },
  ], failedFirst, { label: "Checks", rowClass: (check) => (check.passed ? null : "surprise") }).element;
}

const toleranceTable = (tolerances) => table([
  { name: "name", title: "Tolerance" }, { name: "value", title: "Value", cell: ({ value }) => format(value) },
  { name: "unit", title: "Unit" }, { name: "source", title: "Set by" },
], tolerances, { label: "Tolerances", rowClass: ({ source }) => (source === "default" ? null : "surprise") }).element;

drawPage((data, main) => {
  const { checks, parts, missing, tolerances } = data;
  for (const side of ["golden", "run"]) if (data[side].label) sideLabels.set(side, data[side].label);
  const failed = checks.filter((check) => !check.passed);
  const measured = ["final height", "height change", "force", "picture"]
    .map((name) => checks.find((check) => check.name === name)).filter((check) => check && isNumber(check.measured));
  main.append(
    el("h1", {}, document.title), machineLine(data.machine),
    el("dl", { class: "facts" },
       fact("Verdict", data.passed ? "equal" : "different", data.passed ? "good" : "bad"),
       fact("Failed checks", `${failed.length} of ${checks.length}`, failed.length ? "bad" : "good"),
       ...measured.map((check) => fact(`Largest difference: ${check.name}`, valueWithUnit(check.measured, check.unit),
                                       check.passed ? null : "bad"))),
    ...missingLines(missing),
    data.settings ? el("p", {}, el("strong", {}, "Settings that differ: "), data.settings) : "",
    data.passed ? el("p", {}, "All differences are within their limits.") : "");
  drawSections(main, [["checks", "Checks", () => [checkTable(checks), tolerances.length ? toleranceTable(tolerances) : null]],
                      ...sectionsOf(parts), ["files", "Files", () => drawFiles(data)]]);
});
afterDrawing();
