"use strict";
// The series of a separated scene (operators/fields/matrix/separated_scene.h), again for each change of a material or of a lamp:
//     K Le = ρ A Le,    K^{i+1} Le = ρ F K^i Le,    F the mean over a facet's rays of what they see.
// A field is three arrays, one for each channel, with a value for each facet and 0 for what is no facet.
const data = JSON.parse($("data").textContent);
const { width, height, rays } = data, pixels = width * height, channels = [0, 1, 2];
const array = async (name, Type) => new Type((await inflated($(name).textContent)).buffer);

const touch = (async () => {
  const [seen, material, area, reflectance, first, facet, weights] = await Promise.all([["seen", Uint16Array], ["material", Uint16Array],
    ["area", Float32Array], ["reflectance", Float32Array], ["first", Uint32Array], ["facet", Uint16Array], ["weight", Int16Array]].map(a => array(...a)));
  const n = area.length, weight = Float32Array.from(weights, w => w / data.weight_of_one);
  const planes = (values, count) => channels.map(c => { const plane = new Float32Array(count + 1); plane.set(values.subarray(c * count, (c + 1) * count)); return plane; });
  const empty = count => channels.map(() => new Float32Array(count + 1));
  const lamps = await Promise.all(data.lamps.map(async (lamp, j) => ({
    emitted: planes(await array(`emitted-${j}`, Float32Array), n), arriving: planes(await array(`arriving-${j}`, Float32Array), n),
    background: lamp.sky ? planes(await array(`background-${j}`, Float32Array), pixels) : null })));
  const original = planes(reflectance, n);
  // Of all pixels together: the mean of a picture is the product with its field.
  const importance = new Float32Array(n + 1);
  for (let e = 0; e < facet.length; ++e) importance[facet[e]] += weight[e] / pixels;

  // The part of a facet's rays that see a facet.
  const closed = new Float32Array(n);
  for (let f = 0; f < n; ++f) for (let k = f * rays; k < (f + 1) * rays; ++k) closed[f] += (seen[k] < n) / rays;

  // ρ by facet: of an even material its reflectance, otherwise in proportion to the mean.
  const reflectances = materials => channels.map(c => Float32Array.from({ length: n }, (_, f) => {
    const of = data.materials[material[f]], now = materials[material[f]][c], mean = of.reflectance[c];
    return of.even ? now : mean > 0 ? Math.min(1, original[c][f] * now / mean) : now;
  }));
  const reflect = (rho, from, to) => {
    const [r, g, b] = from, [toR, toG, toB] = to, [rhoR, rhoG, rhoB] = rho;
    for (let f = 0, k = 0; f < n; ++f) {
      let red = 0, green = 0, blue = 0;
      for (const end = k + rays; k < end; ++k) { const s = seen[k]; red += r[s]; green += g[s]; blue += b[s]; }
      toR[f] = rhoR[f] * red / rays;
      toG[f] = rhoG[f] * green / rays;
      toB[f] = rhoB[f] * blue / rays;
    }
  };
  // K^i Le for i = 0 … bounces.
  const series = (room, bounces) => {
    const rho = reflectances(room.materials), fields = Array.from({ length: bounces + 1 }, () => empty(n));
    lamps.forEach((lamp, j) => channels.forEach(c => {
      const power = room.lamps[j][c], le = fields[0][c], direct = bounces > 0 ? fields[1][c] : null;
      for (let f = 0; f < n; ++f) {
        le[f] += power * lamp.emitted[c][f];
        if (direct) direct[f] += power * rho[c][f] * lamp.arriving[c][f];
      }
    }));
    for (let i = 2; i <= bounces; ++i) reflect(rho, fields[i - 1], fields[i]);
    return { rho, fields };
  };
  const picture = (field, room, bounce) => {
    const [r, g, b] = field, seenNow = empty(pixels - 1), [toR, toG, toB] = seenNow;
    for (let p = 0, e = 0; p < pixels; ++p) {
      let red = 0, green = 0, blue = 0;
      for (const end = first[p + 1]; e < end; ++e) { const f = facet[e], w = weight[e]; red += w * r[f]; green += w * g[f]; blue += w * b[f]; }
      toR[p] = red; toG[p] = green; toB[p] = blue;
    }
    if (bounce === 0) lamps.forEach((lamp, j) => lamp.background && channels.forEach(c => {
      for (let p = 0; p < pixels; ++p) seenNow[c][p] += room.lamps[j][c] * lamp.background[c][p];
    }));
    return seenNow;
  };
  // ρ ∂/∂ρ of the fields for one material. As K^i Le is of degree i in all reflectances together, this is the number of reflections
  // by it, weighted by light: for all materials they add up to i.
  const reflectionsBy = (m, { rho, fields }) => {
    const all = [empty(n)];
    for (let i = 1; i < fields.length; ++i) {
      const counted = empty(n);
      if (i > 1) reflect(rho, all[i - 1], counted);
      channels.forEach(c => { for (let f = 0; f < n; ++f) if (material[f] === m) counted[c][f] += fields[i][c][f]; });
      all.push(counted);
    }
    return all;
  };
  const mean = field => {
    const [r, g, b] = field;
    let sum = 0;
    for (let f = 0; f < n; ++f) sum += importance[f] * (r[f] + g[f] + b[f]);
    return sum / 3;
  };
  // ‖K‖∞: what a facet sends on at most, if all others send 1.
  const norm = rho => channels.map(c => rho[c].reduce((most, v, f) => Math.max(most, v * closed[f]), 0));
  // The spectral radius, by the power method: a few steps for each change go on from the vector before.
  const vector = empty(n);
  vector.forEach(v => v.fill(1, 0, n));
  const next = empty(n);
  const radius = (rho, steps) => {
    let found = [0, 0, 0];
    for (let s = 0; s < steps; ++s) {
      reflect(rho, vector, next);
      found = channels.map(c => {
        let before = 0, after = 0;
        for (let f = 0; f < n; ++f) { before += area[f] * vector[c][f]; after += area[f] * next[c][f]; }
        for (let f = 0; f < n; ++f) vector[c][f] = after > 0 ? next[c][f] / after + 1e-12 : 1;
        return before > 0 ? after / before : 0;
      });
    }
    return found;
  };
  return { n, series, picture, mean, norm, radius, reflectionsBy };
})();
