"use strict";
// The table of efficiencies, with a row for each method and a column for each bounce: 1/(MSE·T), T the time of a run, at the
// largest budget, divided by that of the best method of the column.

const heatLow = 1e-4;
const heat = study.methods.map(({ name }) => study.pictures.map(({ verdict, methods }) => {
  if (verdict.best === name) return { part: verdict.known ? 1 : null, text: verdict.known ? "1" : "?" };
  const other = verdict.others.find(o => o.method === name);
  if (!other) return { part: null, text: "–" };
  if (!other.known) return { part: null, text: methods.find(m => m.method === name).infinite_variance ? "∞ V" : "?" };
  // The error of the best method is too small to be measured, so that at most a bound on the quotient is known.
  if (other.times_as_fast === null) return other.seen && other.low ? { part: 1 / other.low, text: "< " + number(1 / other.low, 2) } : { part: null, text: "?" };
  const part = 1 / other.times_as_fast;
  return { part, text: (other.seen ? "" : "≈ ") + number(part, 2), title: `${verdict.best} is ${number(other.times_as_fast, 2)} times as fast (95%: ${number(other.low, 2)} to ${other.high === null ? "∞" : number(other.high, 2)})` };
}));
const heatColour = part => {
  const at = Math.max(0, 1 - Math.log10(part) / Math.log10(heatLow)), bits = viridis[Math.round(255 * Math.min(1, at))];
  const [r, g, b] = [bits & 255, bits >> 8 & 255, bits >> 16 & 255];
  return { back: `rgb(${r}, ${g}, ${b})`, ink: luminance(r, g, b) > 110 ? "#111111" : "#ffffff" };
};
const heatHead = ["method", ...study.pictures.map(p => p.bounce === "sum" ? "sum" : `bounce${p.bounce.includes("-") ? "s" : ""} ${p.bounce}`)];
const heatRows = study.methods.map(({ name }, m) => [name, ...heat[m].map(c => c.text)]);
const heatTable = table(heatHead, heatRows, [0]);
heat.forEach((row, m) => row.forEach(({ part, title }, q) => {
  const cell = heatTable.rows[m + 1].cells[q + 1];
  if (title) cell.title = title;
  if (part !== null) Object.assign(cell.style, { backgroundColor: heatColour(part).back, color: heatColour(part).ink });
}));
$("heat").append(heatTable);
$("heat-note").textContent = "1/(MSE·T) at the largest budget, over that of the best method in the bounce: 0.1 takes ten times as long to the same error. ≈: no difference from the best is seen. " +
  "The intervals of all pairs of methods hold together at 95%; they are told where the pointer is.";

const svgHeat = () => {
  const high = 26, names = Math.max(...study.methods.map(m => m.name.length)) * 7 + 16, wide = 84, width = names + wide * study.pictures.length + 1, height = high * (heat.length + 1) + 1;
  const word = (text, x, y, more = "") => `<text x="${x}" y="${y + 17}" ${more}>${escaped(text)}</text>`, middle = 'text-anchor="middle"';
  const cells = heat.flatMap((row, m) => row.map(({ part, text }, q) => {
    const { back, ink } = part === null ? { back: "#ffffff", ink: "#111111" } : heatColour(part), x = names + q * wide, y = high * (m + 1);
    return `<rect x="${x}" y="${y}" width="${wide}" height="${high}" fill="${back}" stroke="#ffffff"/>` + word(text, x + wide / 2, y, `${middle} fill="${ink}"`);
  }));
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="12" fill="#111111"><rect width="100%" height="100%" fill="#ffffff"/>\n` +
    [...heatHead.slice(1).map((h, q) => word(h, names + (q + .5) * wide, 0, middle)), ...study.methods.map((m, k) => word(m.name, 4, high * (k + 1))), ...cells].join("\n") + "\n</svg>\n";
};
const heatSaves = element("div", undefined, "line saves"), heatWhat = "efficiency by bounce";
heatSaves.append(...savingPlot("efficiency", heatWhat, svgHeat, () => csvOf([heatHead, ...heatRows])).slice(0, 2), ...savingTable("efficiency", heatWhat, [heatHead, ...heatRows], [0]));
$("heat").after(heatSaves);
