// The page of `neumann blame` in a real browser: its pictures are those of the EXR files, and its verdict that of blame.json.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { expectNames, expectNoSidewaysScroll, neumann, openBrowser, run } from "./browser.mjs";

const folder = mkdtempSync(path.join(tmpdir(), "neumann-blame-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
const at = name => path.join(folder, name);
// Pictures of bounces, of which bounce 1 is half as bright again and bounce 2 half as bright.
const scene = path.join(process.env.SCENES, "mitsuba-cornell/mitsuba-cornell.xml"), side = 32;
neumann("render", scene, "-D", `res=${side}`, "-n", "2", "--method", "walk", "--spp", "64", "--seed", "3", "--files", "pictures", "--quiet", "-o", at("theirs"));
const changed = `
import OpenImageIO as oiio, sys
for i in range(3):
    file = oiio.ImageInput.open(f"{sys.argv[1]}/bounce_00{i}.exr")
    values = file.read_image("float")[:, :, :3] * (1.0 if i == 0 else 1.5 if i == 1 else 0.5)
    out = oiio.ImageOutput.create(f"{sys.argv[1]}_{i}.exr")
    out.open(f"{sys.argv[1]}_{i}.exr", oiio.ImageSpec(values.shape[1], values.shape[0], 3, "float"))
    out.write_image(values)
    out.close()
`;
run(process.env.PYTHON, "-c", changed, at("theirs"));
const pictures = [0, 1, 2].map(i => at(`theirs_${i}.exr`));
neumann("blame", ...pictures, scene, "--counts", "bounces", "--spp", "256", "-o", at("out"));
const json = JSON.parse(readFileSync(at("out/blame.json")));
const exr = JSON.parse(run(process.env.PYTHON, path.join(path.dirname(new URL(import.meta.url).pathname), "pixels.py"), at("out")));
assert.deepEqual(json.terms.map(t => t.differs), [false, true, true]);

const browser = await openBrowser();
const page = await browser.open(at("out/index.html"));
await page.waitForSelector("body[data-ready]");
assert.deepEqual(await page.locator("#verdict p").allTextContents(), json.sentences);
const rows = await page.locator("#terms tr").allInnerTexts();
assert.equal(rows.length, 4);
json.terms.forEach((t, i) => assert.equal(rows[i + 1].split("\t")[1], t.ratio.toFixed(4)));
assert.equal((await page.locator("#suspects tr").count()) - 1, Math.min(8, json.suspects.length));
await expectNames(page);
await expectNoSidewaysScroll(page);

// Every value: means as half floats (2⁻¹¹) without what is a 16th of their errors, errors to 6%.
const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
const shown = await page.evaluate(() => shownTerms.map(({ value, z, most }) => ({
  values: Array.from({ length: pixels }, (_, p) => value(p)), zs: Array.from({ length: pixels }, (_, p) => z(p)), most })));
for (let i = 0; i < 3; ++i) {
  const { values, zs, most } = shown[i], file = exr[`difference_00${i}.exr`], of = prefix => p => luminance(...["R", "G", "B"].map(c => file[prefix + c][p]));
  const mean = of(""), error = of("stderr."), largest = Math.max(...["R", "G", "B"].flatMap(c => file[c].map(Math.abs)));
  for (let p = 0; p < side * side; ++p) {
    const parts = Math.max(...["R", "G", "B"].map(c => Math.abs(file[c][p]))), off = 2 ** -11 * parts + 2 ** -24 * largest + error(p) / 16;
    assert.ok(Math.abs(values[p] - mean(p)) <= off, `difference ${i}, ${p}: ${values[p]}, expected ${mean(p)}`);
    const z = mean(p) / error(p);
    assert.ok(Math.abs(zs[p] - z) <= 0.06 * Math.abs(z) + off / error(p), `z ${i}, ${p}: ${zs[p]}, expected ${z}`);
  }
  // What full colour means holds for 95% of the pixels that differ, and it is told.
  const sizes = values.map(Math.abs).filter(v => v > 0).sort((a, b) => a - b);
  if (sizes.length) {
    assert.ok(Math.abs(most - sizes[Math.floor(.95 * (sizes.length - 1))]) <= 1e-6 * most);
    const caption = await page.locator("#pictures section").nth(i).locator("figcaption").nth(2).innerText();
    const told = await page.evaluate(m => number(m, 2), most);
    assert.ok(caption.includes(`full colour is ${told} W`), caption);
  }
}
// Colours: red where theirs are brighter, blue where they are darker, and the ends of the scale beyond it.
const colourAt = (i, figure, p) => page.evaluate(([i, figure, p, side]) =>
  [...document.querySelectorAll("#pictures section")[i].querySelectorAll(".frame canvas")[figure].getContext("2d").getImageData(p % side, p / side | 0, 1, 1).data], [i, figure, p, side]);
const brightest = shown[1].values.indexOf(Math.max(...shown[1].values)), darkest = shown[2].values.indexOf(Math.min(...shown[2].values));
assert.deepEqual(await colourAt(1, 2, brightest), [0xff, 0xc2, 0xa6, 255]);
assert.deepEqual(await colourAt(2, 2, darkest), [0xa6, 0xd4, 0xff, 255]);
assert.deepEqual(await colourAt(1, 3, shown[1].zs.findIndex(z => z > 6)), [0xff, 0xc2, 0xa6, 255]);

// The worst places are framed in all four pictures, and our path is drawn where the camera sees it.
for (let i = 0; i < 3; ++i) {
  const section = page.locator("#pictures section").nth(i), { worst } = json.terms[i];
  assert.equal(await section.locator(".places li").count(), worst.length);
  assert.equal(worst.length, i === 0 ? 0 : 3);
  for (let f = 0; f < 4; ++f) {
    const frames = await section.locator(".frame").nth(f).locator("rect:not(.halo)").evaluateAll(all => all.map(r => ["x", "y", "width", "height"].map(a => +r.getAttribute(a))));
    assert.deepEqual(frames, worst.map(w => [w.x, w.y, w.width, w.height]));
  }
  const lines = await section.locator(".frame").nth(1).locator("line:not(.halo)").evaluateAll(all => all.map(l => ["x1", "y1", "x2", "y2"].map(a => +l.getAttribute(a))));
  assert.deepEqual(lines, worst.flatMap(w => w.path.vertices.slice(1).map((v, k) => [w.path.vertices[k].film, v.film]).filter(([a, b]) => a && b).map(([a, b]) => [...a, ...b])));
  for (const [k, w] of worst.entries()) assert.ok((await section.locator(".places li").nth(k).innerText()).endsWith(w.path.text));
}
// Values under the pointer.
const canvas = page.locator("#pictures section").nth(1).locator(".frame").nth(1);
await canvas.scrollIntoViewIfNeeded();
const box = await canvas.boundingBox();
await page.mouse.move(box.x + (5.5 / side) * box.width, box.y + (9.5 / side) * box.height);
assert.match(await page.locator("#pictures section").nth(1).locator(".readout").innerText(), /^5, 9: theirs .*; ours .*; difference .* standard errors$/);

const phone = await browser.open(at("out/index.html"), { width: 375, height: 720, scheme: "dark" });
await phone.waitForSelector("body[data-ready]");
await expectNoSidewaysScroll(phone);
await browser.close();
assert.deepEqual(browser.complaints, []);
console.log("the page of blame shows what its files say");
