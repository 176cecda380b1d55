"use strict";
// The strip: all bounces, or all sums, as small pictures in a row.
const strip = { tiles: [], asked: false };

const refOf = i => ({ i, sum: state.sum });
const makeTiles = count => {
  strip.tiles = Array.from({ length: count }, (_, i) => {
    const tile = element("button");
    tile.append(element("canvas"), element("span", "", "times"), element("span"));
    tile.onclick = () => goTo(i);
    return tile;
  });
  $("strip").replaceChildren(...strip.tiles);
};
// Scrolls the strip to the tile of the picture that is shown, and moves the focus to it if another tile has the focus.
const bringIntoSight = tile => {
  const box = $("strip"), left = tile.offsetLeft - box.offsetLeft, right = left + tile.offsetWidth;
  if (left < box.scrollLeft || right > box.scrollLeft + box.clientWidth) box.scrollLeft = left - (box.clientWidth - tile.offsetWidth) / 2;
  if (box.contains(document.activeElement)) tile.focus({ preventScroll: true });
};
const nameTile = (tile, s, ref) => {
  tile.title = s.title(ref) + (tile.times > 1 ? `, ${whole(tile.times)} times as bright` : "");
  tile.setAttribute("aria-label", tile.title);
};
const drawStrip = () => {
  const s = series();
  if (strip.tiles.length !== lastShown() + 1) makeTiles(lastShown() + 1);
  strip.tiles.forEach((tile, i) => {
    const current = i === state.i;
    tile.lastChild.textContent = i > s.last ? "rest" : state.sum && i > 0 ? `0–${i}` : i;
    nameTile(tile, s, refOf(i));
    tile.tabIndex = current ? 0 : -1;
    if (current && tile.getAttribute("aria-current") !== "true") bringIntoSight(tile);
    tile.setAttribute("aria-current", String(current));
  });
  paintTiles();
};
// Draws the tiles that are in sight and out of date, for at most 12 ms in each frame of the browser.
const paintTiles = () => {
  if (strip.asked) return;
  strip.asked = true;
  requestAnimationFrame(() => {
    strip.asked = false;
    const until = performance.now() + 12, s = series(), box = $("strip");
    for (const [i, tile] of strip.tiles.entries()) {
      const left = tile.offsetLeft - box.offsetLeft - box.scrollLeft, ref = refOf(i);
      if (left > box.clientWidth || left + tile.offsetWidth < 0 || missing({ series: s, ref })) continue;
      const as = JSON.stringify([s.index, ref, comparing() ? "colour" : state.view, state.curve, exposure(s, ref), state.fit]);
      if (tile.drawnAs === as) continue;
      if (performance.now() > until) { paintTiles(); return; }
      paintTile(tile, s, ref);
      tile.drawnAs = as;
    }
  });
};
const largestTile = 96;  // pixels of the screen; larger pictures are scaled down to it
const painted = document.createElement("canvas");
const paintTile = (tile, s, ref) => {
  const scale = Math.min(1, largestTile / Math.max(s.width, s.height)), times = brightening(s, ref), [canvas, brightened] = tile.children;
  brightened.textContent = times > 1 ? `×${times < 1024 ? times : "2" + superscript(Math.log2(times))}` : "";
  tile.times = times;
  nameTile(tile, s, ref);
  paint(painted, s, ref, undefined, times);
  canvas.width = Math.max(1, Math.round(scale * s.width));
  canvas.height = Math.max(1, Math.round(scale * s.height));
  const to = canvas.getContext("2d", { willReadFrequently: true });
  to.imageSmoothingQuality = "high";
  to.drawImage(painted, 0, 0, canvas.width, canvas.height);
};
$("strip").onscroll = paintTiles;
