// The page of a real study in a real browser.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { expectNames, expectNoSidewaysScroll, neumann, openBrowser } from "./browser.mjs";

const folder = mkdtempSync(path.join(tmpdir(), "neumann-study-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
const scene = path.join(process.env.SCENES, "cornell-box/cornell-box.xml");
process.env.XDG_CACHE_HOME = folder;
neumann("study", scene, "-D", "res=24", "-n", "1", "--methods", "walk,bidirectional,light", "--samples", "4,12", "--repeats", "4", "--reference", "walk",
        "--crop", "3,5,9,7", "-o", folder, "--quiet");
const study = JSON.parse(readFileSync(path.join(folder, "study.json")));
const sum = study.pictures.at(-1);

const browser = await openBrowser();
const page = await browser.open(path.join(folder, "index.html"));
await page.evaluate(() => cropsShown);

// The verdict comes first, and is that of study.json.
assert.equal(await page.textContent("#verdict"), study.verdict);
assert.match(study.verdict, /^In the sum of bounces 0 to 1 /);

// The heat map: the best method of a bounce is 1, others what they reach of it, and ≈ where no difference is seen.
const heat = await page.evaluate(() => [...document.querySelectorAll("#heat tr")].map(tr => [...tr.cells].map(c => c.textContent)));
assert.deepEqual(heat[0], ["method", "bounce 0", "bounce 1", "sum"]);
study.methods.forEach(({ name }, m) => study.pictures.forEach(({ verdict }, q) => {
  const text = heat[m + 1][q + 1], other = verdict.others.find(o => o.method === name);
  if (!other) assert.equal(text, "1");
  else if (other.times_as_fast === null) assert.match(text, other.seen ? /^< / : /^\?$/);
  else {
    assert.equal(text.startsWith("≈ "), !other.seen);
    const shown = Number(text.replace("≈ ", "").replace("·10", "e").replace(/[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]/g, c => "-0123456789"["⁻⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)]));
    assert.ok(Math.abs(shown * other.times_as_fast - 1) < .06, `${text} of ${other.times_as_fast}`);
  }
}));

// Crops: the one that was asked for first, then those that were found; a picture and a map of errors by method, best first.
assert.deepEqual(study.crops.map(c => c.given), [true, false, false, false]);
assert.deepEqual([study.crops[0].x, study.crops[0].y, study.crops[0].width, study.crops[0].height], [3, 5, 9, 7]);
const ranked = sum.methods.map(m => m.method);
const crops = await page.evaluate(() => [...document.querySelectorAll(".crops")].map(row => [...row.querySelectorAll("figure")].map(f => ({
  title: f.querySelector("b").textContent, sizes: [...f.querySelectorAll("canvas")].map(c => [c.width, c.height]), note: f.querySelector(".note")?.textContent }))));
crops.forEach((row, k) => {
  const { width, height, methods } = study.crops[k];
  assert.deepEqual(row.map(f => f.title), ["reference", ...ranked]);
  row.slice(1).forEach(f => {
    assert.deepEqual(f.sizes, [[width, height], [width, height]]);
    const { rmse } = methods.find(m => m.method === f.title);
    assert.ok(f.note.startsWith(`RMSE ${Number(rmse.value.toPrecision(3))} ± `), f.note);
  });
});
// The map has the figure underneath it: √ of its mean square is the RMSE, to what a byte of an error can say (6%, and less in the mean).
const roots = await page.evaluate(async () => Promise.all(study.crops.map(async (crop, k) => (await planesOf(`crop-${k}`, pictures.crops[k])).slice(1).map(({ errors: { term } }) =>
  Math.sqrt(term.codes.reduce((a, c) => a + term.values[c] ** 2, 0) / term.codes.length)))));
roots.forEach((row, k) => row.forEach((root, m) => {
  const { value, standard_error } = study.crops[k].methods[m].rmse;
  // Where an error is below the reference's noise the map has 0, which the mean square does not: by less than its standard error.
  assert.ok(Math.abs(root - value) < .03 * value + standard_error, `${root} and ${value}`);
}));
// The picture of the reference is the reference: a pixel of the crop is that of the whole.
assert.ok(await page.evaluate(async () => {
  const [[whole], [part]] = await Promise.all([planesOf("whole", pictures.whole), planesOf("crop-0", pictures.crops[0])]);
  const { x, y, width } = study.crops[0], a = whole.mean[(y + 2) * pictures.whole.width + x + 1], b = part.mean[2 * width + 1];
  return Math.abs(a - b) <= a / 1024;
}));

// Plots and tables are folded away, and show what study.json says.
assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll("main details, body > details")].map(d => d.open)), [false, false, false, true]);
await page.evaluate(() => document.querySelectorAll("details").forEach(d => { d.open = true; }));
const points = await page.evaluate(() => charts.map(({ picture, chart }) => [String(picture.bounce), chart.data.datasets.filter(d => d.pointRadius).map(d => d.data.map(p => p.y))]));
for (const [bounce, sets] of points) {
  const picture = study.pictures.find(p => String(p.bounce) === bounce);
  sets.forEach((ys, m) => {
    const found = picture.methods.find(q => q.method === study.methods[m].name);
    assert.deepEqual(ys, found.points.map(p => p.rmse.value).filter(v => v > 0));
  });
}
await expectNames(page);

// What is saved: drawings, figures and tables.
const saved = async (name, nth = 0) => {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator(`[aria-label="${name}"]`).nth(nth).click()]);
  return { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
};
await page.waitForTimeout(300);  // for plots that were unfolded to find their size
const svg = await saved("Save the plot: sum of bounces 0 to 1, SVG");
assert.equal(svg.name, "rmse-sum.svg");
for (const { name } of study.methods) assert.ok(svg.text.includes(`>${name}</text>`), name);
assert.equal((svg.text.match(/class="series"/g) ?? []).length, 1 + study.methods.length);
assert.equal(await page.evaluate(text => new DOMParser().parseFromString(text, "image/svg+xml").querySelectorAll("parsererror").length, svg.text), 0);
const csv = await saved("Save the figures: bounce 1, CSV");
assert.equal(csv.text.trim().split("\n").length, 1 + study.pictures[1].methods.flatMap(m => m.points).filter(p => p.rmse.value > 0).length);
const heatSvg = await saved("Save the plot: efficiency by bounce, SVG");
assert.equal((heatSvg.text.match(/<text /g) ?? []).length, 4 * 4 - 1);

// LaTeX: as many cells in each line as columns, rules of booktabs, and no character that LaTeX does not take.
const tex = await saved("Save the table: ranking, sum of bounces 0 to 1, LaTeX");
assert.equal(tex.name, "ranking-sum.tex");
const lines = tex.text.trim().split("\n");
assert.equal(lines[1], "\\begin{tabular}{rlrrrrrrrrr}");
assert.deepEqual([lines[2], lines[4], lines.at(-2), lines.at(-1)], ["\\toprule", "\\midrule", "\\bottomrule", "\\end{tabular}"]);
for (const line of [lines[3], ...lines.slice(5, -2)]) {
  assert.equal(line.split(" & ").length, 11, line);
  assert.ok(line.endsWith(" \\\\"), line);
}
assert.match(tex.text, /^[\x20-\x7e\n]*$/);
assert.equal(await page.evaluate(() => latexText("a_b 5% 1.2·10⁻⁵ ± 3 √x")), "a\\_b 5\\% 1.2$\\cdot$10$^{-5}$ $\\pm$ 3 $\\surd$x");
// A minus is no hyphen.
assert.equal(await page.evaluate(() => latexText("-1.03 ± 0.5, -.5 in x-y of 2-3")), "$-$1.03 $\\pm$ 0.5, $-$.5 in x-y of 2-3");

// PDF: a single page of the drawing's size in points (3/4 of a pixel each), with fonts, and without pictures.
const pdf = await browser.pdf(await page.evaluate(() => printable("sum", drawing(charts.at(-1).chart))));
const [, width, height] = svg.text.match(/width="([\d.]+)" height="([\d.]+)"/).map(Number);
const box = pdf.match(/\/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]/).slice(1).map(Number);
assert.ok(Math.abs(box[0] - .75 * width) < 1 && Math.abs(box[1] - .75 * height) < 1, `${box} of ${[width, height]}`);
assert.equal((pdf.match(/\/Type \/Page\b/g) ?? []).length, 1);
assert.ok(pdf.includes("/FontFile2") && !pdf.includes("/Subtype /Image"));

const phone = await browser.open(path.join(folder, "index.html"), { width: 375, height: 720, scheme: "dark" });
await phone.evaluate(() => cropsShown);
await expectNoSidewaysScroll(phone);
await browser.close();
assert.deepEqual(browser.complaints, []);
console.log("the study's page shows what study.json says, and what it saves is whole");
