"use strict";
// The state of the page: what is shown, and what it is compared with.
const data = JSON.parse($("data").textContent);
const all = data.runs.map((r, i) => new Series(r, i));
const letter = index => String.fromCharCode(65 + index);
const names = all.map((_, r) => all.length > 1 ? `, ${letter(r)}` : "");
const first = all[0];
// Users name pixels by their coordinates on the whole film, as `neumann replay` does, even if the picture is a crop. A pixel of a
// page that is reduced by `factor` is named by its upper left pixel on the film.
const { crop_x: cropX = 0, crop_y: cropY = 0 } = first.run.picture;
const onFilm = ({ x, y }) => [x * first.factor + cropX, y * first.factor + cropY];
const fromFilm = (x, y) => ({ x: (x - cropX) / first.factor, y: (y - cropY) / first.factor });
const state = {
  run: 0, i: Math.min(1, first.last), sum: false, view: "colour", curve: "clip", stops: 0, decades: 4, fit: false,
  hover: null, pixel: null,  // { x, y }: the pixel under the pointer, and the chosen one
  rect: null,  // { x0, y0, x1, y1 }, all inclusive
  picking: false,  // whether a drag makes a rectangle
  corner: null,  // the corner from which the arrow keys make a rectangle
  zoom: 1, left: 0, top: 0,  // the position of the picture in the stage is in CSS pixels
  path: "",  // the sample whose path is shown; "": the one that contributes most
  asking: true, pathShown: true,  // whether shadow rays are shown, and the path over the picture
  slide: "",  // "dark" or "white"; "": no slide
  wipe: all.length > 1, edge: .5, other: all.length > 1 ? "run" : "next"
};
let playing = null;

const series = () => all[state.run];
const shown = () => ({ i: state.i, sum: state.sum });
// The name of the picture of run `s` that corresponds to the one shown; the rest corresponds to the rest, even if the runs have
// different numbers of bounces.
const same = s => {
  const i = state.i > series().last ? s.last + 1 : state.i;
  return { i, sum: state.sum, absent: i > s.last && state.i <= series().last };
};
// The choices for B: name, label, and a function that returns the series and the name of the picture. Some depend on the picture
// that is shown, others are fixed.
const others = [
  ...(all.length > 1 ? [["run", `the same of the ${all.length > 2 ? "next" : "other"} run`, () => { const s = all[(state.run + 1) % all.length]; return [s, same(s)]; }]] : []),
  ...(all.length > 2 ? all.map((s, r) => [`run-${r}`, `the same of ${letter(r)}`, () => [s, same(s)]]) : []),
  ["next", "the next bounce", () => [series(), { i: state.i + 1, sum: state.sum }]],
  ["previous", "the bounce before", () => [series(), { i: state.i - 1, sum: state.sum }]],
  ["sum", "its sum, or its bounce", () => [series(), { i: state.i, sum: !state.sum }]],
  ...all.flatMap((s, r) => [...Array(s.last + 1 + (s.hasRest ? 1 : 0)).keys()].flatMap(i => [false, true].map(sum => ({ i, sum })))
    .filter(ref => s.has(ref) && !(ref.sum && ref.i === 0))
    .map(ref => [`${r}-${ref.sum ? "sum" : "term"}-${ref.i}`, s.title(ref) + names[r], () => [s, ref]]))];
const other = () => {
  const [s, ref] = others.find(o => o[0] === state.other)[2]();
  return { series: s, ref };
};
// The difference that is shown, as a text.
const pairOf = (s, o) => s === o.series ? "A − B" : `${letter(s.index)} − ${letter(o.series.index)}`;
const comparing = () => state.view === "difference" || state.view === "z";
const runName = s => all.length > 1 ? `${letter(s.index)}: ` : "";

// The exposure at which the brightest hundredth of the lit pixels is white; 0 if none is lit. Of a large picture every few pixels are
// looked at.
const fitted = new Map(), mostLookedAt = 65536;
const fittedExposure = (s, ref) => {
  const key = `${s.index} ${ref.i} ${ref.sum}`;
  if (!fitted.has(key)) {
    const light = luminanceOf(s.mean(ref), s.pixels), stride = Math.ceil(s.pixels / mostLookedAt) | 1;
    const lit = Float32Array.from({ length: Math.ceil(s.pixels / stride) }, (_, k) => light(k * stride)).filter(v => v > 0).sort();
    fitted.set(key, lit.length ? 1 / lit[Math.floor(.99 * (lit.length - 1))] : 0);
  }
  return fitted.get(key);
};
// The exposure: that of the contact sheet or, if `fit`, that of each picture; times 2^stops.
const exposure = (s, ref) => (state.fit ? fittedExposure(s, ref) || 1 : first.exposure) * 2 ** state.stops;
// How many times a picture is to be brightened that is dark at the common exposure: the largest power of two at which its brightest
// hundredth is not beyond white. 1 from an eighth of white on, and wherever colours do not depend on the exposure as light does.
const darkBelow = 1 / 8;
const brightening = (s, ref) => {
  if (state.fit || state.curve === "log" || !(state.view === "colour" || comparing())) return 1;
  const times = 2 ** Math.floor(Math.log2(fittedExposure(s, ref) / (first.exposure * 2 ** Math.max(0, state.stops))));
  return times * darkBelow >= 1 ? times : 1;
};
