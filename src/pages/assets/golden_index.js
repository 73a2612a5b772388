"use strict";
// All scenes that were checked against their golden entries: the worst first.

/** How near a passed scene came to its limits. */
const nearness = ({ worst }) => (worst === 0 || worst === null ? "the same"
  : `${worst < 0.001 ? "below 0.1" : tickText(Number((100 * worst).toPrecision(2)))} % of a limit`);

function sceneCard(scene) {
  const { name, passed, failed, picture, page } = scene;
  const verdict = el("span", { class: passed ? "good" : "bad" }, passed ? "passed" : "differs");
  const head = page ? el("a", { href: `${encodeURIComponent(name)}.html` }, name) : name;
  return el("figure", { class: "scene" },
    picture ? el("img", { src: picture, alt: `The run of ${name}` }) : el("div", { class: "none" }, "no picture"),
    el("figcaption", {}, head, ": ", verdict,
       ...(passed ? [el("small", {}, nearness(scene))]
                  : failed.map((check) => el("small", {}, `${check.name}: ${check.sentence}`)))));
}

drawPage((data, main) => {
  const { scenes } = data, bad = scenes.filter(({ passed }) => !passed).length;
  const seconds = scenes.reduce((sum, one) => sum + one.seconds, 0);
  main.append(
    el("h1", {}, document.title), machineLine(data.machine),
    el("section", { class: "answer" },
       el("h2", { class: bad ? "bad" : "good" }, bad ? `${count(bad, "scene")} of ${scenes.length} ${bad === 1 ? "differs" : "differ"}`
        : scenes.length === 1 ? "The scene is as it should be" : `All ${scenes.length} scenes are as they should be`),
       el("p", {}, `${tickText(Number(seconds.toPrecision(2)))} s of runs. The worst come first. A name is a link where a page ` +
         "shows the differences.")),
    el("div", { class: "scenes" }, ...scenes.map(sceneCard)));
});
