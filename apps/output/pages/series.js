"use strict";
// The pictures of a render: means, sums and errors of every bounce, channel by channel. See apps/output/files/packed_pictures.h.

// Methods take the name of a picture, { i, sum, absent }: bounce i, or with `sum` the sum of bounces 0 to i. i = last + 1 names the
// rest, the sum of all bounces beyond the last one; with `absent` it names bounce last + 1, of which this render has no picture.
class Series {
  constructor({ run, convergence, decay, pictures }, index) {
    Object.assign(this, { run, decay, index, width: pictures.width, height: pictures.height, factor: pictures.factor, exposure: pictures.exposure,
                          independent: pictures.independent, intervalFactor: pictures.interval_factor, heads: pictures.heads, hasRest: pictures.has_rest });
    this.pixels = this.width * this.height;
    this.last = pictures.heads.length - 1 - (pictures.has_rest ? 1 : 0);
    this.planes = [];
    this.sums = new Map();
    const [head, ...rows] = convergence.trim().split("\n").map(line => line.split(","));
    this.convergence = rows.map(row => Object.fromEntries(row.map((cell, c) => [head[c], Number(cell.replace("inf", "Infinity"))])));
    this.unit = unitText(run.quantity.unit);
  }

  // Decodes picture i. The pictures before it must have been decoded, because its errors are stored as differences from them.
  async load(i) {
    const picture = await decoded($(`picture-${this.index}-${i}`).textContent, this.heads[i], this.pixels);
    addCodes(picture.errors, this.planes[i - 1]?.errors);
    this.planes[i] = picture;
    this.sums.clear();
  }

  isRest({ i, absent }) { return i === this.last + 1 && !absent; }
  has(ref) { return ref.i >= 0 && (ref.i <= this.last || (this.isRest(ref) && this.hasRest && !ref.sum)); }
  isLoaded(ref) { return this.has(ref) && ref.i < this.planes.length; }

  // Red of all pixels, then green, then blue. Sums are added up from the terms. The relative error of each term is at most 2⁻¹¹,
  // and so is that of their sum where no term is negative.
  mean({ i, sum }) {
    if (!sum || i === 0) return this.planes[i].mean;
    if (this.sums.has(i)) return this.sums.get(i);
    const total = new Float64Array(3 * this.pixels);
    for (const { mean } of this.planes.slice(0, i + 1)) for (let p = 0; p < total.length; ++p) total[p] += mean[p];
    if (this.sums.size >= 4) this.sums.delete(this.sums.keys().next().value);
    this.sums.set(i, Float32Array.from(total));
    return this.sums.get(i);
  }
  meanAt(ref, p) {
    if (!ref.sum) return this.planes[ref.i].mean[p];
    let total = 0;
    for (let k = 0; k <= ref.i; ++k) total += this.planes[k].mean[p];
    return total;
  }
  // Returns the standard errors as a function of an index into mean(), or undefined where there are none. With `kind`
  // "_discretisation" returns the error due to patches, photons or caches as a function of the pixel: the largest over the channels
  // and pixels of its block.
  errors({ i, sum }, kind = "") {
    const found = this.planes[i].errors[(sum ? "sum" : "term") + kind];
    if (!found) return undefined;
    if (found.block === 1) return p => found.values[found.codes[p]];
    const of = x => Math.floor(x / found.block), across = Math.ceil(this.width / found.block);
    return p => found.values[found.codes[of(p / this.width) * across + of(p % this.width)]];
  }
  infiniteVariance({ i, sum }) {
    const infinite = b => typeof b.interval95 === "string";
    if (i > this.last) return infinite(this.run.rest);
    return sum ? this.run.bounces.slice(0, i + 1).some(infinite) : infinite(this.run.bounces[i]);
  }
  // Half of the 95% interval of the value with index p in mean(). Infinity: the error is unknown; undefined: there is no interval.
  halfInterval(ref, p) {
    const errors = this.errors(ref);
    if (!errors || this.infiniteVariance(ref)) return undefined;
    const e = errors(p);
    return e === 0 ? 0 : this.intervalFactor === null ? Infinity : e * this.intervalFactor;
  }

  title(ref) {
    const { i, sum } = ref;
    if (this.isRest(ref)) return `rest, all beyond bounce ${this.last}`;
    return sum && i > 0 ? `sum of bounces 0 to ${i}` : `bounce ${i}`;
  }
  formula({ i, sum }) {
    const K = this.importance ? "K*" : "K", source = this.importance ? "We" : "Le";
    const power = k => k === 0 ? source : k === 1 ? `${K} ${source}` : `${K}${superscript(k)} ${source}`;
    if (i > this.last) return `${power(i)} + ${power(i + 1)} + …`;
    if (!sum || i === 0) return power(i);
    return i <= 3 ? Array.from({ length: i + 1 }, (_, k) => power(k)).join(" + ") : `${source} + ${power(1)} + … + ${power(i)}`;
  }
  get importance() { return this.run.quantity.name.startsWith("importance"); }
  // The mean over all pixels and channels, and half of its 95% interval, which is undefined where it is not known.
  wholeMean({ i, sum }) {
    const of = x => ({ mean: x.mean, interval95: typeof x.interval95 === "number" ? x.interval95 : undefined });
    if (i > this.last) return of(this.run.rest);
    if (!sum || i === 0) return of(this.run.bounces[i]);
    return i === this.last ? of(this.run.sum) : { mean: this.run.bounces.slice(0, i + 1).reduce((a, b) => a + b.mean, 0) };
  }
}
