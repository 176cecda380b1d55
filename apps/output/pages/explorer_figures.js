"use strict";
// The figures under the picture: the values of a pixel, and the means of a rectangle.

// A mean of 0 with an interval: no sample met any light, and half of the interval is an upper bound.
const withInterval = (value, half) => !half ? number(value) : value === 0 && Number.isFinite(half) ? `0, at most ${number(half, 2)}` : `${number(value)} ± ${Number.isFinite(half) ? number(half, 2) : "unknown"}`;
const channels = ["red", "green", "blue"];
const figuresLine = text => {
  const line = element("div", undefined, "values");
  text.forEach(([name, value]) => { const part = element("span"); part.append(element("span", name && name + " ", "dim"), value); line.append(part); });
  return line;
};
const pixelLine = (s, ref, p) => {
  const n = s.pixels, errors = s.errors(ref), patches = s.errors(ref, "_discretisation"), values = [0, 1, 2].map(c => s.meanAt(ref, p + c * n));
  const size = Math.hypot(...values), relative = errors && Math.hypot(...[0, 1, 2].map(c => errors(p + c * n))) / size;
  const text = [["", runName(s) + s.title(ref)], ...channels.map((name, c) => [name, withInterval(values[c], s.halfInterval(ref, p + c * n))])];
  if (errors && size > 0) text.push(["relative standard error", Number.isFinite(relative) ? `${number(100 * relative, 2)}%` : "unknown"]);
  if (errors && values.some((v, c) => v === 0 && errors(p + c * n) === 0)) text.push(["", patches ? "0: no light in any sample" : "0: known to be dark"]);
  if (patches) text.push(["discretisation at most", number(patches(p), 2)]);
  return figuresLine(text);
};
// The mean of channel c over a rectangle, and half of its 95% interval: √(Σ h²) / n where the errors of the n pixels are
// independent, else the upper bound Σ h / n.
const rectMean = (s, ref, { x0, y0, x1, y1 }, c) => {
  const mean = s.mean(ref), n = (x1 - x0 + 1) * (y1 - y0 + 1);
  let total = 0, half = 0;
  for (let y = y0; y <= y1; ++y) for (let x = x0; x <= x1; ++x) {
    const p = y * s.width + x + c * s.pixels, h = s.halfInterval(ref, p);
    total += mean[p];
    half += s.independent ? h * h : h;
  }
  return { mean: total / n, half: (s.independent ? Math.sqrt(half) : half) / n };
};
const rectLine = (s, ref, rect) => figuresLine([["", runName(s) + s.title(ref)], ...channels.map((name, c) => {
  const { mean, half } = rectMean(s, ref, rect, c);
  return [name, withInterval(mean, half)];
})]);
// The pixels of the film that the pixels a to b of the page cover: "9 to 10, 20".
const fromTo = (a, b) => {
  const from = onFilm(a), to = onFilm(b).map(v => v + first.factor - 1);
  return from.map((v, k) => v === to[k] ? v : `${v} to ${to[k]}`).join(", ");
};
const drawReadout = () => {
  const at = state.hover ?? state.pixel, rect = state.rect, o = other();
  const pictures = [{ series: series(), ref: shown() }, ...(state.wipe || comparing() ? [o] : [])].filter(picture => !missing(picture));
  if (!pictures.length || !(at || rect)) {
    $("readout").replaceChildren(element("span", "Point at the picture, or move through it with the arrow keys, to see values; click or Enter chooses a pixel, Shift and a drag a rectangle.", "note"));
    return;
  }
  const infinite = pictures.some(({ series, ref }) => series.infiniteVariance(ref)), unit = series().unit, lines = [];
  if (at) {
    const where = first.factor === 1 ? `Pixel ${fromTo(at, at)}` : `Mean of pixels ${fromTo(at, at)}`;
    lines.push(element("div", `${where}, ${unit}${infinite ? "; the variance is infinite: no intervals" : ", with 95% intervals"}`, "note"),
               ...pictures.map(({ series: s, ref }) => pixelLine(s, ref, at.y * s.width + at.x)));
  }
  if (rect) {
    const intervals = infinite ? "the variance is infinite: no intervals" : pictures.every(({ series: s }) => s.independent) ? "95% intervals, for errors of pixels that are independent"
      : "95% intervals that are upper bounds where errors of pixels may go together";
    lines.push(element("div", `Mean of the rectangle ${fromTo({ x: rect.x0, y: rect.y0 }, { x: rect.x1, y: rect.y1 })}, ${unit}; ${intervals}`, "note"), ...pictures.map(({ series: s, ref }) => rectLine(s, ref, rect)));
  }
  $("readout").replaceChildren(...lines);
};
