"use strict";
// Typesets the formulas of the lessons. Without KaTeX, the page shows their LaTeX source.
for (const place of document.querySelectorAll(".tex"))
  katex.render(place.textContent, place, { displayMode: place.classList.contains("display"), throwOnError: false });
