// A page that fills while a render runs: what was chosen stays, and in the end it shows what the finished page shows.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { openBrowser } from "./browser.mjs";

const folder = mkdtempSync(path.join(tmpdir(), "neumann-live-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
const scene = path.join(process.env.SCENES, "cornell-box/cornell-box.xml"), out = path.join(folder, "a");
const render = spawn(process.env.NEUMANN, ["render", scene, "-D", "res=64", "-n", "4", "--method", "walk", "--time", "600", "-o", out, "--live"], { stdio: ["ignore", "ignore", "pipe"] });
process.on("exit", () => render.kill("SIGKILL"));
const ended = new Promise(done => render.on("exit", done));
const address = await new Promise(found => {
  let said = "";
  render.stderr.on("data", text => {
    said += text;
    const at = said.match(/http:\/\/127\.0\.0\.1:\d+\//);
    if (at) found(at[0]);
  });
});

const browser = await openBrowser();
const page = await browser.visit(address);
// At once it has the scene's name and a bar.
assert.equal(await page.locator("h1").innerText(), "cornell-box.xml");
assert.ok(await page.locator("#bar, #title").first().isVisible());
await page.waitForSelector("body[data-ready]");  // the page that waited has become the explorer
const samples = () => page.evaluate(() => all[0].run.samples.per_pixel);
const soFar = () => page.locator("#so-far").innerText();
for (const key of ["ArrowRight", "ArrowRight", "s", "]"]) await page.keyboard.press(key);
await page.evaluate(() => { set({ pixel: { x: 9, y: 20 } }); document.querySelector("#tables details").open = true; });
const points = () => page.evaluate(() => errorPlot.data.datasets.find(s => s.label === "sum").data.length);
// Of one moment: the page goes on meanwhile.
const [begun, before] = await page.evaluate(() => [all[0].run.samples.per_pixel, [...all[0].mean({ i: 3, sum: true })]]);
await page.waitForFunction(n => all[0].run.samples.per_pixel >= 4 * n, begun, { timeout: 60000 });
assert.match(await soFar(), /^So far [\d\s]+ samples a pixel, .* left\.$/);
assert.ok(await points() >= 2);
assert.notDeepEqual(await page.evaluate(() => [...all[0].mean({ i: 3, sum: true })]), before);
assert.equal(await page.locator("#name").innerText(), "sum of bounces 0 to 3: Le + K Le + K² Le + K³ Le");
assert.deepEqual(await page.evaluate(() => [state.i, state.sum, state.stops, state.pixel, document.querySelector("#tables details").open]), [3, true, .5, { x: 9, y: 20 }, true]);

// Ctrl-C: the process ends as without a page, and the page has what index.html has.
render.kill("SIGINT");
assert.equal(await ended, 0);
await page.waitForFunction(() => $("so-far").textContent.startsWith("Finished."));
assert.equal(await soFar(), `Finished. What this page shows is kept in ${path.join(out, "index.html")}`);
const html = readFileSync(path.join(out, "index.html"), "utf8");
const parts = await page.evaluate(() => [...document.querySelectorAll("script[id]")].filter(s => s.id !== "live").map(s => s.outerHTML + "\n").join(""));
assert.ok(parts.length > 10000 && html.includes(parts));
assert.equal(await samples(), JSON.parse(readFileSync(path.join(out, "run.json"))).samples.per_pixel);
assert.deepEqual(await page.evaluate(() => [state.i, state.sum, state.stops, state.pixel]), [3, true, .5, { x: 9, y: 20 }]);
// It stays usable.
await page.keyboard.press("ArrowRight");
await page.waitForFunction(() => $("name").textContent.startsWith("sum of bounces 0 to 4"));

// A page of a render that did not end says so, and how to go on.
const cut = path.join(folder, "cut.html");
writeFileSync(cut, html.replace('{"runs":', '{"is_under_way":true,"runs":'));
const left = await browser.open(cut);
await left.waitForSelector("body[data-ready]");
assert.match(await left.locator("#so-far").innerText(), /^So far [\d\s]+ samples a pixel, .*: written at \d.*, when the render had not ended\. .* neumann render --resume DIR goes on/);

assert.deepEqual(browser.complaints, []);
await browser.close();
console.log("the page filled");
