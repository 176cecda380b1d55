"use strict";
// Texts and tables about the runs.
const sceneOf = s => s.run.scene.file.split("/").pop();
const summary = s => `bounces 0 to ${s.last} by ${s.run.options.method}, ${whole(s.run.samples.per_pixel)} samples a pixel in ${number(s.run.timing.sampling_seconds)} s, ${number(s.run.timing.total_seconds)} s in all`;
// generic() makes a text or nested tables of any JSON; an object { mean, stderr, … } becomes one number with its interval.
const isMean = v => v !== null && typeof v === "object" && "mean" in v && Object.keys(v).every(k => ["mean", "stderr", "degrees_of_freedom", "interval95", "unmet", "rare_large_samples"].includes(k));
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
// A section that is folded until the user opens it.
const folded = (title, ...parts) => {
  const fold = element("details");
  fold.append(element("summary", title), ...parts);
  return fold;
};
const wide = t => { const w = element("div", undefined, "wide"); w.append(t); return w; };
const bouncesTable = s => {
  const b = s.run.bounces, rest = s.run.rest, row = (name, x) => [name, number(x.mean), typeof x.interval95 === "string" ? "none: infinite variance" : (x.unmet && x.interval95 !== null ? "< " : "") + number(x.interval95, 2) + (x.rare_large_samples ? " at least" : ""),
    x.ratio_estimate === undefined ? "" : number(x.ratio_estimate), x.tail_bound === undefined ? "" : x.tail_bound === null ? "none" : number(x.tail_bound),
    x.rays === undefined ? "" : whole(x.rays), ...(discretised ? [x.discretisation ? number(x.discretisation.mean, 2) : ""] : []),
    ...(subset ? [x.missing ? number(x.missing.mean) : ""] : [])];
  const discretised = b.some(x => x.discretisation), subset = b.some(x => x.missing);
  return wide(table(["bounce", `mean / ${s.unit}`, "± (95%)", "ratio", "bound on what follows", "rays", ...(discretised ? ["discretisation"] : []), ...(subset ? ["missing"] : [])],
    [...b.map((x, i) => row(i, x)), row("sum", s.run.sum), ...(rest.mean === undefined ? [] : [row("rest", { ...rest, ratio_estimate: undefined })])], []));
};
const bouncesNote = s => {
  const b = s.run.bounces;
  return "± is half of the 95% interval of the mean; ratio is the mean over that of the bounce before; the bound is on all bounces that follow." +
    (b.some(x => x.unmet && x.interval95 !== null) ? " < x: no sample met any light, and x bounds what there may be." : "") +
    (b.some(x => x.rare_large_samples) ? " At least: large samples are so rare that the interval may be too short." : "") +
    (b.some(x => x.discretisation) ? " Discretisation is the error, as a mean, that patches, photons or records leave however many samples there are." : "") +
    (b.some(x => x.missing) ? " Missing is the mean of the paths that this method does not make." : "");
};
// Tables of the plan: the parts that were left out and what that saves, and the parts that were kept. Parts whose omission saves
// nothing are named in a sentence.
const planTable = plan => {
  const leftOut = plan.filter(p => !p.kept), kept = plan.filter(p => p.kept), saving = leftOut.filter(p => !p.saves.startsWith("nothing"));
  const parts = saving.length ? [generic(saving.map(({ part, reason, saves }) => ({ "left out": part, reason, saves })))] : [];
  const idle = leftOut.filter(p => !saving.includes(p));
  for (const nothing of new Set(idle.map(p => p.saves)))
    parts.push(element("p", `Left out as well, which saves ${nothing}: ${idle.filter(p => p.saves === nothing).map(p => p.part).join(", ")}.`));
  return [...parts, generic(kept.map(({ part, reason }) => ({ kept: part, reason })))];
};
// A picture of the weights of a method of a mixture in one bounce, with a pixel for each block. `digits`: a digit for each block, 9
// for a weight of 1.
const weightMap = (digits, [width, height], bounce) => {
  const figure = element("figure"), canvas = element("canvas");
  Object.assign(canvas, { width, height });
  const pixels = new ImageData(width, height);
  [...digits].forEach((digit, i) => pixels.data.set([...Array(3).fill(Math.round(digit * 255 / 9)), 255], 4 * i));
  canvas.getContext("2d").putImageData(pixels, 0, 0);
  figure.append(canvas, element("figcaption", bounce === 0 ? "Le" : `K${bounce > 1 ? superscript(bounce) : ""} Le`));
  return figure;
};
const mixtureMaps = ({ blocks, methods }) => [element("p", "The weight of each method in each block of the picture and each bounce: black 0, white 1."),
  ...methods.flatMap(m => {
    const row = element("div", "", "weights");
    row.append(...m.weights_of_bounces.map((digits, bounce) => weightMap(digits, blocks, bounce)));
    return [element("p", `${m.method}, ${number(100 * m.part_of_work, 2)}% of the work`), row];
  })];
// What health looked at, in words and tables; parts that are not known here as they are.
const balanceParts = ([kind, { unit, paths, replicates, confidence_of_all_bounces, begun, left_the_scene_at_once, bounces }]) => {
  const of = v => v ? flatText(v) : "";
  return [element("p", `The balance of energy ${words(kind)}, in ${unit}, by ${paths ? `${whole(paths)} paths` : `${whole(replicates)} replicates`}: what arrives at a bounce is absorbed, leaves the scene or goes on. ` +
      `${of(begun)} begins, ${of(left_the_scene_at_once)} leaves the scene at once. It is a complaint where chance makes such an imbalance in any bounce with a probability of at most ${number(1 - confidence_of_all_bounces, 1)}.`),
    wide(table(["bounce", "arrives", "is absorbed", "leaves the scene", "goes on", "imbalance", ""],
      bounces.map(b => [String(b.bounce), of(b.arrived), of(b.absorbed), of(b.left_the_scene), of(b.went_on), of(b.imbalance), b.sick ? "complaint" : ""]), [6]))];
};
const healthParts = ({ sick, samples = [], non_finite_samples: odd, largest_samples: largest, self_hits: hits, energy_balance: balance, ...others }) => {
  const parts = [], sampleOf = number => samples.find(s => s.number === number), say = text => parts.push(element("p", text));
  if (odd) {
    const overflowed = odd.pixels_overflowed.reduce((a, b) => a + b, 0);
    say((odd.count ? `${whole(odd.count)} samples are not finite numbers` : "All samples are finite numbers") + (overflowed ? `, and ${whole(overflowed)} means of pixels are not.` : "."));
  }
  if (largest?.length) {
    say("The sample of each bounce with the largest share of its pixel; fireflies are those of its 1000 largest samples that make more than half of their pixel, and much of the picture's light.");
    parts.push(wide(table(["bounce", "value", "of its pixel", "of its pixel's sum", "fireflies", "pixel", "sample", ""], largest.map(l => {
      const s = sampleOf(l.number), percent = part => `${number(100 * part, 2)}%`;
      return [String(l.bounce), number(l.value), percent(l.share_of_pixel), percent(l.share_of_pixel_in_sum), whole(l.fireflies), s?.pixel.join(", ") ?? "", s ? whole(s.sample) : "", l.try ? `try ${l.try.join(", ")}` : ""];
    }), [7])));
  }
  const rest = samples.filter(s => !largest?.some(l => l.number === s.number));
  if (rest.length) parts.push(generic(rest));
  if (hits) say(`Of ${whole(hits.rays)} rays of ${whole(hits.paths)} paths ${hits.count ? whole(hits.count) : "none"} hit the surface that they leave: with 95% confidence at most ${number(100 * hits.part_of_rays_at_most_95, 2)}% of all rays do.`);
  if (typeof balance === "string") say(`The balance of energy was not looked at: ${balance.replace(/^none: /, "")}.`);
  else if (balance) parts.push(...Object.entries(balance).flatMap(balanceParts));
  if (Object.keys(others).length) parts.push(generic(others));
  return parts;
};
const drawTitle = () => {
  document.title = $("title").textContent = [...new Set(all.map(sceneOf))].join(" and ") + (all.length > 1 ? ": " + all.map((_, r) => letter(r)).join(", ").replace(/, (.)$/, " and $1") : "");
  $("subtitle").textContent = all.map(s => runName(s) + summary(s)).join("; ");
};
// Explains in three sentences what the page shows.
const drawAbout = () => {
  const [all, source, K, what, senders] = first.importance ? ["W", "We", "K*", "importance", "cameras"] : ["L", "Le", "K", "light", "lamps"];
  $("about").textContent = `${what[0].toUpperCase()}${what.slice(1)} is what ${senders} send out and what surfaces reflect of it, ${all} = ${source} + ${K} ${all}, and so ${all} = ${source} + ${K} ${source} + ${K}² ${source} + …: here each term is a picture. ` +
    `${K}ⁱ ${source}, bounce i, is ${what} that was reflected i times on its way; the sum up to it holds bounces 0 to i, and the rest all that come after the last one. ` +
    "What can be done here: ";
  const keys = button("all keys", "All keys", () => $("help").showModal());
  keys.className = "link";
  $("about").append(keys);
};
const drawWarnings = () => {
  const lenient = all.filter(s => s.run.scene.replaced);
  $("lenient").hidden = lenient.length === 0;
  const warnings = [
    ...all.flatMap(s => (s.run.health?.complaints ?? []).map(c => `${runName(s)}something is wrong: ${c}`)),
    ...lenient.map(s => `${runName(s)}this is not the scene as it is written: it was read with --lenient, and ${whole(s.run.scene.replaced.length)} thing${s.run.scene.replaced.length > 1 ? "s" : ""} in it ${s.run.scene.replaced.length > 1 ? "are" : "is"} replaced or left out`),
    ...all.flatMap(s => s.run.warnings.map(w => runName(s) + w.text + (w.count > 1 ? ` (${w.count} times)` : "")))
  ].map(text => element("p", text, "warning"));
  // At most two warnings are open, so that there is room for the picture.
  $("warnings").replaceChildren(...warnings.slice(0, 2), ...(warnings.length > 2 ? [folded(`${warnings.length - 2} more warning${warnings.length > 3 ? "s" : ""}`, ...warnings.slice(2))] : []));
};
const drawComparison = () => {
  const flip = data.comparison.pictures.some(p => p.flip !== undefined);
  section("A against B, the reference", wide(table(["", "RMSE", ...(flip ? ["FLIP"] : []), "by noise", "relMSE", "MAPE", "SMAPE", "max |A−B|", "mean of A − B", "95% interval"],
    data.comparison.pictures.map(p => [p.name, ...["rmse", ...(flip ? ["flip"] : []), "rmse_by_noise", "rel_mse", "mape", "smape", "max_error", "mean_difference"].map(k => number(p[k])),
      p.interval ? `${number(p.interval[0])} to ${number(p.interval[1])}` : "unknown"]), [])),
    element("p", `Over pixels and channels, as fractions; ε = ${data.comparison.epsilon}.` +
      (data.comparison.pictures.some(p => p.interval_is_upper_bound) ? " Where the errors of pixels depend on each other and a file does not hold the error of its mean, intervals are upper bounds." : ""), "note"));
};
const drawRun = s => {
  const tag = all.length > 1 ? ` of ${letter(s.index)}` : "", run = s.run, what = { command: run.command, ...run }, parts = [];
  section(`The bounces${tag}`, bouncesTable(s), element("p", bouncesNote(s), "note"));
  if (run.choice) {
    parts.push(element("p", `By ${run.choice.method}: ${run.choice.why}.`));
    if (run.choice.pilot) parts.push(folded("The pilot that chose the method", generic(run.choice.pilot)));
  }
  if (run.samples.mixture) {
    const { mixture, ...samples } = run.samples;
    parts.push(folded(`What is mixed: ${mixture.methods.map(m => m.method).join(", ")}`, ...mixtureMaps(mixture)));
    what.samples = samples;
  }
  if (Array.isArray(run.plan)) {
    const kept = run.plan.filter(p => p.kept).length;
    parts.push(folded(`The plan: ${run.plan.length - kept} parts of the program left out, ${kept} kept`, ...planTable(run.plan)));
    delete what.plan;
  }
  if (run.health) {
    const { complaints = [], ...looked } = run.health;
    parts.push(folded(`Health: ${complaints.length ? `${complaints.length} complaint${complaints.length > 1 ? "s" : ""}, listed at the top of the page` : "nothing wrong was found"}`, ...healthParts(looked)));
  }
  for (const part of ["choice", "health", "bounces", "warnings", "ways"]) delete what[part];
  section(`The run${tag}`, ...parts, folded("All facts of run.json", generic(what)));
};
// Writes all texts and tables. Sections that the user has opened stay open.
const drawWords = () => {
  const nameOf = fold => fold.firstChild.textContent.split(":")[0], folds = () => [...document.querySelectorAll("#warnings details, #tables details")];
  const open = new Set(folds().filter(fold => fold.open).map(nameOf));
  drawTitle();
  drawAbout();
  drawWarnings();
  $("tables").replaceChildren();
  if (data.comparison) drawComparison();
  all.forEach(drawRun);
  section("How exact this page is", element("p", "Pictures are held here as half floats: values are right to 0.05% (three digits) or to 1/16 of their standard error, standard errors to 6%. " +
    (first.factor > 1 ? `Each pixel is the mean of ${first.factor} × ${first.factor}. ` : "") + "All digits are in the EXR files beside it."));
  for (const fold of folds()) fold.open = open.has(nameOf(fold));
};
