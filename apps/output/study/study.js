"use strict";
// The verdict of the study, its warnings, and the facts about it.

const study = JSON.parse($("study").textContent);
const megabytes = b => b > 0 ? number(b / 1e6) + " MB" : "–";
// The texts of a table on the page, row by row, for saving.
const rowsOf = shown => [...shown.rows].map(row => [...row.cells].map(c => c.textContent));
const savesOf = (shown, name, what, textual) => {
  const line = element("div", undefined, "line saves");
  line.append(...savingTable(name, what, rowsOf(shown), textual));
  return line;
};
const pictureTitle = p => p.bounce === "sum" ? `sum of bounces 0 to ${study.bounces}` : p.bounce.includes("-") ? `bounces ${p.bounce.replace("-", " to ")} together` : `bounce ${p.bounce}`;

const sceneName = study.scene.file.split("/").pop();
document.title = $("title").textContent = `${sceneName}: error against time`;
$("verdict").textContent = study.verdict;
if (!study.complete) $("warnings").append(element("p", "This study was cut off: it shows the repeats that were finished. --resume goes on with it.", "warning"));
// More than three warnings are folded, so that the verdict stays in sight.
const warnings = study.warnings.map(w => element("p", w, "warning"));
if (warnings.length > 3) {
  const all = element("details");
  all.append(element("summary", `${warnings.length} warnings`), ...warnings);
  $("warnings").append(all);
} else $("warnings").append(...warnings);
const definitions = Object.entries(study.scene.definitions).map(([k, v]) => `${k}=${v}`).join(", ");
facts("facts", [
  ["scene", `${study.scene.file}${definitions ? ` with ${definitions}` : ""}, ${study.picture.width} × ${study.picture.height} pixels, hash ${study.scene.hash}`],
  ["bounces", `0 to ${study.bounces}, and their sum${study.verdict_on === "sum" ? "" : `; the verdict is on ${study.verdict_on.replace("-", " to ")} together, whose MSE is the mean of theirs`}`],
  ["repeats", `${study.repeats} of each method at each budget${study.interval ? `, for an interval of ± ${number(100 * study.interval)}% of the sum's RMSE` : ""}, seed ${study.seed}, ${study.threads} threads`],
  ["reference", study.reference.description + (study.reference.exact ? "" : study.reference.from_cache ? "; from the cache" :
     study.reference.seconds > 0 ? `; made in ${number(study.reference.seconds)} s` : "") +
     (study.reference.choice ? `. Chosen: ${study.reference.choice}` : "")],
  ["truncation", study.truncation.rest_mean === undefined ? study.truncation.note :
     `bounces beyond ${study.bounces} have a mean of ${number(study.truncation.rest_mean)} ± ${number(study.truncation.interval95, 2)}, ` +
     `${number(100 * study.truncation.fraction_of_whole, 2)}% of the whole; not part of any error here`],
  ["set-up for all", `scene and search structures ${number(study.setup.scene_seconds)} s, pilot walks ${number(study.setup.pilot_seconds)} s`],
  ["command", element("code", study.command)],
  ["program", `neumann ${study.program.version}, ${study.program.ray_caster}`]]);
facts("definitions", Object.entries(study.definitions).map(([k, v]) => [k.replaceAll("_", " "), v]));
const sumMethods = study.pictures.find(p => p.bounce === "sum").methods;
const sumOf = name => sumMethods.find(m => m.method === name);
