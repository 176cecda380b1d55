"use strict";
// The picture, its zoom, and the figures under it.
let image = null;  // what A shows
// With `o` the difference to it.
const paint = (canvas, s, ref, o) => {
  canvas.width = s.width;
  canvas.height = s.height;
  const view = comparing() && !o ? "colour" : state.view;
  const shown = shownAs[view](s, ref, exposure(s, ref), o ? o.series : state.curve, o && o.ref);
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
  const stage = $("stage"), width = stage.clientWidth, s = series(), viewer = stage.parentElement;
  // What else the viewer holds is in sight with the picture where there is room.
  const taken = viewer.parentElement.offsetTop + viewer.offsetHeight - stage.offsetHeight;
  const limit = Math.max(.45 * innerHeight, 240, innerHeight - taken), height = state.slide ? innerHeight - taken : Math.min(width * s.height / s.width, limit);
  stage.style.height = `${height}px`;
  const scale = Math.min(width / s.width, height / s.height);
  // What was in the middle stays there when the stage changes.
  if (state.fitScale) {
    state.left = width / 2 - (state.stageWidth / 2 - state.left) * scale / state.fitScale;
    state.top = height / 2 - (state.stageHeight / 2 - state.top) * scale / state.fitScale;
  }
  Object.assign(state, { fitScale: scale, stageWidth: width, stageHeight: height });
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
  keepAddress();
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
// Zero with an interval is what no sample met.
const withInterval = (value, half) => !half ? number(value) : value === 0 && Number.isFinite(half) ? `0, at most ${number(half, 2)}` : `${number(value)} ± ${Number.isFinite(half) ? number(half, 2) : "unknown"}`;
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
    if (errors && size > 0) text.push(["relative standard error", Number.isFinite(relative) ? `${number(100 * relative, 2)}%` : "unknown"]);
    if (errors && values.some((v, c) => v === 0 && errors(p + c * n) === 0)) text.push(["", patches ? "0: no light in any sample" : "0: known to be dark"]);
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
