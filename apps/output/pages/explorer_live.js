"use strict";
// Updates the page of a render that is under way: replaces its data, and keeps what the user has chosen.

const sayHowFar = text => { $("so-far").textContent = text; };
const loadAnew = () => new Promise(() => location.reload());
const isAlike = (a, b) => ["width", "height", "last", "hasRest"].every(of => a[of] === b[of]);
// Forgets all that was computed from pictures that are being replaced.
const forgetPictures = () => {
  fitted.clear();
  histogram.of = null;
  drawn = {};
  for (const tile of strip.tiles) delete tile.drawnAs;
};
const takeAnew = async () => {
  const text = await fetched("data");
  if (text === undefined) return false;
  const parts = new DOMParser().parseFromString(text, "text/html"), next = JSON.parse(parts.getElementById("data").textContent).runs.map((r, i) => new Series(r, i));
  if (!next.every((s, i) => isAlike(s, all[i]))) return loadAnew();
  for (const part of [...parts.scripts]) $(part.id).replaceWith(document.importNode(part, true));
  for (const s of next) for (let i = 0; i < s.heads.length; ++i) await s.load(i);
  next.forEach((s, i) => Object.assign(all[i], s));
  forgetPictures();
  drawWords();
  drawNotes();
  redraw();
  return true;
};
const watchRender = () => {
  if ($("live")) follow(Number($("live").textContent), takeAnew, sayHowFar);
  else if (data.is_under_way) sayHowFar(`So far ${whole(first.run.samples.per_pixel)} samples a pixel, ${duration(first.run.timing.total_seconds)}: written at ${document.lastModified}, when the render had not ended. ` +
    "While it goes on the page can be loaded anew; if it stays as it is, the render was cut off, and neumann render --resume DIR goes on where it kept something.");
};
