// The search box: all words of the question must be in a part of a page. It reads search-index.js when it is first used,
// which also works for pages that are opened from a disk.
"use strict";
(() => {
  const shownAtMost = 60;
  const box = document.createElement("input");
  box.type = "search";
  box.id = "question";
  box.placeholder = "Search commands, keys, names, words";
  const list = document.createElement("div");
  list.id = "answers";
  list.hidden = true;
  document.getElementById("titlearea").append(box);
  document.body.append(list);

  // How well a part answers: 0 is not at all. A title counts more than a text, a whole one more than a part of it. Commands
  // and keys come before names of C++ that are as near.
  function rank(words, [title, page, address, text]) {
    const name = title.toLowerCase(), all = `${name} ${page.toLowerCase()} ${text.toLowerCase()}`;
    if (!words.every((word) => all.includes(word))) return 0;
    const asked = words.join(" "), first = /^(commands|keys)/.test(address) ? 0.5 : 0;
    if (name === asked || name === `${asked}()`) return 5 + first;
    if (name.split(/[^\w.-]+/).includes(asked)) return 4 + first;
    if (name.split(/[^\w-]+/).some((part) => part.startsWith(asked))) return 3 + first;
    return (words.every((word) => name.includes(word)) ? 2 : 1) + first;
  }

  function element(kind, className, text) {
    const made = document.createElement(kind);
    made.className = className;
    made.textContent = text;
    return made;
  }

  function answer(words, [title, page, address, text]) {
    const link = element("a", "answer", "");
    link.href = address;
    link.append(element("b", "", title));
    if (page !== title) link.append(element("span", "page", page));
    const first = Math.max(0, text.toLowerCase().indexOf(words[0]) - 60);
    link.append(element("div", "excerpt", (first ? "\u2026" : "") + text.slice(first, first + 200)));
    return link;
  }

  function search() {
    const words = box.value.toLowerCase().split(/\s+/).filter(Boolean);
    list.hidden = words.length === 0;
    if (list.hidden) return;
    const found = searchIndex.map((part) => [rank(words, part), part]).filter(([good]) => good > 0);
    found.sort(([a], [b]) => b - a);
    const heading = `${found.length} found` + (found.length > shownAtMost ? `, the first ${shownAtMost}:` : "");
    list.replaceChildren(element("p", "", heading), ...found.slice(0, shownAtMost).map(([, part]) => answer(words, part)));
  }

  let loading = false;
  function load() {
    if (loading) return;
    loading = true;
    const script = document.createElement("script");
    script.src = "search-index.js";
    script.onload = () => {
      box.addEventListener("input", search);
      search();
    };
    document.body.append(script);
  }
  box.addEventListener("focus", load);
  list.addEventListener("click", () => { list.hidden = true; });  // also where the answer is on this page
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape") list.hidden = true;
    if (event.key === "Enter" && event.target === box) list.querySelector("a")?.click();
    if (event.key === "/" && event.target === document.body) {
      event.preventDefault();
      box.focus();
    }
  });

  const asked = new URLSearchParams(location.search).get("search");  // index.html?search=tool.radius
  if (asked) {
    box.value = asked;
    load();
  }
})();
