// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// On the site, a box above the table of all rules that shows only the rows with every word typed.
document.addEventListener("DOMContentLoaded", () => {
  const heading = document.querySelector('h2[id^="all-"][id$="-rules"]');
  const table = document.querySelector("table");
  if (!heading || !table) return;
  const box = document.createElement("input");
  box.type = "search";
  box.placeholder = "Filter the rules: mass, joint limit, error ...";
  box.setAttribute("aria-label", "Filter the rules");
  box.style.cssText = "width: 100%; padding: .5em; font: inherit; border: 1px solid";
  heading.after(box);
  const rows = [...table.querySelectorAll("tbody tr")];
  box.addEventListener("input", () => {
    const words = box.value.toLowerCase().split(/\s+/);
    for (const row of rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !words.every((word) => text.includes(word));
    }
  });
});
