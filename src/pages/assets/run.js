"use strict";
// One run: its figures, picture, curves, profiles and error (parts.js), its settings and where it comes from.

drawPage((data, main) => {
  const { figures, parts, missing, scene, provenance } = data;
  main.append(el("h1", {}, document.title),
              el("dl", { class: "facts" },
                 ...figures.map(({ name, value, unit }) => fact(name, valueWithUnit(value, unit)))),
              ...missingLines(missing));
  const pairs = (map, title, label) => () =>
    [table([{ name: "name", title }, { name: "value", title: "Value" }],
           [...map].map(([name, value]) => ({ name, value })), { label }).element];
  drawSections(main, [...sectionsOf(parts),
                      ["settings", "Settings", pairs(settingsOf(scene), "Setting", "Settings of the scene")],
                      ["file", "File", pairs(new Map(provenance), "Entry", "Origin of the file")]]);
});
afterDrawing();
