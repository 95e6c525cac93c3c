// SPDX-License-Identifier: MIT
// Tables that sort by a column when its heading is pressed. Without this they stand in the order in which they were written.
"use strict";

(() => {
  const number = /^[-\u2212+]?\d[\d\u202f]*(\.\d+)?(e[-+]?\d+)?/;

  // What a cell sorts by: the number it begins with ("1 a", "0.91 ± 0.02"), its text, or nothing.
  function valueOf(cell) {
    const text = cell ? cell.textContent.trim() : "";
    if (text === "" || text === "–") return null;
    const found = number.exec(text);
    return found ? Number(found[0].replaceAll("\u202f", "").replace("\u2212", "-")) : text;
  }

  function compare(a, b) {
    return typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), "en");
  }

  function sortBy(table, column, descending) {
    const body = table.tBodies[0];
    const rows = [...body.rows].map((row) => ({ row, value: valueOf(row.cells[column]) }));
    rows.sort((a, b) => {
      if (a.value === null || b.value === null) return (a.value === null) - (b.value === null);  // undefined ones last, either way
      return descending ? compare(b.value, a.value) : compare(a.value, b.value);
    });
    body.append(...rows.map(({ row }) => row));
  }

  function press(table, head, column) {
    const descending = head.getAttribute("aria-sort") === "ascending";
    for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", descending ? "descending" : "ascending");
    sortBy(table, column, descending);
  }

  for (const table of document.querySelectorAll("table.sortable")) {
    [...table.tHead.rows[0].cells].forEach((head, column) => {
      if ([...table.tBodies[0].rows].every((row) => valueOf(row.cells[column]) === null)) return;
      const button = document.createElement("button");
      button.type = "button";
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => press(table, head, column));
    });
  }
})();
