"use strict";
// Keeps the state of the page in its address, so that a link or a bookmark restores it: #bounce=3&sum=1&pixel=19,160.

const flag = text => ({ 0: false, 1: true })[text];
const within = (low, high) => text => text.trim() !== "" && +text >= low && +text <= high ? +text : undefined;
const oneOf = values => text => values().includes(text) ? text : undefined;
const chosen = id => oneOf(() => [...$(id).options].filter(o => !o.disabled).map(o => o.value));
const numbers = (text, count) => {
  const found = text.split(",");
  return found.length === count && found.every(n => n.trim() !== "" && Number.isFinite(+n)) ? found.map(Number) : undefined;
};
const inPicture = ({ x, y }) => x >= 0 && y >= 0 && x < first.width && y < first.height;
const pixelsRead = (text, count) => {
  const found = numbers(text, 2 * count), pixels = [];
  for (let k = 0; found && k < count; ++k) {
    const { x, y } = fromFilm(found[2 * k], found[2 * k + 1]);
    pixels.push({ x: Math.floor(x), y: Math.floor(y) });
  }
  return pixels.length && pixels.every(inPicture) ? pixels : undefined;
};
const pixelsWritten = (...pixels) => pixels.map(onFilm).join();

// For each name in the address: the member of the state, a function that writes its value, and one that reads it. The latter
// returns undefined for a text without a meaning.
const addressed = {
  run: ["run", v => v + 1, text => oneOf(() => all.map((_, r) => String(r + 1)))(text) && text - 1],
  bounce: ["i", v => v > series().last ? "rest" : v, text => text === "rest" ? Infinity : oneOf(() => [...Array(Math.max(...all.map(s => s.last)) + 1).keys()].map(String))(text) && +text],
  sum: ["sum", Number, flag],
  view: ["view", String, chosen("view")],
  curve: ["curve", String, chosen("curve")],
  exposure: ["stops", Number, within(-10, 20)],
  decades: ["decades", Number, within(.3, 12)],
  fit: ["fit", Number, flag],
  pixel: ["pixel", pixelsWritten, text => pixelsRead(text, 1)?.[0]],
  rect: ["rect", r => pixelsWritten({ x: r.x0, y: r.y0 }, { x: r.x1, y: r.y1 }), text => { const ends = pixelsRead(text, 2); return ends && rectOf(...ends); }],
  wipe: ["wipe", Number, flag],
  edge: ["edge", v => +v.toFixed(3), within(0, 1)],
  b: ["other", String, chosen("other")],
  path: ["path", String, text => /^\d+$/.test(text) ? text : undefined],
  asking: ["asking", Number, flag],
  paths: ["pathShown", Number, flag],
  slide: ["slide", String, oneOf(() => ["dark", "white"])]
};
const beginning = { ...state };

// The zoom, and the position on the film in the middle of the stage: "zoom,x,y".
const zoomWritten = () => {
  const side = state.fitScale * state.zoom, { clientWidth: width, clientHeight: height } = $("stage");
  return [state.zoom, ...onFilm({ x: (width / 2 - state.left) / side, y: (height / 2 - state.top) / side })].map(v => +v.toFixed(2)).join();
};
const zoomRead = text => {
  const found = numbers(text, 3);
  return found && found[0] >= 1 && inPicture(fromFilm(found[1], found[2])) ? { zoom: found[0], middle: fromFilm(found[1], found[2]) } : undefined;
};
const lookAt = ({ zoom, middle: { x, y } }) => {
  zoomTo(zoom);
  const side = state.fitScale * state.zoom;
  state.left = $("stage").clientWidth / 2 - x * side;
  state.top = $("stage").clientHeight / 2 - y * side;
  placeSheet();
};

// Waits until the state has not changed for 200 ms, because browsers refuse to change the address many times a second.
let addressKept = null;
const keepAddress = () => {
  if (location.href === "about:srcdoc") return;  // the frame of a notebook, where the page has no address of its own
  clearTimeout(addressKept);
  addressKept = setTimeout(() => {
    const parts = Object.entries(addressed).filter(([, [key]]) => state[key] !== beginning[key] && state[key] !== null && state[key] !== "").map(([name, [key, write]]) => `${name}=${write(state[key])}`);
    if (state.zoom > 1) parts.push(`zoom=${zoomWritten()}`);
    history.replaceState(null, "", parts.length ? "#" + parts.join("&") : location.pathname + location.search);
  }, 200);
};
const readAddress = () => {
  const given = new URLSearchParams(location.hash.slice(1)), to = {};
  for (const [name, [key, , read]] of Object.entries(addressed)) to[key] = (given.has(name) ? read(given.get(name)) : undefined) ?? beginning[key];
  if (to.i > all[to.run].last && to.i !== Infinity) to.i = beginning.i;
  state.run = to.run;
  state.sum = to.sum;
  set(to);
  draw();
  lookAt(zoomRead(given.get("zoom") ?? "") ?? { zoom: 1, middle: { x: 0, y: 0 } });
};
addEventListener("hashchange", readAddress);
