"use strict";
// The paths of the chosen pixel, over the picture, from above and as a table, and the pixel's mean against its number of samples.

const pathsOf = s => data.runs[s.index].paths;
const pathsOfPixel = () => state.pixel && pathsOf(series())?.pixels.find(({ picture: [x, y] }) =>
  Math.floor(x / first.factor) === state.pixel.x && Math.floor(y / first.factor) === state.pixel.y);
const shownPath = () => {
  const all = pathsOfPixel()?.paths;
  return all && (all.find(p => String(p.sample) === state.path) ?? mostOf(all));
};
const mostOf = paths => paths.reduce((a, b) => (b.part ?? 0) > (a.part ?? 0) ? b : a);
// The rays of a path that are shown: shadow rays (kind "asks") only if the user wants them. `number` is the row of the ray in the
// table.
const shownRays = path => path.rays.map((ray, k) => ({ ...ray, number: k + 1 })).filter(ray => state.asking || ray.kind !== "asks");

const svg = (tag, attributes = {}, text) => {
  const e = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) e.setAttribute(name, value);
  if (text !== undefined) e.textContent = text;
  return e;
};
// A ray as two lines, a wide black one below a coloured one, so that it is visible on dark and on bright pictures. The ends are in
// pixels of the drawing. `hidden`: whether a surface hides this part of the ray from the camera.
const stroke = (ray, [x1, y1, x2, y2], hidden) => {
  const kind = `ray ${ray.of_light ? "of-light" : "of-camera"} ${ray.kind === "asks" ? "asks" : "goes"}${hidden ? " hidden-part" : ""}${ray.kind === "asks" && !ray.found ? " blocked" : ""}`;
  return ["edge", "ink"].map(part => svg("line", { x1, y1, x2, y2, class: `${kind} ${part}`, "data-ray": ray.number }));
};
const numberAt = (ray, x, y) => [svg("circle", { cx: x, cy: y, r: 3, class: "vertex" }), svg("text", { x: x + 5, y: y - 5, class: "vertex-number" }, ray.number)];
const isVertex = ray => ray.kind !== "asks" && ray.found && !ray.leaves;

// Draws the path over the picture, in pixels of the screen, so that lines keep their width at any zoom.
const drawOnPicture = () => {
  const path = state.pathShown && shownPath(), box = $("rays"), side = state.fitScale * state.zoom / first.factor;
  box.toggleAttribute("hidden", !path || !!state.slide);
  if (!path) return;
  const across = x => state.left + x * side, down = y => state.top + y * side, lines = [], marks = [];
  for (const ray of shownRays(path)) {
    for (const [x1, y1, x2, y2, hidden] of ray.film ?? []) lines.push(...stroke(ray, [across(x1), down(y1), across(x2), down(y2)].map(v => Math.max(-1e5, Math.min(1e5, v))), hidden));
    const end = ray.film?.at(-1);
    if (isVertex(ray) && end) marks.push(...numberAt(ray, across(end[2]), down(end[3])));
    // A ray from the camera has no extent in the picture: its vertex is marked in the middle of the pixel.
    if (isVertex(ray) && !ray.film) marks.push(...numberAt(ray, across(pathsOfPixel().picture[0] + .5), down(pathsOfPixel().picture[1] + .5)));
  }
  box.replaceChildren(...lines, ...marks);
};

// The part of the scene that the drawing from above shows: the outline, cut off where it is farther from the path than
// `farFromPath` times the path's extent. The edge of the drawing also cuts off rays that leave the scene, and a camera that is far
// away.
const planWidth = 480, planMargin = 20, farFromPath = 2.5;
const planFrame = (outline, rays) => {
  const ends = rays.filter(ray => ray.above && isVertex(ray)).map(ray => ray.above.slice(2));
  const along = k => {
    const path = ends.map(end => end[k]), all = [...path, ...outline.flatMap(line => [line[k], line[k + 2]])];
    return { path: [Math.min(...path), Math.max(...path)], all: [Math.min(...all), Math.max(...all)] };
  };
  const x = along(0), y = along(1), reach = farFromPath * Math.max(x.path[1] - x.path[0], y.path[1] - y.path[0]);
  const within = ({ path, all }) => reach > 0 ? [Math.max(all[0], path[0] - reach), Math.min(all[1], path[1] + reach)] : all;
  const [left, right] = within(x), [top, bottom] = within(y), size = Math.max(right - left, bottom - top) || 1;
  const width = planWidth, scale = (planWidth - 2 * planMargin) / size, height = Math.max(120, (bottom - top) * scale + 2 * planMargin);
  return { width, height, place: ([x1, y1, x2, y2]) => [width / 2 + (x1 - (left + right) / 2) * scale, height / 2 + (y1 - (top + bottom) / 2) * scale,
                                                         width / 2 + (x2 - (left + right) / 2) * scale, height / 2 + (y2 - (top + bottom) / 2) * scale] };
};
const drawPlan = path => {
  const { outline, seen_along } = pathsOf(series()), rays = shownRays(path), { width, height, place } = planFrame(outline, rays), lines = [], marks = [];
  for (const [x1, y1, x2, y2] of outline.map(place)) lines.push(svg("line", { x1, y1, x2, y2, class: "outline" }));
  for (const ray of rays) {
    if (!ray.above) continue;
    const [x1, y1, x2, y2] = place(ray.above);
    lines.push(...stroke(ray, [x1, y1, x2, y2], false));
    if (isVertex(ray)) marks.push(...numberAt(ray, x2, y2));
    if (ray.kind === "first") marks.push(svg("text", { x: x1 + 5, y: y1 + 12, class: "vertex-number" }, ray.of_light ? "light" : "camera"));
  }
  $("plan").setAttribute("viewBox", `0 0 ${width} ${height}`);
  $("plan").replaceChildren(...lines, ...marks);
  $("plan-note").textContent = `From above, along ${seen_along}; the camera looks upwards in this plan. Paths from the camera are orange, those from a lamp blue; thin lines are shadow rays, dotted where something hides the light. Over the picture what is hidden from the camera is dashed, and what lies behind it is left out.`;
};

// The table of the path, with a row for each ray.
const sizeOf = rgb => rgb.every(Number.isFinite) ? number(luminance(...rgb)) : "not finite";
const shapeName = meets => meets.shape.replace(/^shape /, "").replace(/[^ ]*\//, "");
const bounceName = i => i > series().last ? "rest" : `bounce ${i}`;
const rayCells = (ray, k) => [String(k + 1), ray.ray, ray.meets ? shapeName(ray.meets) : ray.kind === "asks" ? (ray.found ? "nothing in between" : "hidden, or nothing there") : "nothing",
  ray.throughput ? sizeOf(ray.throughput) : ray.power ? sizeOf(ray.power) : "", ray.pdf === undefined ? "" : ray.pdf === "delta" ? "the only direction" : number(ray.pdf),
  (ray.brings ?? []).map(b => `${bounceName(b.bounce)}: ${sizeOf(b.value)}${b.film ? ` at ${number(b.film[0], 4)}, ${number(b.film[1], 4)}` : ""}`).join("; ")];
const rayHead = ["", "ray", "meets", "throughput or power", "pdf / sr⁻¹", "brings"];
const drawPathTable = path => {
  const rows = path.rays.map(rayCells), made = table(rayHead, rows, [1, 2, 5]);
  path.rays.forEach((ray, k) => {
    const row = made.rows[k + 1], mark = on => document.querySelectorAll(`[data-ray="${k + 1}"]`).forEach(line => line.classList.toggle("chosen", on));
    row.onmouseenter = () => mark(true);
    row.onmouseleave = () => mark(false);
  });
  $("path-table").replaceChildren(made);
  const lit = path.terms.map((rgb, i) => [i, rgb]).filter(([, rgb]) => rgb.some(v => v !== 0));
  $("path-brings").textContent = (lit.length ? `To its own pixel this sample brings ${lit.map(([i, rgb]) => `${sizeOf(rgb)} in ${bounceName(i)}`).join(", ")}` : "To its own pixel this sample brings nothing") +
    ` (luminance, ${series().unit}).` + (path.method ? ` Made by ${path.method}.` : "");
};

// The plots of the pixel's mean and of its error after 1, 2, 4, … replicates.
const historyPlot = plot("history", logAxis("samples of the pixel"), radianceOf(first), [intervals(() => true)]);
const pixelErrorPlot = plot("pixel-error", logAxis("samples of the pixel"), "relative standard error", []);
const historySets = (history, i, sum) => ["red", "green", "blue"].map((name, c) => dots(name, history.samples.map((n, k) => {
  const of = history[sum ? "sums" : "terms"][k][i];
  return point(n, of[c], history.interval_factor[k] === null ? undefined : of[3 + c] * history.interval_factor[k]);
}), channelColours()[c], marks[c]));
const pixelErrorSets = (history, s, i, sum) => {
  const of = (kind, q) => history.samples.map((n, k) => {
    const v = history[kind][k][q];
    return { x: n, y: Math.hypot(...v.slice(3)) / Math.hypot(...v.slice(0, 3)) };
  }).filter(positive);
  const sets = history.terms[0].map((_, q) => q).filter(q => sum || q !== i).map(q => line("", of("terms", q).map(p => ({ ...p, label: bounceName(q), shows: { i: q, sum: false } })), color("faint"), behind));
  if (!sum || i > s.last) sets.push(dots(bounceName(i), of("terms", i), style(0).color, "circle"));
  const upTo = sum ? i : s.last;
  sets.push(dots(`sum of bounces 0 to ${upTo}`, of("sums", upTo), color("text"), "rect"));
  return sets.filter(set => set.data.length > 0);
};
const drawHistory = ({ history, why_no_history }) => {
  $("history-part").hidden = !history;
  $("history-note").textContent = history
    ? "The mean of the pixel's first samples, traced again, with 95% intervals from the spread of replicates; after the last one it is the picture's pixel. The picture's own errors also count what so few samples could not show; these intervals do not."
    : `There is no error against samples of this pixel: ${why_no_history}.`;
  if (!history) return;
  const sets = historySets(history, state.i, state.sum), errors = pixelErrorSets(history, series(), state.i, state.sum);
  for (const [chart, all] of [[historyPlot, sets], [pixelErrorPlot, [...errors, ...slopeGuide(errors)]]]) {
    chart.data.datasets = all;
    range(chart.options.scales.x, history.samples);
    fitRange(chart, all);
    chart.update();
  }
  $("history-title").textContent = `The pixel against samples: ${series().title(shown())}`;
};

const drawPaths = () => {
  const pixel = pathsOfPixel(), path = shownPath(), s = series();
  $("paths-part").hidden = !path;
  $("paths-none").hidden = !!path || !state.pixel || all.length > 1;
  if (!path) {
    const given = pathsOf(s)?.pixels.map(p => p.pixel.join(",")) ?? [];
    $("paths-none").textContent = !state.pixel ? "" : `The paths of this pixel are not in the page. neumann page DIR --paths ${pixelsWritten(state.pixel)} puts them in.` +
      (given.length ? ` It has those of ${given.join(" and ")}.` : "");
    return;
  }
  $("paths-title").textContent = `Paths of pixel ${pixel.pixel.join(", ")}` + (pixel.count ? `, ${whole(pixel.count)} samples` : "");
  const options = pixel.paths.map(p => {
    const o = element("option", `sample ${whole(p.sample)}` + (p.part === undefined ? "" : `, ${number(100 * p.part, 2)}% of the pixel`) + `: ${p.why}`);
    o.value = p.sample;
    return o;
  });
  $("path").replaceChildren(...options);
  $("path").value = path.sample;
  $("asking").checked = state.asking;
  $("path-shown").checked = state.pathShown;
  drawPlan(path);
  drawPathTable(path);
  drawHistory(pixel);
};
const stepPath = by => {
  const all = pathsOfPixel()?.paths;
  if (all) set({ path: String(all[(all.indexOf(shownPath()) + by + all.length) % all.length].sample) });
};
const planText = () => {
  const { width, height } = $("plan").viewBox.baseVal, onWhite = $("plan").cloneNode(true);
  Object.entries({ xmlns: "http://www.w3.org/2000/svg", width, height }).forEach(([name, value]) => onWhite.setAttribute(name, value));
  onWhite.prepend(svg("style", {}, ".outline{stroke:#8a8a8a;stroke-width:.7}.ray{stroke-width:2}.asks{stroke-width:.8}.blocked{stroke-dasharray:1 3}.edge{display:none}.of-camera.ink{stroke:#b36b00}.of-light.ink{stroke:#0072b2}text{font:12px sans-serif}"),
                  svg("rect", { width: "100%", height: "100%", fill: "#ffffff" }));
  return onWhite.outerHTML;
};
// A page that holds paths first shows the first pixel that has some.
{
  const given = pathsOf(first)?.pixels[0];
  if (given) state.pixel = { x: Math.floor(given.picture[0] / first.factor), y: Math.floor(given.picture[1] / first.factor) };
}
$("path").onchange = e => set({ path: e.target.value });
$("path-previous").onclick = () => stepPath(-1);
$("path-next").onclick = () => stepPath(1);
$("asking").onchange = e => set({ asking: e.target.checked });
$("path-shown").onchange = e => set({ pathShown: e.target.checked });
