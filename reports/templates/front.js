// SPDX-License-Identifier: BSD-3-Clause
// Makes the list of cases sortable and searchable by Tabulator. Without scripts the list stays a plain table.
"use strict";
(() => {
  const list = document.getElementById("list"), tools = document.getElementById("tools");
  const find = document.getElementById("find"), word = document.getElementById("word"), subject = document.getElementById("subject");
  const heads = [...list.tHead.rows[0].cells].map((cell) => cell.textContent);
  const keys = ["title", "word", "engines", "used", "cpu", "since"];
  const rows = [...list.tBodies[0].rows].map((row, id) => {
    const cells = [...row.cells];
    return { id, subject: row.dataset.subject, title: cells[0].textContent, word: row.dataset.word, engines: cells[2].textContent, used: +row.dataset.used, cpu: +row.dataset.cpu,
      since: row.dataset.since, link: cells[0].querySelector("a").getAttribute("href"), text: row.textContent.toLowerCase(), cells };
  });
  if (!rows.length) return;
  for (const [box, key] of [[word, "word"], [subject, "subject"]])
    for (const value of new Set(rows.map((row) => row[key]))) box.add(new Option(value, value));

  // Elements are moved as they are: no text of the results is parsed a second time.
  const shown = (n) => (cell) => { const box = document.createElement("div"); box.append(...cell.getRow().getData().cells[n].cloneNode(true).childNodes); return box; };
  const least = [0, 1, 4, 2, 3, 5], width = [undefined, 220, 190, 130, 80, 76];  // the first goes last where the screen is narrow
  const holder = document.createElement("div");
  list.replaceWith(holder);
  const table = new Tabulator(holder, {
    data: rows, layout: "fitColumns", responsiveLayout: "hide", renderVertical: "basic", groupBy: "subject", groupToggleElement: "header", groupStartOpen: true, headerSortClickElement: "header",
    groupHeader: (value, count) => { const box = document.createElement("span"); box.textContent = `${value} · ${count}`; return box; },
    columns: keys.map((field, n) => ({ title: heads[n], field, formatter: shown(n), responsive: least[n], widthGrow: n ? 0 : 1, minWidth: n ? 60 : 150, width: width[n], sorter: field === "used" || field === "cpu" ? "number" : "string",
      headerSortStartingDir: field === "used" || field === "cpu" ? "desc" : "asc", hozAlign: field === "cpu" ? "right" : "left", variableHeight: true })),
  });

  let at = -1, open = true;
  const visible = () => table.getRows("active").filter((row) => row.getElement().isConnected);
  const go = (step) => {
    const all = visible();
    if (!all.length) return;
    all[at]?.getElement().classList.remove("here");
    at = Math.min(Math.max(at + step, 0), all.length - 1);
    all[at].getElement().classList.add("here");
    all[at].getElement().scrollIntoView({ block: "nearest" });
  };
  const filter = () => {
    const words = find.value.toLowerCase().split(/\s+/).filter(Boolean);
    document.querySelector(".tabulator-row.here")?.classList.remove("here");
    at = -1;
    table.setFilter((row) => words.every((part) => row.text.includes(part)) && (!word.value || row.word === word.value) && (!subject.value || row.subject === subject.value));
    document.getElementById("shown").textContent = `${table.getDataCount("active")} of ${rows.length}`;
  };
  table.on("tableBuilt", () => { tools.hidden = false; filter(); });
  for (const box of [find, word, subject]) box.addEventListener("input", filter);
  tools.addEventListener("submit", (event) => event.preventDefault());
  document.getElementById("fold").addEventListener("click", (event) => {
    open = !open;
    table.setGroupStartOpen(open);
    table.setGroupBy(false);  // else groups stay as they were
    table.setGroupBy("subject");
    event.target.textContent = open ? "Fold" : "Unfold";
  });
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Escape") { find.value = ""; find.blur(); filter(); return; }
    if (event.target === find && event.key === "Enter") { find.blur(); go(1); return; }
    if (event.target.matches("input, select, textarea")) return;
    if (event.key === "/") { event.preventDefault(); find.focus(); }
    else if (event.key === "j" || event.key === "k") go(event.key === "j" ? 1 : -1);
    else if (event.key === "Enter" && at >= 0 && !event.target.matches("a, button, summary")) location.href = visible()[at].getData().link;
  });
})();
