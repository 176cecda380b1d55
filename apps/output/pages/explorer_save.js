"use strict";
// Saves or copies parts of the page: the picture, the plots, the values of a pixel.

const fileName = () => `${sceneOf(series()).replace(/\.[^.]*$/, "")}-${state.i > series().last ? "rest" : `${state.sum ? "sum" : "bounce"}-${state.i}`}`;

// Saves the picture as it is shown, including the part of B in the wipe. A pixel of the file is a pixel of the page's picture,
// whatever the zoom.
const savePicture = () => {
  if (!image) return;
  const out = element("canvas"), { width, height } = $("a"), to = out.getContext("2d");
  Object.assign(out, { width, height });
  to.drawImage($("a"), 0, 0);
  if (!$("b").hidden) {
    const from = Math.round((state.edge * $("stage").clientWidth - state.left) / (state.fitScale * state.zoom)), part = Math.max(0, Math.min(width, from));
    if (part < width) to.drawImage($("b"), part, 0, width - part, height, part, 0, width - part, height);
  }
  out.toBlob(blob => save(`${fileName()}${state.view === "colour" ? "" : "-" + state.view}.png`, blob));
};

// The values of the chosen pixel for a spreadsheet: a row for each picture, cells separated by tabs.
const pixelText = () => {
  const s = series(), p = state.pixel.y * s.width + state.pixel.x;
  const rows = [];
  for (const sum of [false, true]) for (let i = 0; i <= s.last + 1; ++i) {
    const ref = { i, sum };
    if (!s.isLoaded(ref)) continue;
    const half = k => { const h = s.halfInterval(ref, k); return Number.isFinite(h) ? h : "unknown"; };
    rows.push([s.title(ref), ...channels.flatMap((_, c) => [s.meanAt(ref, p + c * s.pixels), half(p + c * s.pixels)])]);
  }
  return [[`pixel ${pixelsWritten(state.pixel)}, ${s.run.quantity.unit}`, ...channels.flatMap(c => [c, "± (95%)"])], ...rows].map(row => row.join("\t") + "\n").join("");
};
const copyPixel = async () => {
  if (!state.pixel) return;
  const text = pixelText();
  try {
    await navigator.clipboard.writeText(text);
    $("copied").textContent = "Copied.";
  } catch {
    $("copy-text").value = text;
    $("copy").showModal();
    $("copy-text").select();
  }
};

for (const [id, chart, what] of [["energy", energyPlot, "energy of each bounce"], ["pixel", pixelPlot, "the chosen pixel"], ["error", errorPlot, "error against time"],
                               ["history", historyPlot, "the pixel against samples"], ["pixel-error", pixelErrorPlot, "the pixel's error against samples"]]) {
  const row = element("div", undefined, "line saves"), name = `${id}-plot`;
  row.append(...savingPlot(name, what, () => svgPlot(chart), () => csvPlot(chart)));
  $(id).parentElement.after(row);
  if (id === "pixel") {
    const copied = element("output");
    copied.id = "copied";
    row.append(button("Copy values", "Copy the values of the chosen pixel", copyPixel), copied);
  }
}
const pathSaves = element("div", undefined, "line saves");
pathSaves.append(...savingPlot("path", "the path from above", planText, () => csvOf([rayHead, ...shownPath().rays.map(rayCells)])));
$("plan").after(pathSaves);
$("save-picture").onclick = savePicture;
