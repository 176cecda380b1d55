"use strict";
// The plots, the controls, the keys and the pointer.

const goTo = i => { stop(); set({ i: Math.round(i) }); };
const last = Math.max(...all.map(s => s.last)), anyRest = all.some(s => s.hasRest);
const radiance = radianceOf(first);
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
  $("pixel-title").textContent = state.pixel ? `Pixel ${onFilm(state.pixel).join(", ")}: ${state.sum ? "sums" : "bounces"}` : "The chosen pixel";
  $("pixel-part").hidden = !state.pixel;
  $("pixel-note").classList.toggle("none", !state.pixel);
  $("pixel-note").textContent = state.pixel ? "With 95% intervals; zero and negative values have no place on a logarithmic axis." : "Click a pixel, or choose one with the arrow keys in the picture.";
};
const drawNotes = () => {
  $("energy-note").textContent = "Mean over pixels and channels, with 95% intervals; a click goes to the bounce. " +
    (first.decay && all.length === 1 ? "The fit is to the later half. " : "") +
    (first.importance || all.length > 1 ? "" : first.run.bounces.some(b => b.tail_bound > 0) ? "The bound is on the largest radiance anywhere in the scene, and follows from the largest albedo." : "There is no bound: the largest albedo is at least 1.");
  $("energy").setAttribute("aria-label", "Mean of each bounce on a logarithmic axis; the same figures are in the table of bounces below");
  $("pixel").setAttribute("aria-label", "The chosen pixel's bounces in red, green and blue on a logarithmic axis");
  $("error").setAttribute("aria-label", "Relative standard error of the bounces and the sum against seconds");
  $("error-note").textContent = "Relative standard error √(Σ SE² / Σ mean²) of the bounce that is shown and of the sum; the other bounces in grey: a click on a point shows its bounce." +
    (all.some(s => s.convergence.filter(row => Number.isFinite(row.relative_stderr_sum)).length === 1) ? " A curve with one point: errors at fewer samples were not measured." : "");
};

// Writes the state into the caption and onto the controls.
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
  $("picking").setAttribute("aria-pressed", String(state.picking));
  $("stage").classList.toggle("picking", state.picking);
  for (const id of ["fit", "wipe"]) $(id).checked = state[id];
  for (const id of ["stops", "edge"]) $(id).value = state[id];
  $("wipe").disabled = comparing();
  $("curve").disabled = state.view !== "colour";
  $("stops").disabled = $("fit").disabled = state.view === "noise" || comparing();
  $("edge").disabled = !state.wipe || comparing();
  $("other").disabled = !state.wipe && !comparing();
  $("stops-text").textContent = `${state.stops > 0 ? "+" : state.stops < 0 ? "−" : ""}${+Math.abs(state.stops).toFixed(1)} stops` + (missing({ series: s, ref }) ? "" : ` (×${number(exposure(s, ref))})`);
};

let drawn = {};
const draw = () => {
  drawPicture();
  drawText();
  drawReadout();
  drawStrip();
  drawHistogram();
  drawSlide();
  placeSheet();
  const key = JSON.stringify([state.i, state.sum, state.run, state.pixel, state.path, state.asking, all.map(s => Object.keys(s.planes).length)]);
  if (drawn.plots !== key) { drawn.plots = key; drawPlots(); drawPaths(); }
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

// Plays all pictures of the slider in a loop, 1.5 a second.
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
  const from = state.pixel ?? { x: series().width >> 1, y: series().height >> 1 }, pixel = state.pixel ? nearest({ x: from.x + dx, y: from.y + dy }) : from;
  set({ hover: null, pixel, ...(state.corner && { rect: rectOf(state.corner, pixel) }) });
};
// Fixes a corner of a rectangle at the chosen pixel: the arrow keys then move the opposite corner, until the next call.
const spanRect = () => {
  if (state.corner) { set({ corner: null }); return; }
  $("stage").focus();
  movePixel(0, 0);
  set({ corner: state.pixel, rect: rectOf(state.pixel, state.pixel) });
};

const keys = [
  ["→  .", "next bounce", ["ArrowRight", "."], () => step(1)],
  ["←  ,", "bounce before", ["ArrowLeft", ","], () => step(-1)],
  ["Home  End", "first, last", ["Home", "End"], key => { stop(); set({ i: key === "Home" ? 0 : lastShown() }); }],
  ["Space", "play, stop", [" "], play],
  ["s", "one bounce or the sum", ["s"], () => set({ sum: !state.sum })],
  ...(all.length > 1 ? [["r", "the next run", ["r"], () => set({ run: (state.run + 1) % all.length })],
    [`1 – ${Math.min(9, all.length)}`, `run ${all.map((_, r) => letter(r)).slice(0, 9).join(", ")}`, [..."123456789"].slice(0, all.length), key => set({ run: key - 1 })]] : []),
  ["v", "next way to show it: colours, false colour, noise, difference", ["v"], () => next("view")],
  ["c  n", "false colour, noise, and back", ["c", "n"], key => { const to = key === "c" ? "false" : "noise"; set({ view: state.view === to ? "colour" : to }); }],
  ["t", "next tone curve", ["t"], () => next("curve")],
  ["[  ]", "exposure down, up", ["[", "]"], key => set({ stops: Math.max(-10, Math.min(20, state.stops + (key === "[" ? -.5 : .5))) })],
  ["f", "expose each picture by itself", ["f"], () => set({ fit: !state.fit })],
  ["+  −  0", "zoom in, out, whole picture", ["+", "=", "-", "0"], key => key === "0" ? zoomTo(1) : zoomAtPixel(state.zoom * (key === "-" ? 1 / 1.5 : 1.5))],
  ["w", "wipe between A and B", ["w"], () => set({ wipe: !state.wipe })],
  ["b", "the next B", ["b"], () => next("other")],
  ["<  >", "move the edge of the wipe", ["<", ">"], key => set({ edge: Math.max(0, Math.min(1, state.edge + (key === "<" ? -.05 : .05))) })],
  ["p", "go to the picture; arrow keys choose a pixel there, with Shift ten at a time, and Escape goes back", ["p"], () => { $("stage").focus(); movePixel(0, 0); }],
  ["l", "slides: the picture and its formula fill the screen; a click goes on, left of the middle back", ["l"], () => state.slide ? leaveSlides() : enterSlides()],
  ["d", "dark or white slides", ["d"], () => { if (state.slide) set({ slide: state.slide === "dark" ? "white" : "dark" }); }],
  ["a", "a rectangle from the chosen pixel on, by the arrow keys, until a is pressed again; with the mouse, Shift and a drag", ["a"], spanRect],
  ["Esc", "leave the slides, or give up the chosen pixel and the rectangle", ["Escape"], () => { stop(); if (state.slide) return leaveSlides(); if (document.activeElement === $("stage")) $("stage").blur(); set({ pixel: null, hover: null, rect: null, corner: null, picking: false }); }],
  ...(all.some(pathsOf) ? [["j  k", "the next path of the pixel, the one before", ["j", "k"], key => stepPath(key === "j" ? 1 : -1)],
    ["o", "paths over the picture", ["o"], () => set({ pathShown: !state.pathShown })],
    ["h", "shadow rays", ["h"], () => set({ asking: !state.asking })]] : []),
  ["i", "save the picture as PNG", ["i"], () => savePicture()],
  ["y", "copy the values of the chosen pixel", ["y"], () => copyPixel()],
  ["?", "these keys", ["?"], () => $("help").showModal()]];
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || $("help").open || $("copy").open) return;
  const on = event.target, arrow = event.key.startsWith("Arrow");
  if (on === $("stage") && !state.slide && (arrow || event.key === "Enter")) {
    const by = event.shiftKey ? 10 : 1, { ArrowLeft, ArrowRight, ArrowUp, ArrowDown } = { ArrowLeft: [-by, 0], ArrowRight: [by, 0], ArrowUp: [0, -by], ArrowDown: [0, by] };
    movePixel(...({ ArrowLeft, ArrowRight, ArrowUp, ArrowDown }[event.key] ?? [0, 0]));
    event.preventDefault();
    return;
  }
  // The keys to which a control that has the focus reacts by itself.
  const own = { "select": () => true, "[type=range]": () => arrow || ["Home", "End"].includes(event.key), "[type=radio]": () => arrow || event.key === " ",
                "[type=checkbox]": () => event.key === " ", "button:not(#strip *), summary, a": () => [" ", "Enter"].includes(event.key) };
  if (Object.entries(own).some(([kind, does]) => on.matches(kind) && does())) return;
  const key = keys.find(k => k[2].includes(event.key));
  if (!key) return;
  key[3](event.key);
  event.preventDefault();
});

others.forEach(([value, text]) => { const o = element("option", text); o.value = value; $("other").append(o); });
if (all.length > 1) {
  $("run-label").hidden = false;
  all.forEach((s, i) => { const o = element("option", runName(s) + s.run.options.method); o.value = i; $("run").append(o); });
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
$("picking").onclick = () => set({ picking: !state.picking });
$("whole").onclick = () => zoomTo(1);
$("help-button").onclick = () => $("help").showModal();
facts("keys", keys.map(([, what]) => ["", what]));
keys.forEach(([names], row) => names.split("  ").forEach(key => $("keys").rows[row].cells[0].append(element("kbd", key), " ")));

// The pointer: the values under it are shown, a click chooses a pixel, and two fingers zoom. A drag moves the zoomed picture or the
// edge of the wipe; with Shift it makes a rectangle.
const pointers = new Map();
let drag = null;
const stage = $("stage");
stage.onpointerdown = e => {
  pointers.set(e.pointerId, e);
  const x = e.clientX - stage.getBoundingClientRect().left;
  drag = { x: e.clientX, y: e.clientY, left: state.left, top: state.top, moved: false,
           corner: (e.shiftKey || state.picking) && !state.slide ? nearest(placeAt(e)) : null, edge: !$("divider").hidden && Math.abs(x - state.edge * stage.clientWidth) < 12 };
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
    if (drag.corner) set({ rect: rectOf(drag.corner, nearest(placeAt(e))) });
    else if (drag.edge) set({ edge: Math.max(0, Math.min(1, (e.clientX - stage.getBoundingClientRect().left) / stage.clientWidth)) });
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
  if (drag?.corner && drag.moved) set({ picking: false, corner: null });
  pointers.delete(e.pointerId);
  drag = null;
  if (clicked && state.slide) step(e.clientX < innerWidth / 2 ? -1 : 1);
  else if (clicked) set({ pixel: pixelAt(e) });
};
stage.onpointerleave = () => { state.hover = null; drawReadout(); };
// The wheel zooms the picture. Where the whole of it is seen already the page scrolls on, and a page that scrolls is not stopped by
// a picture that comes under the pointer: a turn of the wheel ends with a pause.
const wheel = { pause: 300, scrolled: -Infinity, zoomed: -Infinity };
addEventListener("scroll", () => { wheel.scrolled = performance.now(); });
stage.addEventListener("wheel", e => {
  const now = performance.now();
  if (!e.ctrlKey && (now - wheel.scrolled < wheel.pause || (e.deltaY > 0 && state.zoom === 1 && now - wheel.zoomed > wheel.pause))) return;  // the page scrolls
  wheel.zoomed = now;
  const box = stage.getBoundingClientRect();
  zoomTo(state.zoom * Math.exp(-.002 * e.deltaY), e.clientX - box.left, e.clientY - box.top);
  e.preventDefault();
}, { passive: false });
// Paper has one column, of its own width.
const forPaper = on => {
  document.body.classList.toggle("printing", on);
  placeSheet();
  for (const chart of [energyPlot, pixelPlot, errorPlot, historyPlot, pixelErrorPlot]) chart.resize();
};
addEventListener("beforeprint", () => forPaper(true));
addEventListener("afterprint", () => forPaper(false));
addEventListener("resize", () => { placeSheet(); paintTiles(); });
matchMedia("(prefers-color-scheme: dark)").onchange = () => { drawn = {}; redraw(); };
