"use strict";
// The picture and its zoom.
let image = null;  // what shownAs returned for picture A
// Draws a picture, `times` as bright. With `o`, draws its difference from picture `o`, where the view is one of differences.
const paint = (canvas, s, ref, o, times = 1) => {
  const view = comparing() && !o ? "colour" : state.view;
  const shown = shownAs[view](s, ref, { exposure: exposure(s, ref) * times, curve: state.curve, decades: state.decades, other: o });
  fill(canvas, s.width, s.height, shown.at);
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
  $("dark").hidden = !!lack || comparing() || brightening(s, ref) === 1;
  $("side-a").hidden = $("side-b").hidden = !two || !!lack || !!lackOfB;
  $("side-a").textContent = (all.length > 1 ? "" : "A: ") + runName(s) + s.title(ref);
  $("side-b").textContent = (all.length > 1 ? "" : "B: ") + runName(o.series) + o.series.title(o.ref);
  drawScale();
};
// `ticks`: pairs of the position along the scale, from 0 to 1, and the label.
const placeTicks = (id, ticks) => $(id).replaceChildren(...ticks.map(([at, text]) => {
  const t = element("span", text);
  t.style.left = `${100 * at}%`;
  return t;
}));
const decadeTicks = (low, high) => {
  const ticks = [], decades = Math.log10(high / low);
  for (let e = Math.ceil(Math.log10(low) - 1e-9); e <= Math.log10(high) + 1e-9; e += Math.ceil(decades / 8)) ticks.push([Math.log10(10 ** e / low) / decades, number(10 ** e, 1)]);
  return ticks;
};
const signedTicks = most => [-1, -.5, 0, .5, 1].map(part => [(part + 1) / 2, number(part * most, 2)]);
const drawScale = () => {
  const scale = image && image.ramp ? image : null;
  $("scale").hidden = !scale;
  if (!scale) return;
  const ramp = new ImageData(256, 1);
  new Uint32Array(ramp.data.buffer).set(scale.ramp);
  $("ramp").getContext("2d").putImageData(ramp, 0, 0);
  placeTicks("ticks", scale.log ? decadeTicks(scale.low, scale.high) : signedTicks(scale.high));
  $("quantity").textContent = scale.quantity + (scale.log ? "; beyond the ends the colours of the ends" : "");
};

// The height in CSS pixels that the layout reserves for the figures below the picture, however many there are, so that the picture
// and what is beside it keep their size.
const figuresRoom = 66;
const placeSheet = () => {
  const stage = $("stage"), width = stage.clientWidth, s = series(), viewer = stage.parentElement;
  // Limits the height of the picture so that all of the viewer is in sight, but not below 45% of the window and 240 pixels.
  const high = e => e.getBoundingClientRect().height, figures = high($("readout")), room = state.slide ? 0 : figuresRoom;
  const around = high(viewer) - high(stage) - figures + room, taken = Math.ceil(viewer.getBoundingClientRect().top + scrollY + around);
  const limit = Math.max(.45 * innerHeight, 240, innerHeight - taken), height = state.slide ? innerHeight - taken : Math.min(width * s.height / s.width, limit);
  stage.style.height = `${height}px`;
  viewer.parentElement.style.setProperty("--viewer", `${around + height}px`);
  const scale = Math.min(width / s.width, height / s.height);
  // Keeps the point in the middle of the stage there when the size of the stage changes.
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
  const r = state.rect;
  $("rect").hidden = !r;
  if (r) Object.assign($("rect").style, { left: `${state.left + r.x0 * side}px`, top: `${state.top + r.y0 * side}px`, width: `${(r.x1 - r.x0 + 1) * side}px`, height: `${(r.y1 - r.y0 + 1) * side}px` });
  drawOnPicture();
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
// Zooms about the chosen pixel, or about the middle of the stage if no pixel is chosen.
const zoomAtPixel = zoom => {
  const p = state.pixel, side = state.fitScale * state.zoom;
  p ? zoomTo(zoom, state.left + (p.x + .5) * side, state.top + (p.y + .5) * side) : zoomTo(zoom);
};
const placeAt = event => {
  const box = $("stage").getBoundingClientRect(), side = state.fitScale * state.zoom;
  return { x: Math.floor((event.clientX - box.left - state.left) / side), y: Math.floor((event.clientY - box.top - state.top) / side) };
};
const nearest = ({ x, y }) => ({ x: Math.max(0, Math.min(series().width - 1, x)), y: Math.max(0, Math.min(series().height - 1, y)) });
const pixelAt = event => {
  const at = placeAt(event), { x, y } = nearest(at);
  return x === at.x && y === at.y ? at : null;
};
const rectOf = (a, b) => ({ x0: Math.min(a.x, b.x), y0: Math.min(a.y, b.y), x1: Math.max(a.x, b.x), y1: Math.max(a.y, b.y) });
