"use strict";
// Formulas of the lessons; without KaTeX they stand as they are written.
for (const place of document.querySelectorAll(".tex"))
  katex.render(place.textContent, place, { displayMode: place.classList.contains("display"), throwOnError: false });
