"use strict";
// The page of `neumann blame`: the contents of blame.json, and the pictures of every term.
const data = JSON.parse($("data").textContent), { packed } = data;
const unit = "W·m⁻²·sr⁻¹", widest = 6;  // z at the ends of the colour scale of z-maps
const pixels = packed.width * packed.height;
const titleOf = t => t.first === t.last ? `bounce ${t.first}` : `bounces ${t.first} ${t.last === t.first + 1 ? "and" : "to"} ${t.last}`;
const mean3 = v => (v[0] + v[1] + v[2]) / 3;
const placeColor = i => ["#e69f00", "#56b4e9", "#cc79a7"][i % 3];

// The verdict, and the figures that it rests on.
document.title = $("title").textContent = `${data.scene.split("/").pop()}: another renderer's pictures against our terms`;
data.sentences.forEach(s => $("verdict").append(element("p", s)));
facts("facts", [
  ["their pictures", [...data.pictures, ...(data.again.length ? ["with another seed:", ...data.again] : [])].join(" ")],
  ["depths counted as", data.counting],
  ["our terms", `${whole(data.samples)} samples a pixel, seed ${data.seed}, ${packed.full_width} × ${packed.full_height} pixels`],
  ...(data.command ? [["command", element("code", data.command)]] : []),
  ["program", `neumann ${data.version}`]]);
const chance = p => p === null ? "–" : p < 1e-300 ? "0" : number(p, 2);
$("terms").append(table(["", "theirs / ours", "95% interval", "by chance", "largest block, in standard errors", ""], data.terms.map(t => [
  titleOf(t), t.ratio === null ? "–" : t.ratio.toFixed(4), t.ratio === null ? "" : `± ${number(1.96 * t.ratio_stderr, 2)}`, chance(t.p),
  t.worst.length ? number(t.worst[0].z, 2) : "", t.differs ? element("b", "differs") : t.unclear ? "unclear" : "agrees"]), [5]));
$("terms-note").textContent = `By chance: the probability that pictures of the same light differ so much. A bounce differs below ${number(data.terms[0].threshold, 2)} ` +
  "if a mistake explains it, or their pixels do not share random numbers; otherwise it is unclear. In bounces 0 and 1 few pixels, whose light is sure, may tell it, too.";
$("suspected").hidden = !data.suspects.length;
if (data.suspects.length) $("suspects").append(table(["", "if"], data.suspects.slice(0, 8).map(s => [
  s.misfit === null || data.suspects[0].misfit === null ? "–" : Math.round(s.misfit - data.suspects[0].misfit).toString(), s.words]), [1]));
$("pictures-note").textContent = "Differences are theirs less ours, in luminance: red where theirs are brighter, blue where they are darker. " +
  `In the last picture of a row they are in standard errors of a pixel; full colour is ${widest}.` +
  (packed.factor > 1 ? ` Each pixel here is the mean of ${packed.factor} × ${packed.factor}.` : "");

const draw = (canvas, at) => fill(canvas, packed.width, packed.height, at);
const of = (planes, p) => luminance(planes[p], planes[p + pixels], planes[p + 2 * pixels]);
const whitest = planes => {
  const lit = Float32Array.from({ length: pixels }, (_, p) => of(planes, p)).filter(v => v > 0 && v < Infinity).sort();
  return lit.length ? lit[Math.floor(.99 * (lit.length - 1))] : 1;
};
const inColours = (planes, white) => p => {
  const byte = c => Math.round(255 * srgb(Math.min(1, Math.max(0, planes[p + c * pixels] / white))));
  return Number.isFinite(of(planes, p)) ? (0xff000000 | byte(2) << 16 | byte(1) << 8 | byte(0)) >>> 0 : notFinite;
};
const svg = (tag, attributes) => {
  const e = document.createElementNS("http://www.w3.org/2000/svg", tag);
  Object.entries(attributes).forEach(([name, value]) => e.setAttribute(name, value));
  return e;
};
const twice = (tag, attributes, color) => [svg(tag, { ...attributes, class: "halo" }), svg(tag, { ...attributes, stroke: color, "stroke-width": 2 })];
// A drawing that lies over a picture of the term: frames around the blocks that differ most and, if `withPaths`, a path of ours
// through each. Segments without an image on the film are left out. The last segment, which leads to a lamp, is dashed.
const overlay = (term, withPaths) => {
  const sheet = svg("svg", { viewBox: `0 0 ${packed.full_width} ${packed.full_height}`, preserveAspectRatio: "none", "aria-hidden": "true" });
  term.worst.forEach((place, i) => {
    const { x, y, width, height, path } = place;
    sheet.append(...twice("rect", { x, y, width, height }, placeColor(i)));
    if (!withPaths) return;
    path.vertices.slice(1).forEach((v, k) => {
      const from = path.vertices[k].film, to = v.film;
      if (!from || !to) return;
      const last = k + 2 === path.vertices.length, [halo, line] = twice("line", { x1: from[0], y1: from[1], x2: to[0], y2: to[1] }, placeColor(i));
      if (last) line.setAttribute("class", "ends");
      sheet.append(halo, line);
    });
  });
  return sheet;
};
const figure = (title, at, sheet, note, scale) => {
  const f = element("figure"), frame = element("div", undefined, "frame"), canvas = element("canvas"), caption = element("figcaption");
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", title);
  draw(canvas, at);
  frame.append(canvas, sheet);
  if (scale) {
    const holder = element("div", undefined, "scale"), ramp = element("canvas"), ticks = element("div", undefined, "ticks");
    ramp.width = 256;
    ramp.height = 1;
    const colours = new ImageData(256, 1);
    new Uint32Array(colours.data.buffer).set(scale.ramp);
    ramp.getContext("2d").putImageData(colours, 0, 0);
    [scale.low, 0, scale.high].forEach(v => ticks.append(element("span", number(v, 2))));
    holder.append(ramp, ticks);
    caption.append(holder);
  }
  caption.append(element("b", title), " ", element("span", note, "note"));
  f.append(frame, caption);
  return f;
};
const rgb = v => v.map(x => number(x)).join(", ");
const listed = term => {
  const list = element("ol", undefined, "places");
  term.worst.forEach((place, i) => {
    const { x, y, width, height, path } = place, li = element("li"), mark = element("b", `${x}, ${y} to ${x + width - 1}, ${y + height - 1}`);
    mark.style.borderColor = placeColor(i);
    const brings = path.blocked ? "nothing: the light is hidden" : path.value.every(v => v === 0) ? "nothing" : `${rgb(path.value)} ${unit}`;
    li.append(mark, ` theirs ${rgb(place.theirs)}, ours ${rgb(place.ours)}, ${number(place.z, 2)} standard errors apart. `,
              `Our path in pixel ${place.pixel[0]}, ${place.pixel[1]}, sample ${path.sample}, brings ${brings}: `, element("span", path.text, "dim"));
    list.append(li);
  });
  return list;
};
const shownTerms = [];
const show = async (term, i) => {
  const load = k => decoded($(`picture-${3 * i + k}`).textContent, packed.heads[3 * i + k], pixels);
  const [theirs, ours, difference] = (await Promise.all([load(0), load(1), load(2)]));
  const errors = difference.errors.term, error = p => errors.values[errors.codes[p]];
  const value = p => of(difference.mean, p);
  // The channels of a pixel come from the same samples: their errors are taken as fully correlated.
  const z = p => { const v = value(p); return v === 0 ? 0 : v / luminance(error(p), error(p + pixels), error(p + 2 * pixels)); };
  const most = largestOfMost(pixels, value), white = whitest(ours.mean) || 1;
  const byValue = scaled(signed, -(most || 1), most || 1, false, value), byError = scaled(signed, -widest, widest, false, z);
  const section = element("section"), row = element("div", undefined, "pictures"), readout = element("div", undefined, "readout note");
  const title = titleOf(term), whiteIs = `white is ${number(white)} ${unit}`;
  row.append(
    figure(`theirs, ${title}`, inColours(theirs.mean, white), overlay(term, false), whiteIs),
    figure(`ours, ${title}`, inColours(ours.mean, white), overlay(term, true), whiteIs + (term.worst.length ? "; with a path of ours at each frame" : "")),
    figure("difference", byValue.at, overlay(term, false), most ? `full colour is ${number(most, 2)} ${unit}; 95% of the pixels are within` : "none in any pixel", byValue),
    figure("difference / standard error", byError.at, overlay(term, false), `full colour is ${widest}`, byError));
  const pointAt = "Point at a picture to see its values.";
  readout.textContent = pointAt;
  row.onpointermove = event => {
    const canvas = event.target.closest(".frame")?.querySelector("canvas");
    if (!canvas) { readout.textContent = pointAt; return; }
    const box = canvas.getBoundingClientRect(), x = Math.floor((event.clientX - box.left) / box.width * packed.width), y = Math.floor((event.clientY - box.top) / box.height * packed.height);
    if (x < 0 || y < 0 || x >= packed.width || y >= packed.height) return;
    const p = y * packed.width + x, at = planes => rgb([0, 1, 2].map(c => planes[p + c * pixels]));
    readout.textContent = `${x * packed.factor}, ${y * packed.factor}: theirs ${at(theirs.mean)}; ours ${at(ours.mean)}; difference ${number(value(p))}, ${number(z(p), 2)} standard errors`;
  };
  section.append(element("h3", `${title[0].toUpperCase()}${title.slice(1)} ${(word => term.first === term.last ? word[0] : word[1])(term.differs ? ["differs", "differ"] : term.unclear ? ["is unclear", "are unclear"] : ["agrees", "agree"])}`), row, readout);
  if (term.worst.length) section.append(listed(term));
  shownTerms[i] = { theirs, ours, difference, value, z, error, most };
  return section;
};
Promise.all(data.terms.map(show)).then(sections => {
  $("pictures").append(...sections);
  document.body.dataset.ready = "";
});
