"use strict";
// Pages made of parts, about one run or two: maps (maps.js), sand in 3-D (sand_part.js), curves (curves.js), figures.

const valueWithUnit = (value, unit) => format(value) + (unit === "" || unit.startsWith("/") ? "" : "\u00a0") + unit;

/** The settings of a resolved scene, as "section.key" and value. */
function settingsOf(scene) {
  let section = "";
  const settings = new Map();
  for (const line of scene.split("\n")) {
    const head = /^\[(.*)\]$/.exec(line), entry = /^(\S+) = (.*)$/.exec(line);
    if (head) section = `${head[1]}.`;
    else if (entry) settings.set(section + entry[1], entry[2]);
  }
  return settings;
}

/** Lines on what a page does not show, and why. */
const missingLines = (missing) => missing.map(({ name, sentence }) =>
  el("p", { class: "warning" }, el("strong", {}, `${name} is not shown`), `: ${sentence}`));

const drawFigures = ({ text, figures }) => [
  el("p", {}, text),
  figures.length
    ? table([{ name: "name", title: "Figure" }, { name: "value", title: "Value" }, { name: "unit", title: "Unit" }],
            figures, { label: "Figures" }).element
    : null];

/** The sections of parts, each drawn by its kind: [id, title, draw]. */
function sectionsOf(parts) {
  const kinds = { maps: drawMaps, sand: drawSand, traces: drawTraces, profiles: drawProfiles, figures: drawFigures };
  return parts.map((part, i) => [`part-${i + 1}`, part.title, () => kinds[part.kind](part)]);
}

function drawSections(main, sections) {
  main.append(contents(sections));
  for (const [id, title, draw] of sections)
    main.append(el("section", { id }, el("h2", {}, title), ...draw().filter(Boolean)));
}
