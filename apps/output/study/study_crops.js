"use strict";
// Parts of the picture of the sum: that of the reference and, for each method, that of one run with the largest budget, with the
// errors of all its runs.

const pictures = JSON.parse($("pictures").textContent), letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
const tone = { curve: "clip", exposure: pictures.exposure, decades: 3 };
const planesOf = async (name, { width, height, heads }) => {
  const planes = await Promise.all(heads.map((head, i) => decoded($(`${name}-${i}`).textContent, head, width * height)));
  planes.forEach(({ errors }, i) => addCodes(errors, planes[i - 1]?.errors));
  return planes;
};
const colourOf = ({ width, height }, { mean }) => shownAs.colour({ pixels: width * height, mean: () => mean }, {}, tone).at;
const errorOf = (p, n, { codes, values }) => luminance(...[0, n, 2 * n].map(k => values[codes[p + k]]));

const canvasOf = ({ width, height }, at, label) => {
  const canvas = element("canvas");
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", label);
  fill(canvas, width, height, at);
  return canvas;
};
const figure = (canvases, title, ...notes) => {
  const made = element("figure"), caption = element("figcaption");
  caption.append(element("b", title), ...notes.map(n => element("div", n, "note")));
  made.append(...canvases, caption);
  return made;
};
// The time and the samples that a method took with its largest budget.
const took = name => {
  const points = sumOf(name).points, last = points[points.length - 1];
  return `${number(last.seconds.value)} s, ${number(last.samples, 9)} samples a pixel`;
};

const showCrop = async (crop, k) => {
  const packed = pictures.crops[k], planes = await planesOf(`crop-${k}`, packed), n = packed.width * packed.height;
  const maps = crop.methods.map((_, m) => p => errorOf(p, n, planes[1 + m].errors.term));
  const high = Math.max(...maps.flatMap(map => Array.from({ length: n }, (_, p) => map(p)))), low = high / 1000;
  const row = element("div", undefined, "crops"), where = `${letters[k % 26]}: ${crop.width} × ${crop.height} pixels at ${crop.x}, ${crop.y}`;
  row.append(figure([canvasOf(packed, colourOf(packed, planes[0]), `${where}, reference`)], "reference"));
  const rank = name => sumOf(name).rank;
  crop.methods.map((m, i) => ({ ...m, i })).sort((a, b) => rank(a.method) - rank(b.method)).forEach(({ method, rmse, i }) => row.append(figure(
    [canvasOf(packed, colourOf(packed, planes[1 + i]), `${where}, ${method}`), canvasOf(packed, scaled(viridis, low, high, true, maps[i]).at, `${where}, errors of ${method}`)],
    method, `RMSE ${number(rmse.value)} ± ${number(1.96 * rmse.standard_error, 2)}`, took(method))));
  const ramp = element("canvas", undefined, "ramp"), scale = element("p", undefined, "note");
  fill(ramp, 256, 1, p => viridis[p]);
  scale.append(`Errors: ${number(low, 2)} `, ramp, ` ${number(high, 2)}`);
  $("crops").append(element("h3", `${where}${crop.given ? ", as asked for" : ", where methods differ most"}`), row, scale);
  const mark = element("span", letters[k % 26]), part = (a, b) => `${100 * a / b}%`;
  Object.assign(mark.style, { left: part(crop.x, study.picture.width), top: part(crop.y, study.picture.height), width: part(crop.width, study.picture.width), height: part(crop.height, study.picture.height) });
  $("whole").append(mark);
};
$("crops-title").textContent = `The sum of bounces 0 to ${study.bounces}: ${study.budgets.unit === "seconds of a run" ? "equal-time" : "equal-sample"} pictures and errors`;
$("crops-note").textContent = study.crops.length === 0 ? "The methods differ nowhere." :
  `Above a run of each method with its largest budget, all at one exposure (× ${number(pictures.exposure)}); below √ of the mean squared error of its ${study.repeats} repeats in each pixel, luminance, the reference's noise subtracted. ` +
  "RMSE over the part, all channels, ± half of its 95% interval.";
const cropsShown = (async () => {
  const [whole] = await planesOf("whole", pictures.whole);
  $("whole").append(canvasOf(pictures.whole, colourOf(pictures.whole, whole), "the reference, whole"));
  for (const [k, crop] of study.crops.entries()) await showCrop(crop, k);
})();
