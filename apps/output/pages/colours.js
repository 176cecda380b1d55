"use strict";
// Maps the values of pixels to colours on the screen.

const srgb = v => v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
const toneCurves = {
  clip: v => srgb(Math.min(1, v)),
  compress: v => srgb(v / (1 + v)),
  log: (v, decades) => Math.min(1, Math.max(0, 1 + Math.log10(v) / decades))
};
// A table of a tone curve, indexed by the 16 upper bits of a float, which differ from it by at most 1/256 of its value. The last
// table is kept.
const toneTable = (() => {
  const float = new Float32Array(1), word = new Uint32Array(float.buffer);
  let kept = {};
  return ({ curve, exposure, decades }) => {
    if (kept.curve !== curve || kept.exposure !== exposure || kept.decades !== decades)
      kept = { curve, exposure, decades, table: Uint8Array.from({ length: 65536 }, (_, u) => {
        word[0] = u << 16;
        return float[0] > 0 ? Math.round(255 * toneCurves[curve](float[0] * exposure, decades)) : 0;
      }) };
    return kept.table;
  };
})();
// Fills a canvas: at(p) is the colour of pixel p in the layout of ImageData, 0xAABBGGRR.
const fill = (canvas, width, height, at) => {
  Object.assign(canvas, { width, height });
  const pixels = new ImageData(width, height), words = new Uint32Array(pixels.data.buffer);
  for (let p = 0; p < words.length; ++p) words[p] = at(p);
  canvas.getContext("2d", { willReadFrequently: true }).putImageData(pixels, 0, 0);
};
const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

// A colour map of 256 colours (0xAABBGGRR), linear between `stops`, which are red, green and blue in hexadecimal at equal
// distances.
const colourMap = stops => Uint32Array.from({ length: 256 }, (_, i) => {
  const at = i / 255 * (stops.length - 1), k = Math.min(stops.length - 2, Math.floor(at));
  const channel = c => {
    const [low, high] = [stops[k], stops[k + 1]].map(s => parseInt(s.slice(2 * c, 2 * c + 2), 16));
    return Math.round(low + (at - k) * (high - low));
  };
  return (0xff000000 | channel(2) << 16 | channel(1) << 8 | channel(0)) >>> 0;
});
// Stops of matplotlib's viridis (CC0): equal steps in value look equal, on the screen and in grey print.
const viridis = colourMap(["440154", "482878", "3e4a89", "31688e", "26828e", "1f9e89", "35b779", "6ece58", "b5de2b", "fde725"]);
// A colour map for signed values: blue below zero, black at zero, red above.
const signed = colourMap(["a6d4ff", "3c8fe0", "10407c", "000000", "7c2010", "e0663c", "ffc2a6"]);
const notFinite = 0xffff00ff, unknown = 0xff808080;

// The ways to show a picture, by name. Each returns at(p), the colour of pixel p (0xAABBGGRR), value(p), the value that the colour
// stands for, and the scale: its colours `ramp`, its ends `low` and `high`, and whether it is logarithmic, `log`. White is at 1 /
// exposure, and logarithmic scales begin `decades` powers of ten below.
const luminanceOf = (mean, n) => p => luminance(mean[p], mean[p + n], mean[p + 2 * n]);
const shownAs = {
  colour(series, ref, how) {
    const mean = series.mean(ref), n = series.pixels, bits = new Uint32Array(mean.buffer, mean.byteOffset, mean.length);
    const table = toneTable(how);
    const byte = k => table[Math.min(65535, (bits[k] + 0x8000) / 65536 | 0)];
    return { log: true, high: 1 / how.exposure, low: 10 ** -how.decades / how.exposure, value: luminanceOf(mean, n), at: p => Number.isFinite(mean[p] + mean[p + n] + mean[p + 2 * n])
               ? (0xff000000 | byte(p + 2 * n) << 16 | byte(p + n) << 8 | byte(p)) >>> 0 : notFinite };
  },
  false(series, ref, { exposure, decades }) {
    const high = 1 / exposure;
    return { ...scaled(viridis, high / 10 ** decades, high, true, luminanceOf(series.mean(ref), series.pixels)),
             quantity: `${series.importance ? "importance" : "luminance of the radiance"}, ${series.unit}; 0 is black` };
  },
  noise(series, ref) {
    const mean = series.mean(ref), n = series.pixels, errors = series.errors(ref), channels = [0, n, 2 * n];
    const relative = p => {
      if (!errors) return NaN;
      const e = Math.hypot(...channels.map(c => errors(p + c)));
      return e === 0 ? 0 : e === Infinity ? NaN : e / Math.hypot(...channels.map(c => mean[p + c]));
    };
    return { ...scaled(viridis, 1e-3, 1, true, relative), relative,
             quantity: "standard error of a pixel / its value" + (errors ? "; grey where it is not known or no sample met anything, black where all samples agree" : ": not in the files") };
  },
  difference(series, ref, { other }) {
    const { value } = difference(series, ref, other.series, other.ref), most = largestOfMost(series.pixels, value);
    if (!most) return { ...scaled(signed, -1, 1, false, value), quantity: `${pairOf(series, other)}, luminance, ${series.unit}: they agree in every pixel` };
    return { ...scaled(signed, -most, most, false, value),
             quantity: `${pairOf(series, other)}, luminance, ${series.unit}; 95% of the pixels that differ do so by at most ${number(most, 2)}, and beyond that have the colours of the ends` };
  },
  z(series, ref, { other }) {
    const { value, error } = difference(series, ref, other.series, other.ref);
    return { ...scaled(signed, -5, 5, false, p => { const d = value(p); return d === 0 ? 0 : d / error(p); }),
             quantity: `(${pairOf(series, other)}) / its standard error, luminance` };
  }
};
// The difference of the luminances of two pictures, and its standard error. The channels of a pixel come from the same samples:
// their errors are taken as fully correlated, so that the luminance has the weighted sum of their errors.
const difference = (a, refA, b, refB) => {
  const n = a.pixels, [meanA, meanB] = [a.mean(refA), b.mean(refB)], [errorA, errorB] = [a.errors(refA), b.errors(refB)];
  const of = (f, p) => luminance(f(p), f(p + n), f(p + 2 * n));
  return { value: p => of(k => meanA[k] - meanB[k], p),
           error: p => Math.hypot(errorA ? of(errorA, p) : 0, errorB ? of(errorB, p) : 0) };
};
// The 95th percentile of |value(p)|, p < n, over the values that are finite and not 0; 0 if there are none.
const largestOfMost = (n, value) => {
  const sizes = Float32Array.from({ length: n }, (_, p) => Math.abs(value(p))).filter(v => v > 0 && v < Infinity).sort();
  return sizes.length ? sizes[Math.floor(.95 * (sizes.length - 1))] : 0;
};
const scaled = (ramp, low, high, log, value) => {
  const at = v => log ? Math.log10(v / low) / Math.log10(high / low) : (v - low) / (high - low);
  return { ramp, low, high, log, value, at: p => {
    const v = value(p);
    if (!Number.isFinite(v)) return unknown;
    return log && v <= 0 ? 0xff000000 : ramp[Math.round(255 * Math.min(1, Math.max(0, at(v))))];
  } };
};
