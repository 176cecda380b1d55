// The page of `neumann render --touch` in a real browser: what it computes of a changed room is what a render of that room has, in
// time for thirty pictures a second.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { expectNames, expectNoSidewaysScroll, neumann, openBrowser } from "./browser.mjs";

const folder = mkdtempSync(path.join(tmpdir(), "neumann-touch-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
const at = name => path.join(folder, name);
const parts = { white: [.7, .7, .7], left: [.6, .1, .1], lamp: [9, 7, 4], spot: [20, 20, 30] };
const wall = (matrix, bsdf) => `<shape type="rectangle"><transform name="to_world">${matrix}</transform><ref id="${bsdf}"/></shape>`;
const turned = (axis, angle, x, y, z) => `<rotate ${axis}="1" angle="${angle}"/><translate x="${x}" y="${y}" z="${z}"/>`;
writeFileSync(at("room.xml"), `<scene version="3.0.0">
${Object.entries(parts).map(([name, rgb]) => `<default name="${name}" value="${rgb}"/>`).join("\n")}
<default name="res" value="64"/>
<sensor type="perspective"><float name="fov" value="60"/><transform name="to_world"><lookat origin="0, -0.8, 2.6" target="0, 0.1, 0" up="0, 1, 0"/></transform>
<film type="hdrfilm"><integer name="width" value="$res"/><integer name="height" value="$res"/></film></sensor>
<bsdf type="diffuse" id="white"><rgb name="reflectance" value="$white"/></bsdf>
<bsdf type="diffuse" id="left"><rgb name="reflectance" value="$left"/></bsdf>
${wall(turned("x", -90, 0, -1, 0), "white")}${wall(turned("x", 90, 0, 1, 0), "white")}${wall(turned("x", 0, 0, 0, -1), "white")}
${wall(turned("y", 90, -1, 0, 0), "left")}${wall(turned("y", -90, 1, 0, 0), "white")}
<shape type="cube"><transform name="to_world"><scale value="0.3"/><translate x="0.3" y="-0.7" z="0"/></transform><ref id="white"/></shape>
${[["lamp", -.3, .3], ["spot", .5, .12]].map(([name, x, size]) => `<shape type="rectangle" id="${name}"><transform name="to_world"><scale value="${size}"/>${turned("x", 90, x, .9, 0)}</transform>
<emitter type="area"><rgb name="radiance" value="$${name}"/></emitter></shape>`).join("\n")}
</scene>`);
const bounces = 5, means = (...options) => JSON.parse(neumann("render", at("room.xml"), "-n", `${bounces}`, "--json", "--quiet", ...options)).bounces;
const full = means("--method", "walk", "--spp", "256", "--touch", "--files", "page,tables", "-o", at("out"));

const browser = await openBrowser();
const page = await browser.open(at("out/touch.html"), { width: 1366, height: 768 });
await page.waitForFunction(() => window.touched);
await expectNames(page);
await expectNoSidewaysScroll(page);
assert.match(await page.locator("#about").innerText(), /with 64 rays each, 64 × 64 pixels/);
const names = await page.locator(".part b").allInnerTexts();
assert.deepEqual(names.slice(1).sort(), ["black", "left", "white", "lamp", "spot"].sort());

// What the page states: how far its bounces are from those of the render, as it was.
const [before, rendered] = await page.evaluate(() => [touched.meansBefore, touched.meansRendered]);
full.forEach((b, i) => assert.ok(Math.abs(rendered[i] - b.mean) <= 2e-3 * b.mean, `bounce ${i} of the render: ${rendered[i]}, expected ${b.mean}`));
const stated = full.map((b, i) => Math.abs(before[i] - b.mean) / b.mean);
stated.forEach((part, i) => assert.ok(part < .05, `bounce ${i}: patches are off by ${(100 * part).toFixed(1)}% as rendered`));

// Ten rooms at random: the page against fields of 4000 patches, within what both state.
let word = 1;
const random = () => (word = Math.imul(word, 1664525) + 1013904223 >>> 0) / 2 ** 32;
const largest = rgb => Math.max(...rgb);
for (let change = 0; change < 10; ++change) {
  const room = { white: [0, 0, 0].map(() => .1 + .8 * random()), left: [0, 0, 0].map(() => .9 * random()), lamp: parts.lamp.map(v => 2 * random() * v), spot: parts.spot.map(v => 2 * random() * v) };
  const shown = await page.evaluate(([room, parts]) => {
    const of = name => data.materials.findIndex(m => nameOf(m) === name), lamp = name => data.lamps.findIndex(l => nameOf(l) === name);
    for (const name of ["white", "left"]) touched.state.room.materials[of(name)] = room[name];
    for (const name of ["lamp", "spot"]) touched.state.room.lamps[lamp(name)] = room[name].map((v, c) => v / parts[name][c]);
    const found = touched.compute();
    return { means: found.means, radius: found.radius, norm: found.norm };
  }, [room, parts]);
  const definitions = Object.entries(room).flatMap(([name, rgb]) => ["-D", `${name}=${rgb}`]);
  const expected = means("--method", "matrix", "--patches", "4000", "--directions", "256", "--spp", "64", ...definitions, "-o", at(`room-${change}`), "--files", "tables");
  expected.forEach((b, i) => {
    const off = 4.5 * b.stderr + (b.discretisation?.mean ?? 0) + (stated[i] + .01) * b.mean;
    assert.ok(Math.abs(shown.means[i] - b.mean) <= off, `room ${change}, bounce ${i}: ${shown.means[i]}, expected ${b.mean} ± ${off}`);
  });
  // λ ≤ ‖K‖∞ ≤ the largest reflectance.
  for (let c = 0; c < 3; ++c) {
    assert.ok(shown.radius[c] <= shown.norm[c] * 1.01, `λ = ${shown.radius}, ‖K‖∞ = ${shown.norm}`);
    assert.ok(shown.norm[c] <= Math.max(room.white[c], room.left[c]) + 1e-6);
  }
}

// Bounce i was reflected i times, by all materials together, and is the sum of what the lamps bring.
for (let i = 1; i <= 4; ++i) {
  const { materials, lamps } = await page.evaluate(i => { Object.assign(touched.state, { bounce: i, sum: false }); return touched.origins(); }, i);
  assert.ok(Math.abs(materials.reduce((a, b) => a + b, 0) - i) < 1e-4, `bounce ${i}: ${materials}`);
  assert.ok(Math.abs(lamps.reduce((a, b) => a + b, 0) - 1) < 1e-4, `bounce ${i}: ${lamps}`);
  // Against a difference of two rooms: the left wall 1% brighter.
  const [less, more] = await page.evaluate(i => {
    const left = data.materials.findIndex(m => nameOf(m) === "left"), was = touched.state.room.materials[left];
    const means = [.99, 1.01].map(by => { touched.state.room.materials[left] = was.map(v => v * by); return touched.compute().means[i]; });
    touched.state.room.materials[left] = was;
    return means;
  }, i);
  const expected = (more - less) / (.01 * (more + less)), found = materials[await page.evaluate(() => data.materials.findIndex(m => nameOf(m) === "left"))];
  assert.ok(Math.abs(found - expected) < 2e-3 * i, `bounce ${i}: ${found}, expected ${expected}`);
}
await page.evaluate(() => Object.assign(touched.state, { bounce: 5, sum: true }));

// A slider moves the light; "As rendered" brings all back.
const facts = () => page.locator("#facts").innerText(), verdict = () => page.locator("#verdict").innerText();
const frame = () => page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
const colourAt = (x, y) => page.evaluate(([x, y]) => [...document.querySelector("#picture").getContext("2d").getImageData(x, y, 1, 1).data], [x, y]);
await page.locator("#reset").click();
await frame();
const wallBefore = await colourAt(20, 32), after = await page.evaluate(() => touched.compute().means);
after.forEach((m, i) => assert.ok(Math.abs(m - before[i]) <= 1e-5 * before[i]));
await page.getByLabel("lamp: how much").fill("0");
await page.getByLabel("spot: how much").fill("0");
await frame();
assert.deepEqual(await colourAt(20, 32), [0, 0, 0, 255], "without lamps it is dark");
await page.locator("#reset").click();
await frame();
assert.deepEqual(await colourAt(20, 32), wallBefore);
// White surfaces: the room is open, so it converges, but ‖K‖∞ bounds nothing.
assert.match(await verdict(), /^It converges/);
await page.locator("#white").click();
await frame();
assert.match(await facts(), /none: ‖K‖∞ is not below 1/);
await page.locator("#reset").click();

// The difference to the full render is told.
await page.locator("#of").selectOption("difference");
await frame();
assert.match(await page.locator("#caption").innerText(), /^bounces 0 to 5: patches − render, [\d.]+% RMS: discretisation/);
await page.locator("#of").selectOption("rendered");
await page.locator("#term").check();
await page.locator("#tiles button").nth(9).click();
await frame();
assert.equal(await page.locator("#caption").innerText(), "The render has bounces 0 to 5.");
await page.locator("#of").selectOption("now");
await frame();
assert.match(await page.locator("#caption").innerText(), /^bounce 9 of this room, on patches: mean/);

// A closed white room diverges before one's eyes.
writeFileSync(at("closed.xml"), `<scene version="3.0.0">
<sensor type="perspective"><transform name="to_world"><lookat origin="0, 0, 0.9" target="0, 0, 0" up="0, 1, 0"/></transform>
<film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="32"/></film></sensor>
<shape type="cube"><boolean name="flip_normals" value="true"/><bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf>
<emitter type="area"><rgb name="radiance" value="1"/></emitter></shape></scene>`);
neumann("render", at("closed.xml"), "-n", "4", "--spp", "64", "--touch", "--quiet", "--files", "tables", "-o", at("closed"));
const closed = await browser.open(at("closed/touch.html"), { width: 375, height: 720, scheme: "dark" });
await closed.waitForFunction(() => window.touched);
await expectNoSidewaysScroll(closed);
const closedMeans = await closed.evaluate(() => touched.compute().means);
closedMeans.forEach((m, i) => assert.ok(Math.abs(m - 2 ** -i) <= .02 * 2 ** -i, `bounce ${i} of the furnace: ${m}`));
await closed.locator("#white").click();
await closed.waitForFunction(() => document.getElementById("verdict").className === "diverges");

// 1000 patches × 64 rays × 17 bounces in at most 33 ms, the median of 30, on a machine that may do other things: three times as long.
const scene = path.join(process.env.SCENES, "cornell-box/cornell-box.xml");
neumann("render", scene, "-n", "16", "--spp", "4", "--touch", "--quiet", "--files", "tables", "-o", at("box"));
const box = await browser.open(at("box/touch.html"));
await box.waitForFunction(() => window.touched);
const took = await box.evaluate(() => {
  const all = [];
  for (let k = 0; k < 30; ++k) {
    touched.state.room.materials[0] = [.3 + .02 * k, .4, .5];
    const start = performance.now();
    touched.frame();
    all.push(performance.now() - start);
  }
  return all.sort((a, b) => a - b)[15];
});
console.log(`a frame takes ${took.toFixed(1)} ms`);
assert.ok(took <= 100, `a frame takes ${took} ms`);

assert.deepEqual(browser.complaints, []);
await browser.close();
