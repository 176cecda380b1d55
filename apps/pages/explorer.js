"use strict";
const data = JSON.parse($("data").textContent);
const all = data.runs.map((r, i) => new Series(r, i));
const names = all.length > 1 ? [", A", ", B"] : [""];
const first = all[0];
const state = {
  run: 0, i: Math.min(1, first.last), sum: false, view: "colour", curve: "clip", stops: 0, fit: false,
  hover: null, pixel: null,  // { x, y }
  zoom: 1, left: 0, top: 0,  // of the picture in the stage, in CSS pixels
  wipe: all.length > 1, edge: .5, other: all.length > 1 ? "run" : "next"
};
let playing = null;

const series = () => all[state.run];
const shown = () => ({ i: state.i, sum: state.sum });
// What is shown, of another run: rest for rest.
const same = s => {
  const i = state.i > series().last ? s.last + 1 : state.i;
  return { i, sum: state.sum, absent: i > s.last && state.i <= series().last };
};
// What B is: { series, ref }. Either follows what is shown or stands still.
const others = [
  ...(all.length > 1 ? [["run", "the same of the other run", () => [all[1 - state.run], same(all[1 - state.run])]]] : []),
  ["next", "the next bounce", () => [series(), { i: state.i + 1, sum: state.sum }]],
  ["previous", "the bounce before", () => [series(), { i: state.i - 1, sum: state.sum }]],
  ["sum", "bounce or sum, the other", () => [series(), { i: state.i, sum: !state.sum }]],
  ...all.flatMap((s, r) => [...Array(s.last + 1 + (s.hasRest ? 1 : 0)).keys()].flatMap(i => [false, true].map(sum => ({ i, sum })))
    .filter(ref => s.has(ref) && !(ref.sum && ref.i === 0))
    .map(ref => [`${r}-${ref.sum ? "sum" : "term"}-${ref.i}`, s.title(ref) + names[r], () => [s, ref]]))];
const other = () => {
  const [s, ref] = others.find(o => o[0] === state.other)[2]();
  return { series: s, ref };
};
const comparing = () => state.view === "difference" || state.view === "z";
const runName = s => all.length > 1 ? `${"AB"[s.index]}: ` : "";

// Exposure: of the contact sheet, or such that the brightest hundredth of this picture is white.
const fitted = new Map();
const exposure = (s, ref) => {
  let base = first.exposure;
  if (state.fit) {
    const key = `${s.index} ${ref.i} ${ref.sum}`;
    if (!fitted.has(key)) {
      const mean = s.mean(ref), n = s.pixels;
      const lit = Float32Array.from({ length: n }, (_, p) => luminance(mean[p], mean[p + n], mean[p + 2 * n])).filter(v => v > 0).sort();
      fitted.set(key, lit.length ? 1 / lit[Math.floor(.99 * (lit.length - 1))] : 1);
    }
    base = fitted.get(key);
  }
  return base * 2 ** state.stops;
};

// The picture.
let image = null;  // what A shows
const paint = (canvas, s, ref, o) => {
  canvas.width = s.width;
  canvas.height = s.height;
  const shown = shownAs[state.view](s, ref, exposure(s, ref), comparing() ? o.series : state.curve, o && o.ref);
  const pixels = new ImageData(s.width, s.height), words = new Uint32Array(pixels.data.buffer);
  for (let p = 0; p < words.length; ++p) words[p] = shown.at(p);
  canvas.getContext("2d", { willReadFrequently: true }).putImageData(pixels, 0, 0);
  return shown;
};
const missing = ({ series: s, ref }) =>
  !s.has(ref) ? `${runName(s)}there is no ${ref.i < 0 ? "bounce before" : s.title(ref)}` : s.isLoaded(ref) ? "" : "loading …";
const drawPicture = () => {
  const s = series(), ref = shown(), o = other(), two = comparing() || state.wipe;
  const lack = missing({ series: s, ref }) || (comparing() && missing(o));
  const lackOfB = state.wipe && !comparing() && missing(o);
  $("empty").hidden = !lack && !lackOfB;
  $("empty").textContent = lack || lackOfB || "";
  $("a").hidden = !!lack;
  image = lack ? null : paint($("a"), s, ref, comparing() ? o : undefined);
  $("b").hidden = !state.wipe || comparing() || !!lack || !!lackOfB;
  if (!$("b").hidden) paint($("b"), o.series, o.ref);
  $("divider").hidden = $("b").hidden;
  $("side-a").hidden = $("side-b").hidden = !two || !!lack || !!lackOfB;
  $("side-a").textContent = (all.length > 1 ? "" : "A: ") + runName(s) + s.title(ref);
  $("side-b").textContent = (all.length > 1 ? "" : "B: ") + runName(o.series) + o.series.title(o.ref);
  drawScale();
};
const drawScale = () => {
  const scale = image && image.ramp ? image : null;
  $("scale").hidden = !scale;
  if (!scale) return;
  const ramp = new ImageData(256, 1);
  new Uint32Array(ramp.data.buffer).set(scale.ramp);
  $("ramp").getContext("2d").putImageData(ramp, 0, 0);
  const ticks = [];
  if (scale.log) {
    for (let e = Math.ceil(Math.log10(scale.low) - 1e-9); e <= Math.log10(scale.high) + 1e-9; ++e) ticks.push([Math.log10(10 ** e / scale.low) / Math.log10(scale.high / scale.low), number(10 ** e, 1)]);
  } else {
    for (const part of [-1, -.5, 0, .5, 1]) ticks.push([(part + 1) / 2, number(part * scale.high, 2)]);
  }
  $("ticks").replaceChildren(...ticks.map(([at, text]) => {
    const t = element("span", text);
    t.style.left = `${100 * at}%`;
    return t;
  }));
  $("quantity").textContent = scale.quantity + (scale.log ? "; beyond the ends the colours of the ends" : "");
};

// Zoom: the sheet is the whole picture at zoom 1.
const placeSheet = () => {
  const stage = $("stage"), width = stage.clientWidth, s = series();
  const limit = Math.max(.55 * innerHeight, 240), height = Math.min(width * s.height / s.width, limit);
  stage.style.height = `${height}px`;
  const scale = Math.min(width / s.width, height / s.height);
  state.fitScale = scale;
  const sheetWidth = s.width * scale * state.zoom, sheetHeight = s.height * scale * state.zoom;
  const within = (at, size, room) => size <= room ? (room - size) / 2 : Math.min(0, Math.max(room - size, at));
  state.left = within(state.left, sheetWidth, width);
  state.top = within(state.top, sheetHeight, height);
  Object.assign($("sheet").style, { width: `${sheetWidth}px`, height: `${sheetHeight}px`, transform: `translate(${state.left}px, ${state.top}px)` });
  stage.classList.toggle("zoomed", state.zoom > 1);
  const edge = state.edge * width;
  $("divider").style.left = `${edge}px`;
  $("b").style.clipPath = `inset(0 0 0 ${Math.min(sheetWidth, Math.max(0, edge - state.left))}px)`;
  const p = state.pixel, side = scale * state.zoom, box = Math.max(side, 9);
  $("mark").hidden = !p;
  if (p) Object.assign($("mark").style, { left: `${state.left + (p.x + .5) * side - box / 2}px`, top: `${state.top + (p.y + .5) * side - box / 2}px`, width: `${box}px`, height: `${box}px` });
  $("zoom-text").textContent = `1 pixel on ${number(state.fitScale * state.zoom * devicePixelRatio, 2)}`;
};
const zoomTo = (zoom, x, y) => {
  const stage = $("stage");
  x ??= stage.clientWidth / 2;
  y ??= stage.clientHeight / 2;
  const to = Math.min(Math.max(1, zoom), Math.max(1, 64 / state.fitScale));
  state.left = x - (x - state.left) * to / state.zoom;
  state.top = y - (y - state.top) * to / state.zoom;
  state.zoom = to;
  placeSheet();
};
// With the chosen pixel in view.
const zoomAtPixel = zoom => {
  const p = state.pixel, side = state.fitScale * state.zoom;
  p ? zoomTo(zoom, state.left + (p.x + .5) * side, state.top + (p.y + .5) * side) : zoomTo(zoom);
};
const pixelAt = event => {
  const box = $("stage").getBoundingClientRect(), side = state.fitScale * state.zoom;
  const x = Math.floor((event.clientX - box.left - state.left) / side), y = Math.floor((event.clientY - box.top - state.top) / side);
  return x >= 0 && y >= 0 && x < series().width && y < series().height ? { x, y } : null;
};

// Figures of a pixel.
const withInterval = (value, half) => !half ? number(value) : `${number(value)} ± ${Number.isFinite(half) ? number(half, 2) : "unknown"}`;
const drawReadout = () => {
  const at = state.hover ?? state.pixel, s = series(), ref = shown();
  if (!at || missing({ series: s, ref })) {
    $("readout").replaceChildren(element("span", "Point at the picture, or move through it with the arrow keys, to see values; click or Enter chooses a pixel.", "note"));
    return;
  }
  const p = at.y * s.width + at.x, k = s.factor, n = s.pixels;
  const row = ({ series: s, ref }) => {
    const errors = s.errors(ref), patches = s.errors(ref, "_discretisation"), values = [0, 1, 2].map(c => s.meanAt(ref, p + c * n));
    const size = Math.hypot(...values), relative = errors && Math.hypot(...[0, 1, 2].map(c => errors(p + c * n))) / size;
    const text = [["", runName(s) + s.title(ref)], ...["red", "green", "blue"].map((name, c) => [name, withInterval(values[c], s.halfInterval(ref, p + c * n))])];
    if (errors && size > 0) text.push(["relative error", Number.isFinite(relative) ? `${number(100 * relative, 2)}%` : "unknown"]);
    if (patches) text.push(["discretisation", [0, 1, 2].map(c => number(patches(p + c * n), 2)).join(", ")]);
    const line = element("div", undefined, "values");
    text.forEach(([name, value]) => { const part = element("span"); part.append(element("span", name && name + " ", "dim"), value); line.append(part); });
    return line;
  };
  const pictures = [{ series: s, ref }], o = other();
  if ((state.wipe || comparing()) && !missing(o)) pictures.push(o);
  const where = k === 1 ? `Pixel ${at.x}, ${at.y}` : `Mean of pixels ${at.x * k} to ${at.x * k + k - 1}, ${at.y * k} to ${at.y * k + k - 1}`;
  const infinite = pictures.some(({ series, ref }) => series.infiniteVariance(ref)) ? "; the variance is infinite: no intervals" : ", with 95% intervals";
  $("readout").replaceChildren(element("div", `${where}, ${s.unit}${infinite}`, "note"), ...pictures.map(row));
};

// Plots.
const goTo = i => { stop(); set({ i: Math.round(i) }); };
const last = Math.max(...all.map(s => s.last)), anyRest = all.some(s => s.hasRest);
const radiance = `${first.importance ? "importance" : "radiance"} / ${first.unit}`;
const placeOfBounce = () => state.i > series().last ? last + 1 : state.i;
const energyPlot = plot("energy", bounceAxis(last, anyRest), `mean ${radiance}`, [here(placeOfBounce), intervals(() => true)], goTo);
const pixelPlot = plot("pixel", bounceAxis(last, anyRest), radiance, [here(placeOfBounce), intervals(() => true)], goTo);
const errorPlot = plot("error", logAxis("seconds"), "relative error", []);
const drawPlots = () => {
  const draw = (chart, sets) => {
    chart.data.datasets = sets;
    fitRange(chart, sets);
    chart.update();
  };
  draw(energyPlot, energySets(all, names, last + 1));
  if (state.pixel) {
    const p = state.pixel.y * first.width + state.pixel.x;
    draw(pixelPlot, pixelSets(all, names, p, state.sum, last + 1));
  }
  const errors = errorSets(all, names, state.i);
  range(errorPlot.options.scales.x, errors.flatMap(s => s.data.map(p => p.x)));
  draw(errorPlot, [...errors, ...slopeGuide(errors)]);
  $("pixel-title").textContent = state.pixel ? `Pixel ${state.pixel.x * first.factor}, ${state.pixel.y * first.factor}: ${state.sum ? "sums" : "bounces"}` : "The chosen pixel";
  $("pixel-part").hidden = !state.pixel;
  $("pixel-note").textContent = state.pixel ? "With 95% intervals; zero and negative values have no place on a logarithmic axis." : "Click a pixel, or choose one with the arrow keys in the picture.";
};
const drawNotes = () => {
  $("energy-note").textContent = "Mean over pixels and channels, with 95% intervals. " +
    (first.decay && all.length === 1 ? "The fit is to the later half of the bounces. " : "") +
    (first.importance || all.length > 1 ? "" : first.run.bounces.some(b => b.tail_bound > 0) ? "The bound is of the largest radiance anywhere, from the largest albedo." : "There is no bound: the largest albedo is at least 1.");
  $("energy").setAttribute("aria-label", "Mean of each bounce on a logarithmic axis; the same figures are in the table of bounces below");
  $("pixel").setAttribute("aria-label", "The chosen pixel's bounces in red, green and blue on a logarithmic axis");
  $("error").setAttribute("aria-label", "Relative standard error of the bounces and the sum against seconds");
  $("error-note").textContent = "Relative standard error √(Σ SE² / Σ mean²) of the bounce that is shown and of the sum; the other bounces in grey." +
    (all.some(s => s.convergence.length === 1) ? " Where there is one point, errors at fewer samples were not taken." : "");
};

// What is shown, in words and on the controls.
const lastShown = () => series().last + (series().hasRest && !state.sum ? 1 : 0);
const drawText = () => {
  const s = series(), ref = shown();
  $("name").textContent = `${s.title(ref)}: ${s.formula(ref)}`;
  if (s.has(ref)) {
    const whole = s.wholeMean(ref);
    $("mean").textContent = `mean ${withInterval(whole.mean, whole.interval95)} ${s.unit}`;
  }
  $("bounce").max = lastShown();
  $("bounce").value = state.i;
  $("bounce").setAttribute("aria-valuetext", s.title(ref));
  $("bounce-text").textContent = state.i > s.last ? "rest" : `${state.i} of ${s.last}`;
  $("play").textContent = playing ? "Stop" : "Play";
  $("play").setAttribute("aria-pressed", String(!!playing));
  $(state.sum ? "sum" : "term").checked = true;
  for (const id of ["view", "curve", "other", "run"]) $(id).value = String(state[id]);
  for (const id of ["fit", "wipe"]) $(id).checked = state[id];
  for (const id of ["stops", "edge"]) $(id).value = state[id];
  $("wipe").disabled = comparing();
  $("curve").disabled = state.view !== "colour";
  $("stops").disabled = $("fit").disabled = state.view === "noise" || state.view === "z";
  $("edge").disabled = !state.wipe || comparing();
  $("other").disabled = !state.wipe && !comparing();
  $("stops-text").textContent = `${state.stops > 0 ? "+" : state.stops < 0 ? "−" : ""}${Math.abs(state.stops)} stops` + (missing({ series: s, ref }) ? "" : ` (×${number(exposure(s, ref))})`);
};

let drawn = {};
const draw = () => {
  drawPicture();
  placeSheet();
  drawText();
  drawReadout();
  const key = JSON.stringify([state.i, state.sum, state.run, state.pixel, all.map(s => Object.keys(s.planes).length)]);
  if (drawn.plots !== key) { drawn.plots = key; drawPlots(); }
};
let asked = false;
const redraw = () => {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => { asked = false; draw(); });
};
const set = change => {
  Object.assign(state, change);
  state.i = Math.max(0, Math.min(state.i, lastShown()));
  redraw();
};

// Play: all that the slider has, again and again.
const stop = () => {
  if (playing) clearInterval(playing);
  playing = null;
};
const play = () => {
  if (playing) stop();
  else playing = setInterval(() => set({ i: state.i >= lastShown() ? 0 : state.i + 1 }), 667);
  redraw();
};
const step = by => { stop(); set({ i: state.i + by }); };
const next = (id, by = 1) => {
  const options = [...$(id).options].filter(o => !o.disabled && !o.hidden);
  set({ [id]: options[(options.findIndex(o => o.value === $(id).value) + by + options.length) % options.length].value });
};
const movePixel = (dx, dy) => {
  const from = state.pixel ?? { x: series().width >> 1, y: series().height >> 1 }, moved = state.pixel ? [dx, dy] : [0, 0];
  const clamp = (v, size) => Math.max(0, Math.min(size - 1, v));
  set({ hover: null, pixel: { x: clamp(from.x + moved[0], series().width), y: clamp(from.y + moved[1], series().height) } });
};

const keys = [
  ["→  .", "next bounce", ["ArrowRight", "."], () => step(1)],
  ["←  ,", "bounce before", ["ArrowLeft", ","], () => step(-1)],
  ["Home  End", "first, last", ["Home", "End"], key => { stop(); set({ i: key === "Home" ? 0 : lastShown() }); }],
  ["Space", "play, stop", [" "], play],
  ["s", "one bounce or the sum", ["s"], () => set({ sum: !state.sum })],
  ...(all.length > 1 ? [["r", "run A or B", ["r"], () => set({ run: 1 - state.run })]] : []),
  ["v", "next way to show it: colours, false colour, noise, difference", ["v"], () => next("view")],
  ["c  n", "false colour, noise, and back", ["c", "n"], key => { const to = key === "c" ? "false" : "noise"; set({ view: state.view === to ? "colour" : to }); }],
  ["t", "next tone curve", ["t"], () => next("curve")],
  ["[  ]", "exposure down, up", ["[", "]"], key => set({ stops: Math.max(-10, Math.min(20, state.stops + (key === "[" ? -.5 : .5))) })],
  ["f", "exposure fitted to each picture", ["f"], () => set({ fit: !state.fit })],
  ["+  −  0", "zoom in, out, whole picture", ["+", "=", "-", "0"], key => key === "0" ? zoomTo(1) : zoomAtPixel(state.zoom * (key === "-" ? 1 / 1.5 : 1.5))],
  ["w", "wipe between A and B", ["w"], () => set({ wipe: !state.wipe })],
  ["b", "the next B", ["b"], () => next("other")],
  ["<  >", "move the edge of the wipe", ["<", ">"], key => set({ edge: Math.max(0, Math.min(1, state.edge + (key === "<" ? -.05 : .05))) })],
  ["p", "go to the picture; arrow keys choose a pixel there, with Shift ten at a time, and Escape goes back", ["p"], () => { $("stage").focus(); movePixel(0, 0); }],
  ["Esc", "let go of the chosen pixel", ["Escape"], () => { stop(); if (document.activeElement === $("stage")) $("stage").blur(); set({ pixel: null, hover: null }); }],
  ["?", "these keys", ["?"], () => $("help").showModal()]];
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || $("help").open) return;
  const on = event.target, arrow = event.key.startsWith("Arrow");
  if (on === $("stage") && (arrow || event.key === "Enter")) {
    const by = event.shiftKey ? 10 : 1, { ArrowLeft, ArrowRight, ArrowUp, ArrowDown } = { ArrowLeft: [-by, 0], ArrowRight: [by, 0], ArrowUp: [0, -by], ArrowDown: [0, by] };
    movePixel(...({ ArrowLeft, ArrowRight, ArrowUp, ArrowDown }[event.key] ?? [0, 0]));
    event.preventDefault();
    return;
  }
  // What a control does with a key itself.
  if (on.matches("select") || (on.matches("input") && (arrow || ["Home", "End", " "].includes(event.key))) || (on.matches("button, summary, a") && [" ", "Enter"].includes(event.key))) return;
  const key = keys.find(k => k[2].includes(event.key));
  if (!key) return;
  key[3](event.key);
  event.preventDefault();
});

// Controls.
others.forEach(([value, text]) => { const o = element("option", text); o.value = value; $("other").append(o); });
if (all.length > 1) {
  $("run-label").hidden = false;
  ["A", "B"].forEach((text, i) => { const o = element("option", text); o.value = i; $("run").append(o); });
}
for (const o of $("view").options) o.hidden = o.disabled = o.value === "z" && all.length === 1;
$("bounce").oninput = e => { stop(); set({ i: +e.target.value }); };
$("previous").onclick = () => step(-1);
$("next").onclick = () => step(1);
$("play").onclick = play;
$("term").onchange = $("sum").onchange = () => set({ sum: $("sum").checked });
$("run").onchange = e => set({ run: +e.target.value });
for (const id of ["view", "curve", "other"]) $(id).onchange = e => set({ [id]: e.target.value });
for (const id of ["stops", "edge"]) $(id).oninput = e => set({ [id]: +e.target.value });
for (const id of ["fit", "wipe"]) $(id).onchange = e => set({ [id]: e.target.checked });
$("in").onclick = () => zoomAtPixel(state.zoom * 1.5);
$("out").onclick = () => zoomAtPixel(state.zoom / 1.5);
$("whole").onclick = () => zoomTo(1);
$("help-button").onclick = () => $("help").showModal();
facts("keys", keys.map(([, what]) => ["", what]));
keys.forEach(([names], row) => names.split("  ").forEach(key => $("keys").rows[row].cells[0].append(element("kbd", key), " ")));

// The pointer: hover tells values, a click chooses, a drag moves the zoomed picture or the edge of the wipe, two fingers zoom.
const pointers = new Map();
let drag = null;
const stage = $("stage");
stage.onpointerdown = e => {
  pointers.set(e.pointerId, e);
  const x = e.clientX - stage.getBoundingClientRect().left;
  drag = { x: e.clientX, y: e.clientY, left: state.left, top: state.top, moved: false,
           edge: !$("divider").hidden && Math.abs(x - state.edge * stage.clientWidth) < 12 };
  stage.setPointerCapture(e.pointerId);
};
stage.onpointermove = e => {
  const before = pointers.get(e.pointerId);
  if (pointers.size === 2 && before) {
    const [a, b] = [...pointers.values()], box = stage.getBoundingClientRect();
    const apart = (p, q) => Math.hypot(p.clientX - q.clientX, p.clientY - q.clientY), old = apart(a, b);
    pointers.set(e.pointerId, e);
    const [c, d] = [...pointers.values()];
    if (old > 0) zoomTo(state.zoom * apart(c, d) / old, (c.clientX + d.clientX) / 2 - box.left, (c.clientY + d.clientY) / 2 - box.top);
    drag = null;
    return;
  }
  if (before) pointers.set(e.pointerId, e);
  if (before && drag) {
    const dx = e.clientX - drag.x, dy = e.clientY - drag.y;
    drag.moved ||= Math.hypot(dx, dy) > 4;
    if (drag.edge) set({ edge: Math.max(0, Math.min(1, (e.clientX - stage.getBoundingClientRect().left) / stage.clientWidth)) });
    else if (drag.moved && state.zoom > 1) {
      state.left = drag.left + dx;
      state.top = drag.top + dy;
      placeSheet();
    }
  }
  state.hover = pixelAt(e);
  drawReadout();
};
stage.onpointerup = stage.onpointercancel = e => {
  const clicked = e.type === "pointerup" && drag && !drag.moved && !drag.edge;
  pointers.delete(e.pointerId);
  drag = null;
  if (clicked) set({ pixel: pixelAt(e) });
};
stage.onpointerleave = () => { state.hover = null; drawReadout(); };
stage.addEventListener("wheel", e => {
  if (!e.ctrlKey && !stage.classList.contains("zoomed") && document.activeElement !== stage) return;  // the page scrolls
  const box = stage.getBoundingClientRect();
  zoomTo(state.zoom * Math.exp(-.002 * e.deltaY), e.clientX - box.left, e.clientY - box.top);
  e.preventDefault();
}, { passive: false });
addEventListener("resize", placeSheet);
matchMedia("(prefers-color-scheme: dark)").onchange = () => { drawn = {}; redraw(); };

// The run in words.
const sceneOf = s => s.run.scene.file.split("/").pop();
const summary = s => `bounces 0 to ${s.last} by ${s.run.options.method}, ${whole(s.run.samples.per_pixel)} samples a pixel in ${number(s.run.timing.total_seconds)} s`;
document.title = $("title").textContent = [...new Set(all.map(sceneOf))].join(" and ") + (all.length > 1 ? ": A and B" : "");
$("subtitle").textContent = all.map(s => runName(s) + summary(s)).join("; ");
all.forEach(s => s.run.warnings.forEach(w => $("warnings").append(element("p", runName(s) + w.text + (w.count > 1 ? ` (${w.count} times)` : ""), "warning"))));

// Any JSON as text or a nested table; { mean, stderr, … } is one number with its interval.
const isMean = v => v !== null && typeof v === "object" && "mean" in v && Object.keys(v).every(k => ["mean", "stderr", "degrees_of_freedom", "interval95"].includes(k));
const isFlat = v => v === null || typeof v !== "object" || isMean(v) || (Array.isArray(v) && v.every(x => x === null || typeof x !== "object"));
const flatText = v => v === null ? "–" : Array.isArray(v) ? v.map(flatText).join(", ") || "none" : isMean(v) ? withInterval(v.mean, typeof v.interval95 === "number" ? v.interval95 : Infinity)
  : typeof v === "number" ? (Number.isInteger(v) ? whole(v) : number(v, 4)) : typeof v === "boolean" ? (v ? "yes" : "no") : String(v);
const words = key => key.replaceAll("_", " ");
const generic = value => {
  if (value && typeof value === "object" && Object.keys(value).length === 0) return document.createTextNode("none");
  if (isFlat(value)) return document.createTextNode(flatText(value));
  if (Array.isArray(value) && value.every(v => v && !Array.isArray(v) && Object.values(v).every(isFlat))) {
    const head = [...new Set(value.flatMap(Object.keys))], wide = element("div", undefined, "wide generic");
    wide.append(table(head.map(words), value.map(v => head.map(h => h in v ? flatText(v[h]) : "")), head.map((_, i) => i).filter(i => value.some(v => typeof v[head[i]] === "string"))));
    return wide;
  }
  const t = element("table", undefined, "facts");
  Object.entries(value).forEach(([k, v]) => {
    const tr = element("tr"), td = element("td");
    td.append(generic(v));
    tr.append(element("td", Array.isArray(value) ? String(+k + 1) : words(k)), td);
    t.append(tr);
  });
  return t;
};
const section = (title, ...parts) => $("tables").append(element("h2", title), ...parts);
const wide = t => { const w = element("div", undefined, "wide"); w.append(t); return w; };
const bouncesTable = s => {
  const b = s.run.bounces, rest = s.run.rest, row = (name, x) => [name, number(x.mean), typeof x.interval95 === "string" ? "none: infinite variance" : number(x.interval95, 2),
    x.ratio_estimate === undefined ? "" : number(x.ratio_estimate), x.tail_bound === undefined ? "" : x.tail_bound === null ? "none" : number(x.tail_bound),
    x.rays === undefined ? "" : whole(x.rays), ...(discretised ? [x.discretisation ? number(x.discretisation.mean, 2) : ""] : []),
    ...(subset ? [x.missing ? number(x.missing.mean) : ""] : [])];
  const discretised = b.some(x => x.discretisation), subset = b.some(x => x.missing);
  return wide(table(["bounce", `mean / ${s.unit}`, "± (95%)", "ratio", "bound on what follows", "rays", ...(discretised ? ["discretisation"] : []), ...(subset ? ["missing"] : [])],
    [...b.map((x, i) => row(i, x)), row("sum", s.run.sum), ...(rest.mean === undefined ? [] : [row("rest", rest)])], []));
};
if (data.comparison) {
  section("A against B, the reference", wide(table(["", "RMSE", "by noise", "relMSE", "MAPE", "SMAPE", "max |A−B|", "mean of A − B", "95% interval"],
    data.comparison.pictures.map(p => [p.name, ...["rmse", "rmse_by_noise", "rel_mse", "mape", "smape", "max_error", "mean_difference"].map(k => number(p[k])),
      p.interval ? `${number(p.interval[0])} to ${number(p.interval[1])}` : "unknown"]), [])),
    element("p", `Over pixels and channels, as fractions; ε = ${data.comparison.epsilon}.`, "note"));
}
all.forEach(s => {
  const tag = all.length > 1 ? ` of ${"AB"[s.index]}` : "", run = s.run;
  section(`The bounces${tag}`, bouncesTable(s));
  if (run.plan) section(`The plan${tag}: what was left out, and why`, generic(run.plan));
  if (run.health) section(`Health${tag}`, generic(run.health));
  const what = { command: run.command, ...run };
  for (const part of ["plan", "health", "bounces", "warnings", "ways"]) delete what[part];
  if (run.non_finite_samples.count === 0) delete what.non_finite_samples;
  section(`The run${tag}`, generic(what));
});
section("How exact this page is", element("p", "Pictures are held here as half floats: values are right to 0.05% (three digits), standard errors to 3%. " +
  (first.factor > 1 ? `Each pixel is the mean of ${first.factor} × ${first.factor}. ` : "") + "All digits are in the EXR files beside it."));
drawNotes();

// First what is seen first.
const loadAll = async () => {
  if (typeof DecompressionStream === "undefined") throw new Error("This browser cannot unpack the pictures: it takes Chrome 80, Firefox 113, Safari 16.4 or later.");
  for (const s of all) await s.load(state.i);
  draw();
  for (const s of all) for (let i = 0; i < s.heads.length; ++i) if (!s.planes[i]) await s.load(i);
  draw();
  document.body.dataset.ready = "yes";
};
loadAll().catch(e => { $("warnings").append(element("p", e.message, "warning")); });
