"use strict";
// The page on which materials and lamps are changed: its controls, pictures and plot. touch_series.js computes what it shows.
const bouncesShown = Math.max(16, data.rendered.length - 1);
const asRendered = () => ({ materials: data.materials.map(m => [...m.reflectance]), lamps: data.lamps.map(() => [1, 1, 1]) });
const state = { room: asRendered(), bounce: data.rendered.length - 1, sum: true, of: "now", stops: 0, all: 0 };
const toHex = rgb => "#" + rgb.map(v => Math.round(255 * srgb(Math.min(1, Math.max(0, v)))).toString(16).padStart(2, "0")).join("");
const toLinear = hex => [1, 3, 5].map(k => { const v = parseInt(hex.slice(k, k + 2), 16) / 255; return v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4; });

const withControls = (parent, name, { level, most, colour, onLevel, onColour, text }) => {
  const part = element("div", undefined, "part"), output = element("output"), range = element("input"), hue = element("input");
  Object.assign(range, { type: "range", min: 0, max: most, step: most / 1000, value: level });
  Object.assign(hue, { type: "color", value: colour });
  range.setAttribute("aria-label", `${name}: how much`);
  hue.setAttribute("aria-label", `${name}: colour`);
  range.addEventListener("input", () => onLevel(+range.value));
  hue.addEventListener("input", () => onColour(toLinear(hue.value)));
  part.append(element("b", name), output, range, hue);
  parent.append(part);
  return { set(level, colour) { range.value = level; hue.value = colour; output.textContent = text(level); } };
};
const nameOf = part => part.name.replace(/^(?:bsdf|shape) '(.*)'$/, "$1");
const largest = rgb => Math.max(...rgb);
// A colour whose largest channel is 1; of black, white.
const hueOf = rgb => largest(rgb) > 0 ? rgb.map(v => v / largest(rgb)) : [1, 1, 1];

touch.then(async t => {
  $("title").textContent = `${data.name}: touch`;
  document.title = `${data.name}: touch`;
  const rendered = [];
  for (const [i, head] of data.rendered.entries()) {
    const { mean } = await decoded($(`picture-${i}`).textContent, head, pixels);
    rendered.push(channels.map(c => mean.subarray(c * pixels, (c + 1) * pixels)));
  }
  const meanOf = picture => channels.reduce((sum, c) => sum + picture[c].reduce((s, v) => s + v, 0) / pixels, 0) / 3;
  const picturesOf = room => {
    const { rho, fields } = t.series(room, bouncesShown);
    return { rho, fields, terms: fields.map((field, i) => t.picture(field, room, i)) };
  };
  const before = picturesOf(asRendered());
  const sumOf = (terms, bounce) => channels.map(c => {
    const sum = Float32Array.from(terms[0][c]);
    for (let i = 1; i <= bounce && i < terms.length; ++i) { const term = terms[i][c]; for (let p = 0; p < pixels; ++p) sum[p] += term[p]; }
    return sum;
  });
  const chosen = terms => state.sum ? sumOf(terms, state.bounce) : terms[Math.min(state.bounce, terms.length - 1)];

  const float = new Float32Array(1), word = new Uint32Array(float.buffer);
  // Exposures belong to the room as it was, so that changes are seen.
  const counts = new Uint32Array(65536);
  const bright = ([, green]) => {
    counts.fill(0);
    for (let p = 0; p < pixels; ++p) { float[0] = green[p]; ++counts[green[p] > 0 ? word[0] >>> 16 : 0]; }
    let bits = 65535;
    for (let above = counts[bits]; above < .02 * pixels && bits > 0; above += counts[--bits]);
    word[0] = bits << 16;
    return float[0];
  };
  // The power of two that a bounce needs to be seen.
  const brightening = term => { const b = bright(term) * exposure; return b > 0 ? 2 ** Math.max(0, Math.min(24, Math.floor(-Math.log2(b)))) : 1; };
  const exposure = 1 / (bright(sumOf(before.terms.slice(1), bouncesShown - 1)) || 1);
  const draw = (canvas, picture, times) => {
    const tones = toneTable({ curve: "clip", exposure: exposure * 2 ** state.stops, decades: 1 }), [r, g, b] = picture;
    const tone = v => { float[0] = v * times; return tones[word[0] >>> 16]; };
    fill(canvas, width, height, p => 0xff000000 | tone(b[p]) << 16 | tone(g[p]) << 8 | tone(r[p]));
  };
  // Blue where patches have less than the render, red where they have more.
  const drawDifference = (canvas, a, b, scale) => fill(canvas, width, height, p => {
    const d = channels.reduce((sum, c) => sum + a[c][p] - b[c][p], 0) / 3 * scale, v = Math.round(255 * Math.max(0, 1 - Math.abs(d)));
    return d > 0 ? 0xff000000 | v << 16 | v << 8 | 255 : 0xff000000 | 255 << 16 | v << 8 | v;
  });

  const tiles = Array.from({ length: bouncesShown + 1 }, (_, i) => {
    const button = element("button"), canvas = element("canvas"), label = element("span");
    button.append(canvas, label);
    button.addEventListener("click", () => { state.bounce = i; update(); });
    $("tiles").append(button);
    return { button, canvas, label };
  });
  const materials = data.materials.map((m, k) => withControls($("materials"), nameOf(m) + (m.even ? "" : " (its mean)"), {
    level: 0, most: 1, colour: "#ffffff", text: v => v.toFixed(3),
    onLevel: v => { state.room.materials[k] = hueOf(state.room.materials[k]).map(h => h * v); update(); },
    onColour: rgb => { const level = largest(state.room.materials[k]) || largest(rgb); state.room.materials[k] = hueOf(rgb).map(h => h * level); update(); } }));
  const lamps = data.lamps.map((lamp, j) => withControls($("lamps"), nameOf(lamp), {
    level: 1, most: 4, colour: "#ffffff", text: v => `× ${v.toFixed(2)}`,
    onLevel: v => { const was = largest(state.room.lamps[j]); state.room.lamps[j] = was > 0 ? state.room.lamps[j].map(x => x * v / was) : [v, v, v]; update(); },
    onColour: rgb => {
      const now = hueOf(rgb), had = hueOf(lamp.colour), level = largest(state.room.lamps[j]) || 1;
      state.room.lamps[j] = hueOf(now.map((v, c) => had[c] > 0 ? v / had[c] : 0)).map(v => v * level);
      update();
    } }));

  const plot = (now, was, full, bound) => {
    const svg = $("plot"), left = 62, right = 630, top = 12, bottom = 250, positive = [...now, ...was, ...full, ...bound.slice(1)].filter(v => v > 0);
    const high = Math.log10(Math.max(...positive, 1e-30)) + .15, low = Math.max(Math.log10(Math.min(...positive)), high - 9) - .15;
    const x = i => left + (right - left) * i / bouncesShown, y = v => v > 0 ? Math.min(bottom, bottom - (bottom - top) * (Math.log10(v) - low) / (high - low)) : bottom;
    const made = (tag, of, text) => { const e = document.createElementNS("http://www.w3.org/2000/svg", tag); for (const [k, v] of Object.entries(of)) e.setAttribute(k, v); if (text !== undefined) e.textContent = text; return e; };
    const line = (values, name) => made("polyline", { class: name, points: values.map((v, i) => v === null ? "" : `${x(i).toFixed(1)},${y(v).toFixed(1)}`).join(" ") });
    const parts = [made("line", { x1: left, x2: right, y1: bottom, y2: bottom }), made("line", { x1: left, x2: left, y1: top, y2: bottom })];
    for (let e = Math.ceil(low); e <= high; e += Math.ceil((high - low) / 6)) parts.push(made("text", { x: left - 8, y: y(10 ** e) + 4, "text-anchor": "end" }, "10" + superscript(e)));
    for (let i = 0; i <= bouncesShown; i += 2) parts.push(made("text", { x: x(i), y: bottom + 18, "text-anchor": "middle" }, i));
    parts.push(made("text", { x: (left + right) / 2, y: bottom + 36, "text-anchor": "middle" }, "bounce: mean of the picture, W·m⁻²·sr⁻¹ (dashed: bound; grey: as it was; ×: the full render)"));
    parts.push(line(was, "before"), line(bound, "bound"), line(now, "now"));
    full.forEach((v, i) => v > 0 && parts.push(made("path", { d: `M${x(i) - 4} ${y(v) - 4}l8 8m0-8l-8 8` })));
    now.forEach((v, i) => v > 0 && parts.push(made("circle", { cx: x(i), cy: y(v), r: 3.5 })));
    svg.replaceChildren(...parts);
  };

  const meansBefore = before.terms.map(meanOf), meansRendered = rendered.map(meanOf);
  let waits = false, latest = null, steps = 40;
  const compute = () => {
    const start = performance.now(), { room } = state, now = picturesOf(room);
    now.radius = t.radius(now.rho, steps);
    now.norm = t.norm(now.rho);
    now.means = now.fields.map((field, i) => i === 0 ? meanOf(now.terms[0]) : t.mean(field));
    now.times = now.terms.map(brightening);
    now.milliseconds = performance.now() - start;
    return now;
  };
  // Of the mean of the bounce or sum that is shown: by material how often its light was reflected there, and by lamp its share.
  const origins = now => {
    const range = means => state.sum ? means.slice(0, state.bounce + 1).reduce((a, b) => a + b, 0) : means[state.bounce];
    const whole = range(now.means);
    const meansOf = fields => fields.map((field, i) => t.mean(field));
    return {
      materials: data.materials.map((_, m) => whole > 0 ? range(meansOf(t.reflectionsBy(m, now))) / whole : 0),
      lamps: data.lamps.map((_, j) => {
        const alone = { ...state.room, lamps: state.room.lamps.map((power, k) => k === j ? power : [0, 0, 0]) };
        const { fields } = t.series(alone, bouncesShown), means = meansOf(fields);
        means[0] = meanOf(t.picture(fields[0], alone, 0));
        return whole > 0 ? range(means) / whole : 0;
      }) };
  };
  const showOrigins = () => {
    const { materials, lamps } = origins(latest), what = state.sum ? `bounces 0 to ${state.bounce}` : `bounce ${state.bounce}`;
    $("origins").replaceChildren(
      table([`reflected by, in ${what}`, "times on average"], data.materials.map((m, k) => [nameOf(m), number(materials[k], 3)]).filter(row => row[1] !== "0"), [0]),
      table([`from, in ${what}`, "of the light"], data.lamps.map((l, j) => [nameOf(l), `${(100 * lamps[j]).toFixed(1)}%`]), [0]));
  };
  let soon = 0;
  const show = now => {
    const lambda = largest(now.radius), kappa = largest(now.norm), { means, times } = now, last = means[bouncesShown];
    // What is beyond the last bounce, as if each had λ of the one before.
    const beyond = lambda < 1 ? last * lambda / (1 - lambda) : Infinity, all = means.reduce((a, b) => a + b, 0) + beyond;
    let left = all, enough = 0;
    for (; enough <= bouncesShown; ++enough) { left -= means[enough]; if (left <= .01 * all) break; }
    if (enough > bouncesShown && lambda < 1 && beyond > 0) enough = bouncesShown + Math.max(1, Math.ceil(Math.log(.01 * all / beyond) / Math.log(lambda)));
    const diverges = lambda >= .9999;
    $("verdict").className = diverges ? "diverges" : "";
    $("verdict").textContent = diverges ? "It diverges: no bounce has less light than the one before." : `It converges: ${enough} bounces for all but 1%.`;
    $("facts").replaceChildren();
    const bounded = kappa < 1 ? now.fields[bouncesShown].slice(0, 3).map(plane => plane.reduce((a, b) => Math.max(a, b), 0)) : null;
    facts("facts", [
      ["spectral radius λ of K", now.radius.map(v => v.toFixed(4)).join(", ") + " (red, green, blue)"],
      ["‖K‖∞", now.norm.map(v => v.toFixed(4)).join(", ")],
      [`bound on the rest beyond bounce ${bouncesShown}`, bounded ? number(largest(bounded.map((v, c) => v * now.norm[c] / (1 - now.norm[c])))) + " W·m⁻²·sr⁻¹ in any patch" : "none: ‖K‖∞ is not below 1"],
      ["computed in", `${now.milliseconds.toFixed(1)} ms, without a ray`]]);
    const largestIn = field => channels.reduce((most, c) => Math.max(most, field[c].reduce((a, b) => Math.max(a, b), 0)), 0);
    const direct = largestIn(now.fields[1]);
    clearTimeout(soon);
    soon = setTimeout(showOrigins, 200);
    plot(means, meansBefore, meansRendered, now.fields.map((_, i) => i === 0 ? null : direct * kappa ** (i - 1)));
    const of = state.of, brighter = state.sum ? 1 : times[state.bounce];
    const tooFar = (of === "rendered" || of === "difference") && state.bounce >= rendered.length;
    const source = { now: now.terms, before: before.terms, rendered, difference: before.terms }[of], picture = tooFar ? null : chosen(source);
    const title = state.sum ? `bounces 0 to ${state.bounce}` : `bounce ${state.bounce}`;
    if (tooFar) $("caption").textContent = `The render has bounces 0 to ${rendered.length - 1}.`;
    else if (of === "difference") {
      const other = chosen(rendered);
      let squares = 0, whole = 0;
      for (const c of channels) for (let p = 0; p < pixels; ++p) { squares += (picture[c][p] - other[c][p]) ** 2; whole += other[c][p] ** 2; }
      $("caption").textContent = `${title}: patches − render, ${whole > 0 ? number(100 * Math.sqrt(squares / whole), 2) : "0"}% RMS: discretisation, and the noise of the render. Red: patches have more.`;
      drawDifference($("picture"), picture, other, exposure * 2 ** state.stops * brighter);
    } else {
      $("caption").textContent = `${title} ${{ now: "of this room, on patches", before: "of the room as it was, on patches", rendered: `by ${data.method}, of the room as it was` }[of]}: mean ${number(meanOf(picture))} W·m⁻²·sr⁻¹` + (!state.sum && times[state.bounce] > 1 ? `, shown × ${times[state.bounce]}` : "");
      draw($("picture"), picture, brighter);
    }
    tiles.forEach(({ button, canvas, label }, i) => {
      button.setAttribute("aria-pressed", i === state.bounce);
      draw(canvas, of === "rendered" && i < rendered.length ? rendered[i] : of === "before" ? before.terms[i] : now.terms[i], times[i]);
      label.textContent = `${i}: ${number(means[i], 2)}${times[i] > 1 ? `, × ${times[i]}` : ""}`;
    });
    materials.forEach((m, k) => { const rgb = state.room.materials[k]; m.set(largest(rgb), toHex(largest(rgb) > 0 ? rgb : [1, 1, 1])); });
    lamps.forEach((l, j) => l.set(largest(state.room.lamps[j]), toHex(hueOf(data.lamps[j].colour.map((v, c) => v * state.room.lamps[j][c])))));
    $("all").value = state.all;
    $("all-text").textContent = state.all === 0 ? "as set" : `${(100 * state.all).toFixed(1)}% of the way to 1`;
  };
  // At most once a frame; then a few more steps of the power method, until the spectral radius stands.
  const update = () => {
    steps = 6;
    if (waits) return;
    waits = true;
    requestAnimationFrame(() => {
      waits = false;
      latest = compute();
      show(latest);
    });
  };
  let base = asRendered();
  $("all").addEventListener("input", () => {
    if (state.all === 0) base = structuredClone(state.room);
    state.all = +$("all").value;
    state.room.materials = base.materials.map(rgb => rgb.map(v => v + (1 - v) * state.all));
    update();
  });
  $("white").addEventListener("click", () => { $("all").value = 1; $("all").dispatchEvent(new Event("input")); });
  $("reset").addEventListener("click", () => { Object.assign(state, { room: asRendered(), all: 0, of: "now" }); $("of").value = "now"; base = asRendered(); update(); });
  for (const id of ["materials", "lamps"]) $(id).addEventListener("input", () => { state.all = 0; });
  for (const id of ["term", "sum"]) $(id).addEventListener("change", () => { state.sum = $("sum").checked; update(); });
  $("of").addEventListener("change", () => { state.of = $("of").value; update(); });
  $("stops").addEventListener("input", () => { state.stops = +$("stops").value; update(); });
  document.addEventListener("keydown", event => {
    if (event.target.matches("input, select")) return;
    const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!by) return;
    state.bounce = Math.min(bouncesShown, Math.max(0, state.bounce + by));
    update();
    event.preventDefault();
  });
  $("about").textContent = `${t.n} sides of patches with ${rays} rays each, ${width} × ${height} pixels${data.factor > 1 ? `, each ${data.factor} × ${data.factor} of the render` : ""}. All surfaces are diffuse. Patches blur shadows: see "patches − render".`;
  Object.assign(window, { touched: { state, frame: () => show(compute()), compute, picturesOf, meansBefore, meansRendered, origins: () => origins(compute()) } });
  latest = compute();
  show(latest);
});
