"use strict";
// A histogram of the values of the picture, with two handles at the ends of the colour scale.

const histogram = { of: null, log: true, low: 1, high: 10, counts: [], held: false };
const bins = 128;

// The position of a value between the ends of the histogram, from 0 to 1.
const along = v => histogram.log ? Math.log(v / histogram.low) / Math.log(histogram.high / histogram.low) : (v - histogram.low) / (histogram.high - histogram.low);
const count = () => {
  const h = histogram, values = Float64Array.from({ length: series().pixels }, (_, p) => image.value(p)), finite = values.filter(Number.isFinite);
  h.log = image.log;
  h.zero = finite.filter(v => v === 0).length;
  h.negative = finite.filter(v => v < 0).length;
  h.unknown = values.length - finite.length;
  if (h.log) {
    const positive = finite.filter(v => v > 0), most = positive.reduce((a, b) => Math.max(a, b), 0), least = positive.reduce((a, b) => Math.min(a, b), Infinity);
    const ends = [image.high, ...(hasLow() ? [image.low] : []), ...(most > 0 ? [most, Math.max(least, most / 1e8)] : [])];
    h.low = Math.min(...ends) / 1.2;
    h.high = Math.max(...ends) * 1.2;
  } else [h.low, h.high] = [2 * image.low, 2 * image.high];
  h.counts = new Array(bins).fill(0);
  h.beyond = 0;
  for (const v of finite) if (!h.log || v > 0) {
    const bin = Math.floor(bins * along(v));
    bin >= 0 && bin < bins ? ++h.counts[bin] : ++h.beyond;
  }
};
// Logarithmic scales have a low end that can be moved; others begin at 0.
const hasLow = () => state.view === "false" || (state.view === "colour" && state.curve === "log");
const hasHigh = () => state.view === "false" || state.view === "colour";

const drawHistogram = () => {
  $("histogram-part").hidden = !image;
  if (!image || histogram.held) return;
  const of = JSON.stringify([series().index, shown(), state.view, comparing() && [other().series.index, other().ref], image.low, image.high, color("text")]);
  if (histogram.of === of) return;
  histogram.of = of;
  count();
  const canvas = $("histogram"), ctx = canvas.getContext("2d", { willReadFrequently: true }), most = Math.max(1, ...histogram.counts);
  ctx.clearRect(0, 0, canvas.width, canvas.height);
  ctx.fillStyle = color("text");
  histogram.counts.forEach((n, bin) => { const height = Math.round(canvas.height * Math.sqrt(n / most)); ctx.fillRect(bin, canvas.height - height, 1, height); });
  placeTicks("histogram-ticks", histogram.log ? decadeTicks(histogram.low, histogram.high) : signedTicks(histogram.high));
  const told = [[histogram.zero * histogram.log, "are 0"], [histogram.negative * histogram.log, "are negative"], [histogram.beyond, "are beyond the ends"], [histogram.unknown, "are unknown"]].filter(([n]) => n > 0);
  const what = { noise: "relative standard error", difference: "difference", z: "difference / its standard error" }[state.view] ?? "luminance";
  $("histogram-note").textContent = `${whole(series().pixels)} pixels by ${what}; a bar's height is the square root of the number of its pixels` + told.map(([n, where]) => `; ${whole(n)} ${where}`).join("") + ".";
  $("range-low").disabled = !hasLow();
  $("range-high").disabled = !hasHigh();
  for (const [id, value] of [["range-low", image.low], ["range-high", image.high]]) {
    $(id).value = along(value);
    $(id).setAttribute("aria-valuetext", number(value));
  }
};
// Exposure changes in tenths of a stop, and the low end stays at least 0.3 decades below the high end.
const moveHandle = e => {
  histogram.held = true;
  const value = histogram.low * (histogram.high / histogram.low) ** e.target.value, s = series();
  const stops = e.target.id === "range-low" ? state.stops : Math.max(-10, Math.min(20, Math.round(10 * (state.stops - Math.log2(value * exposure(s, shown())))) / 10));
  const low = e.target.id === "range-low" ? value : image.low, high = 2 ** (state.stops - stops) / exposure(s, shown());
  set({ stops, ...(hasLow() ? { decades: Math.min(12, Math.max(.3, Math.round(100 * Math.log10(high / low)) / 100)) } : {}) });
};
for (const id of ["range-low", "range-high"]) {
  $(id).oninput = moveHandle;
  $(id).onchange = () => { histogram.held = false; redraw(); };
}
