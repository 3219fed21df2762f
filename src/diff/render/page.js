"use strict";
(function () {
  const rows = Array.from(document.querySelectorAll("#changes tbody tr"));
  const shapes = Array.from(document.querySelectorAll("#drawings [data-part]"));
  const pictures = Array.from(document.querySelectorAll("#drawings svg"));
  const boxes = Array.from(document.querySelectorAll("#filter input"));
  const byPart = new Map();
  for (const shape of shapes) {
    const part = shape.dataset.part;
    if (!byPart.has(part)) byPart.set(part, []);
    byPart.get(part).push(shape);
  }
  let chosen = null;

  // Scrolls a panel, and nothing around it, until something in it can be seen.
  function reveal(element) {
    const panel = element.closest("section");
    const frame = panel.getBoundingClientRect();
    const at = element.getBoundingClientRect();
    if (at.top < frame.top + 40 || at.bottom > frame.bottom) {
      panel.scrollTop += at.top - frame.top - Math.max(40, (frame.height - at.height) / 2);
    }
  }

  function choose(part, from) {
    chosen = part;
    for (const row of rows) row.classList.toggle("on", row.dataset.part === part);
    for (const shape of shapes) shape.classList.toggle("on", shape.dataset.part === part);
    for (const picture of pictures) {
      picture.classList.toggle("choice", part !== null && picture.querySelector(".on") !== null);
    }
    if (part === null) return;
    if (from !== "drawing") {
      const shape = (byPart.get(part) || []).find((one) => !one.classList.contains("left-out"));
      if (shape) reveal(shape.closest("figure"));
    }
    const row = rows.find((one) => one.dataset.part === part && !one.classList.contains("left-out"));
    if (row) reveal(row);
  }

  function shown() {
    return rows.filter((row) => !row.classList.contains("left-out"));
  }

  function step(by) {
    const list = shown();
    if (list.length === 0) return;
    const at = list.findIndex((row) => row.classList.contains("on"));
    const next = at < 0 ? (by > 0 ? 0 : list.length - 1) : (at + by + list.length) % list.length;
    choose(list[next].dataset.part, "keys");
  }

  function filter() {
    const classes = new Set(boxes.filter((box) => box.checked).map((box) => box.value));
    const kept = new Set();
    for (const row of rows) {
      const out = !Array.from(classes).some((name) => row.classList.contains(name));
      row.classList.toggle("left-out", out);
      if (!out) kept.add(row.dataset.part);
    }
    const listed = new Set(rows.map((row) => row.dataset.part));
    for (const shape of shapes) {
      const part = shape.dataset.part;
      const unchanged = shape.classList.contains("same");
      shape.classList.toggle("left-out", !unchanged && listed.has(part) && !kept.has(part));
    }
  }

  for (const row of rows) {
    row.addEventListener("click", () => choose(row.dataset.part, "list"));
  }
  for (const shape of shapes) {
    shape.addEventListener("click", () => choose(shape.dataset.part, "drawing"));
  }
  for (const box of boxes) box.addEventListener("change", filter);
  document.getElementById("filter").addEventListener("submit", (event) => event.preventDefault());
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === "j" || event.key === "ArrowDown") step(1);
    else if (event.key === "k" || event.key === "ArrowUp") step(-1);
    else if (event.key === "Escape") choose(null, "keys");
    else return;
    event.preventDefault();
  });
  filter();
})();
