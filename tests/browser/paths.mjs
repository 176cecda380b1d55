// The paths of a pixel in the explorer: what is drawn and told is what `neumann replay` tells, and the pixel's history ends with the
// pixel of the EXR files.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { expectNames, expectNoSidewaysScroll, neumann, openBrowser, run } from "./browser.mjs";

const folder = mkdtempSync(path.join(tmpdir(), "neumann-paths-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
const at = name => path.join(folder, name);
const scene = path.join(process.env.SCENES, "cornell-box/cornell-box.xml"), side = 32, last = 3;
neumann("render", scene, "-D", `res=${side}`, "-n", `${last}`, "--spp", "64", "--method", "walk", "-o", at("a"), "--quiet");
neumann("page", at("a"), "--paths", "10,20", "--paths", "5,6", "--files", "page", "--quiet");
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
const pixels = JSON.parse(run(process.env.PYTHON, path.join(here, "pixels.py"), at("a")));
const replayed = sample => JSON.parse(neumann("replay", at("a"), "--pixel", "10,20", "--sample", `${sample}`, "--json"));

const browser = await openBrowser();
const page = await browser.open(at("a/index.html"));
await page.waitForSelector("body[data-ready]");
const settled = p => p.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
const press = async (...keys) => { for (const key of keys) await page.keyboard.press(key); await settled(page); };
const shown = () => page.evaluate(() => state.path);
const lines = (box, more = "") => page.locator(`#${box} line.ink${more}`).count();

// It opens with the first pixel that it was made for, and the sample that brings most.
assert.match(await page.locator("#paths-title").innerText(), /^Paths of pixel 10, 20, 64 samples$/);
assert.match(await page.locator("#readout").innerText(), /Pixel 10, 20/);
const options = await page.locator("#path option").evaluateAll(all => all.map(o => ({ value: o.value, text: o.textContent })));
const parts = options.map(o => Number(o.text.match(/([\d.]+)% of the pixel/)[1]));
assert.equal(await page.locator("#path").inputValue(), options[parts.indexOf(Math.max(...parts))].value);

// Every path has a row and a line from above for each of its rays, and what they bring is what replay tells.
for (const { value } of options) {
  await page.locator("#path").selectOption(value);
  await settled(page);
  const told = replayed(value), rows = await page.locator("#path-table tr").evaluateAll(all => all.slice(1).map(r => [...r.cells].map(c => c.textContent)));
  assert.deepEqual(rows.map(r => r[1]), told.steps.map(s => s.ray));
  rows.forEach((row, k) => assert.equal(row[5].split("; ").filter(Boolean).length, (told.steps[k].brings ?? []).length, `ray ${k + 1} of sample ${value}`));
  assert.equal(await lines("plan", ".ray"), told.steps.length);
  const brings = await page.locator("#path-brings").innerText();
  told.terms.forEach((rgb, i) => {
    const name = i > last ? "rest" : `bounce ${i}`, luminance = .2126 * rgb[0] + .7152 * rgb[1] + .0722 * rgb[2], found = brings.match(new RegExp(`([\\d.]+(?:·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?) in ${name}`));
    assert.equal(!!found, luminance > 0, `${name} in "${brings}"`);
    if (found && !found[1].includes("·")) assert.ok(Math.abs(Number(found[1]) / luminance - 1) < .006, `${found[1]}, expected ${luminance}`);
  });
}

// Over the picture the first vertex lies in the pixel, and ends of rays where the next ones begin.
const marks = await page.evaluate(() => {
  const stage = document.getElementById("stage").getBoundingClientRect(), circle = document.querySelector("#rays circle").getBoundingClientRect(), box = document.getElementById("mark").getBoundingClientRect();
  return { x: circle.x + circle.width / 2 - box.x - box.width / 2, y: circle.y + circle.height / 2 - box.y - box.height / 2, inside: circle.x > stage.x };
});
assert.ok(Math.abs(marks.x) < 1 && Math.abs(marks.y) < 1 && marks.inside, JSON.stringify(marks));
const joins = await page.evaluate(() => {
  const rays = shownPath().rays.filter(r => r.kind === "goes on" && r.film.length), off = [];
  rays.slice(1).forEach((ray, k) => { const [x, y] = rays[k].film.at(-1).slice(2); off.push(Math.hypot(ray.film[0][0] - x, ray.film[0][1] - y)); });
  return off;
});
assert.ok(joins.every(d => d < 1e-2), `ends of rays apart by ${joins}`);
await page.keyboard.press("+");
await settled(page);
assert.ok((await lines("rays")) > 0);

// Keys: the next path and back, without rays that ask, without paths over the picture; the address keeps it.
const before = await page.locator("#path").inputValue();
await press("j");
assert.notEqual(await page.locator("#path").inputValue(), before);
await press("k");
assert.equal(await page.locator("#path").inputValue(), before);
const all = await lines("plan", ".ray");
await press("h");
assert.equal(await lines("plan", ".asks"), 0);
assert.ok(await lines("plan", ".ray") < all);
await press("o");
assert.ok(await page.locator("#rays").isHidden());
await page.waitForFunction(() => /path=\d+&asking=0&paths=0/.test(location.hash));
await press("o", "h");
assert.ok(await page.locator("#rays").isVisible());
await press("l");
assert.ok(await page.locator("#rays").isHidden());
await press("Escape");
assert.equal(await shown(), before);

// The history of each bounce and sum ends with the pixel of the files, and halves of intervals are those of its errors.
for (let i = 0; i <= last; ++i) for (const sum of [false, true]) {
  const { points, errors } = await page.evaluate(([i, sum]) => {
    set({ i, sum });
    draw();
    return { points: historyPlot.data.datasets.map(s => s.all.at(-1)), errors: pixelErrorPlot.data.datasets.length };
  }, [i, sum]);
  const exr = pixels[`${sum ? "sum" : "bounce"}_00${i}.exr`], p = 20 * side + 10;
  ["R", "G", "B"].forEach((channel, c) => {
    assert.equal(points[c].x, 64);
    assert.ok(Math.abs(points[c].y - exr[channel][p]) <= 1e-5 * Math.abs(exr[channel][p]), `${channel} of bounce ${i}: ${points[c].y}, expected ${exr[channel][p]}`);
    const t = 3.18245, error = (exr[`spread.${channel}`] ?? exr[`stderr.${channel}`])[p];  // 4 replicates of 16 samples
    assert.ok(Math.abs((points[c].half ?? 0) - t * error) <= 1e-4 * t * error, `interval of ${channel} of bounce ${i}: ${points[c].half}, expected ${t * error}`);
  });
  assert.ok(errors > 0);
}

// What is saved: a drawing, and a table with a row a ray.
const saved = await page.evaluate(() => ({ drawing: new DOMParser().parseFromString(planText(), "image/svg+xml").documentElement.tagName, csv: csvOf([rayHead, ...shownPath().rays.map(rayCells)]) }));
assert.equal(saved.drawing, "svg");
assert.equal(saved.csv.trim().split("\n").length, replayed(before).steps.length + 1);

// Another pixel of the page, and one that it does not have: the command that is told puts it in.
await page.evaluate(() => set({ pixel: { x: 5, y: 6 } }));
await settled(page);
assert.match(await page.locator("#paths-title").innerText(), /pixel 5, 6/);
await page.evaluate(() => set({ pixel: { x: 7, y: 8 } }));
await settled(page);
assert.ok(await page.locator("#paths-part").isHidden());
const hint = await page.locator("#paths-none").innerText();
assert.match(hint, /It has those of 10,20 and 5,6\.$/);
const [, ...command] = hint.match(/neumann (page) DIR (--paths) (\d+,\d+)/);
neumann(command[0], at("a"), command[1], command[2], "--files", "page", "--quiet");
const again = await browser.open(at("a/index.html"));
await again.waitForSelector("body[data-ready]");
assert.match(await again.locator("#paths-title").innerText(), /pixel 7, 8/);
await expectNames(again);

// On a phone, and in the dark.
for (const scheme of ["light", "dark"]) {
  const narrow = await browser.open(at("a/index.html"), { width: 360, height: 700, scheme });
  await narrow.waitForSelector("body[data-ready]");
  await expectNoSidewaysScroll(narrow);
  const ink = await narrow.evaluate(() => ({ number: getComputedStyle(document.querySelector("#plan .vertex-number")).fill, back: getComputedStyle(document.getElementById("plan")).backgroundColor }));
  assert.notEqual(ink.number, ink.back);
}

// A crop's pixels are named by the film, as replay names them: in titles, in the address, and in the command that is told.
const folderOfScene = path.dirname(scene), [cropX, cropY] = [8, 12];
const crop = Object.entries({ crop_offset_x: cropX, crop_offset_y: cropY, crop_width: 16, crop_height: 10 }).map(([name, value]) => `<integer name="${name}" value="${value}"/>`).join("");
writeFileSync(at("crop.xml"), readFileSync(scene, "utf8").replaceAll('value="meshes/', `value="${folderOfScene}/meshes/`).replace('<film type="hdrfilm">', `<film type="hdrfilm">${crop}`));
neumann("render", at("crop.xml"), "-D", `res=${side}`, "-n", "1", "--spp", "16", "--method", "walk", "-o", at("c"), "--quiet");
neumann("page", at("c"), "--paths", "10,20", "--files", "page", "--quiet");
const cropped = await browser.open(at("c/index.html"));
await cropped.waitForSelector("body[data-ready]");
assert.deepEqual(await cropped.evaluate(() => state.pixel), { x: 10 - 8, y: 20 - 12 });
assert.match(await cropped.locator("#paths-title").innerText(), /^Paths of pixel 10, 20,/);
assert.match(await cropped.locator("#readout").innerText(), /^Pixel 10, 20,/);
assert.equal(await cropped.locator("#pixel-title").innerText(), "Pixel 10, 20: bounces");
await cropped.evaluate(() => set({ pixel: { x: 3, y: 1 }, rect: { x0: 0, y0: 0, x1: 1, y1: 0 } }));
await settled(cropped);
assert.match(await cropped.locator("#paths-none").innerText(), /neumann page DIR --paths 11,13 puts them in/);
assert.match(await cropped.locator("#readout").innerText(), /Mean of the rectangle 8 to 9, 12,/);
await cropped.waitForFunction(() => location.hash.includes("pixel=11,13&rect=8,12,9,12"));
const linked = await browser.open(at("c/index.html"), { hash: "#pixel=9,14&zoom=1.25,16,17" });
await linked.waitForSelector("body[data-ready]");
assert.deepEqual(await linked.evaluate(() => state.pixel), { x: 1, y: 2 });
await linked.waitForFunction(() => location.hash === "#pixel=9,14&zoom=1.25,16,17");

assert.deepEqual(browser.complaints, []);
await browser.close();
console.log("the paths are those that replay tells");
