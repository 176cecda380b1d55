// The explorer of a real render in a real browser: what it shows are the numbers of the EXR files, whatever is pressed.
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { expectNames, expectNoSidewaysScroll, neumann, openBrowser, run } from "./browser.mjs";

const folder = mkdtempSync(path.join(tmpdir(), "neumann-explorer-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
const at = name => path.join(folder, name);
const scene = path.join(process.env.SCENES, "cornell-box/cornell-box.xml");
const side = 32, last = 4, t = 2.13145;  // Student's t, 0.975, of 16 replicates: 15 degrees of freedom
neumann("render", scene, "-D", `res=${side}`, "-n", `${last}`, "--spp", "512", "-o", at("a"), "--quiet");
neumann("render", scene, "-D", `res=${side}`, "-n", `${last + 1}`, "--method", "matrix", "--patches", "300", "--spp", "64", "-o", at("b"), "--quiet");
neumann("compare", at("a"), at("b"), "-o", at("both"));
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
const pixelsIn = (...args) => JSON.parse(run(process.env.PYTHON, path.join(here, "pixels.py"), ...args));
const pixels = pixelsIn(at("a"));
const json = JSON.parse(readFileSync(at("a/run.json")));
assert.equal(json.samples.degrees_of_freedom, 15);
const fileOf = (i, sum) => i > last ? "rest.exr" : `${sum ? "sum" : "bounce"}_00${i}.exr`;
const close = (a, b, relative, absolute = 0) => Math.abs(a - b) <= relative * Math.abs(b) + absolute;
const expectClose = (a, b, relative, what, absolute = 0) => assert.ok(close(a, b, relative, absolute), `${what}: ${a}, expected ${b}`);

const browser = await openBrowser();
const page = await browser.open(at("a/index.html"));
const text = id => page.locator(`#${id}`).innerText();
const press = async (...keys) => { for (const key of keys) await page.keyboard.press(key); await settled(page); };
const settled = p => p.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
await page.waitForSelector("body[data-ready]");

// What is left out of a mean as noise: at most 1/16 of its standard error, and of a sum that of each of its terms.
const leftOut = (i, sum, channel, p) => {
  const of = k => { const e = pixels[fileOf(k, false)][`stderr.${channel}`][p]; return e === null ? 0 : e / 16; };
  return sum ? Array.from({ length: i + 1 }, (_, k) => of(k)).reduce((a, b) => a + b) : of(i);
};
// Every pixel of every picture: means to half a unit of a half float's last bit (2⁻¹¹; 2⁻²⁵ of twice the brightest below that) beside
// what is left out, errors to half a step of their logarithm (6%).
for (let i = 0; i <= last + 1; ++i) for (const sum of i <= last ? [false, true] : [false]) {
  const { mean, errors } = await page.evaluate(ref => {
    const s = all[0], e = s.errors(ref);
    return { mean: [...s.mean(ref)], errors: Array.from({ length: 3 * s.pixels }, (_, p) => e(p) === Infinity ? null : e(p)) };
  }, { i, sum });
  const exr = pixels[fileOf(i, sum)];
  ["R", "G", "B"].forEach((channel, c) => {
    const largest = Math.max(...exr.R, ...exr.G, ...exr.B), offset = c * side * side;
    for (let p = 0; p < side * side; ++p) {
      expectClose(mean[offset + p], exr[channel][p], 2 ** -11 + 1e-6, `${fileOf(i, sum)} ${channel} ${p}`, largest * 2 ** -24 * (i + 1) + leftOut(i, sum, channel, p));
      expectClose(errors[offset + p], exr[`stderr.${channel}`][p], 2 ** (1 / 12) - 1 + 1e-3, `${fileOf(i, sum)} stderr.${channel} ${p}`);
    }
  });
}

// "6.12·10⁻⁴" as a number.
const read = words => {
  const [m, e = ""] = words.split("·10");
  return Number(m) * 10 ** Number([...e].map(c => "-0123456789"["⁻⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)]).join("") || 0);
};
// What stands under the picture of a pixel: value and half interval of each channel, and the relative standard error.
const readout = async () => {
  const line = await page.locator("#readout .values").first().innerText();
  const channels = ["red", "green", "blue"].map(name => {
    const found = line.match(new RegExp(`${name} (\\S+)(?: ± (\\S+))?`));
    return { value: read(found[1]), half: read(found[2] ?? "0") };
  });
  return { line, channels, relative: Number(line.match(/relative standard error (\S+)%/)?.[1]) / 100 };
};
const expectReadout = async (x, y, i, sum) => {
  const exr = pixels[fileOf(i, sum)], p = y * side + x, { channels, relative, line } = await readout();
  assert.match(await text("readout"), new RegExp(`Pixel ${x}, ${y},`));
  // Three digits of the value, two of its interval, which is right to 6%: half a unit of the last one is 0.5% and 5%.
  ["R", "G", "B"].forEach((channel, c) => {
    expectClose(channels[c].value, exr[channel][p], .0055, `${line}: ${channel}`, leftOut(i, sum, channel, p));
    expectClose(channels[c].half, t * exr[`stderr.${channel}`][p], .12, `${line}: interval of ${channel}`);
  });
  const size = of => Math.hypot(...["R", "G", "B"].map(c => exr[of + c][p]));
  expectClose(relative, size("stderr.") / size(""), .12 + size("stderr.") / size("") / 16, `${line}: relative error`);
};

// What the page is, in three sentences; what few read is folded away, and nothing is said again and again.
assert.match(await text("about"), /L = Le \+ K L,.*Kⁱ Le, bounce i, is light that was reflected i times on its way.*sum.*rest/s);
await page.getByLabel("All keys").click();
assert.ok(await page.locator("#help").isVisible());
await page.keyboard.press("Escape");
const folds = async p => Object.fromEntries(await p.locator("details").evaluateAll(all => all.map(d => [d.firstChild.textContent.split(":")[0], { open: d.open, head: d.firstChild.textContent, text: d.textContent }])));
{
  const found = await folds(page), { plan, health } = json, leftOut = plan.filter(p => !p.kept);
  assert.ok(Object.values(found).every(f => !f.open));
  assert.equal(found["The plan"].head, `The plan: ${leftOut.length} parts of the program left out, ${plan.length - leftOut.length} kept`);
  for (const { part } of plan) assert.ok(found["The plan"].text.includes(part), part);
  for (const { saves } of leftOut) assert.equal(found["The plan"].text.split(saves).length - 1, saves.startsWith("nothing") ? 1 : leftOut.filter(p => p.saves === saves).length, saves);
  assert.deepEqual(health.complaints, []);
  assert.equal(found.Health.head, "Health: nothing wrong was found");
  // Health is told in words, with the figures of run.json.
  const { rays, paths } = health.self_hits, spaced = n => String(n).replace(/\B(?=(\d{3})+$)/g, "\u202f");
  for (const words of ["All samples are finite numbers.", `Of ${spaced(rays)} rays of ${spaced(paths)} paths none hit the surface that they leave`, "is absorbed, leaves the scene or goes on"])
    assert.ok(found.Health.text.includes(words), `${words} in ${found.Health.text}`);
  for (const key of ["non finite samples", "self hits", "share of pixel", "part of rays at most 95", "confidence of all bounces"]) assert.ok(!found.Health.text.includes(key), key);
}

// It begins with direct light; the slider goes through the bounces and ends with the rest.
assert.match(await text("name"), /^bounce 1: K Le$/);
const stage = await page.locator("#stage").boundingBox();
const shownAt = async (x, y) => {  // where on the screen a pixel is
  const { left, top, side } = await page.evaluate(() => ({ left: state.left, top: state.top, side: state.fitScale * state.zoom }));
  const box = await page.locator("#stage").boundingBox();
  return [box.x + left + (x + .5) * side, box.y + top + (y + .5) * side];
};
const [x, y] = [9, 20];
await page.mouse.move(...await shownAt(x, y));
await expectReadout(x, y, 1, false);
await page.locator("#bounce").focus();
await page.keyboard.press("ArrowRight");
await page.keyboard.press("ArrowRight");
await settled(page);
assert.match(await text("name"), /^bounce 3: K³ Le$/);
assert.equal(await text("bounce-text"), `3 of ${last}`);
await expectReadout(x, y, 3, false);
await press("End");
assert.match(await text("name"), /^rest, all beyond bounce 4/);
await expectReadout(x, y, last + 1, false);

// Sums; a click chooses the pixel, whose series is in its plot.
await page.mouse.click(...await shownAt(x, y));
await press("s");
assert.match(await text("name"), /^sum of bounces 0 to 4: Le \+ K Le \+ … \+ K⁴ Le$/);
await expectReadout(x, y, last, true);
assert.equal(await text("pixel-title"), `Pixel ${x}, ${y}: sums`);
await press("s");
const series = await page.evaluate(() => pixelPlot.data.datasets.map(d => d.data.map(p => ({ i: Math.round(p.x), y: p.y, half: p.half }))));
["R", "G", "B"].forEach((channel, c) => {
  const p = y * side + x;
  assert.deepEqual(series[c].map(d => d.i), [1, 2, 3, 4, 5]);  // bounce 0 is black there
  for (const { i, y: value, half } of series[c]) {
    expectClose(value, pixels[fileOf(i, false)][channel][p], .001, `plot of the pixel, bounce ${i}`, leftOut(i, false, channel, p));
    expectClose(half, t * pixels[fileOf(i, false)][`stderr.${channel}`][p], .06, `its error bar, bounce ${i}`);
  }
});
const energy = await page.evaluate(() => Object.fromEntries(energyPlot.data.datasets.map(d => [d.label.split(":")[0], d.data])));
json.bounces.forEach((b, i) => {
  assert.equal(energy.mean[i].y, b.mean);
  expectClose(energy.mean[i].high - energy.mean[i].y, b.interval95, 1e-9, "energy's error bar");
  assert.equal(energy["bound on all that follows"][i].y, b.tail_bound);
});
expectClose(energy["all that follows"][last].y, json.rest.mean, 1e-12, "what follows the last bounce");
assert.ok("fitted decay" in energy);
const error = await page.evaluate(() => errorPlot.data.datasets.find(d => d.label === "sum").data);
const convergence = readFileSync(at("a/convergence.csv"), "utf8").trim().split("\n").map(l => l.split(","));
const column = convergence[0].indexOf("relative_stderr_sum");
assert.deepEqual(error.map(p => p.y), convergence.slice(1).map(r => Number(r[column])).filter(Number.isFinite));

// The colours on the screen are the EXR's, times the exposure that is told, in sRGB.
const onScreen = (canvas, x, y) => page.evaluate(([c, x, y]) => [...document.querySelector(c).getContext("2d").getImageData(x, y, 1, 1).data], [canvas, x, y]);
const srgb = v => Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * Math.min(1, v) ** (1 / 2.4) - 0.055));
const expectColour = async (canvas, i, sum, exposure) => {
  for (const [x, y] of [[9, 20], [3, 3], [16, 28], [30, 12]]) {
    const bytes = await onScreen(canvas, x, y);
    ["R", "G", "B"].forEach((channel, c) => expectClose(bytes[c], srgb(pixels[fileOf(i, sum)][channel][y * side + x] * exposure), 0, `colour of ${x}, ${y} in ${fileOf(i, sum)} on ${canvas}`, 1));
  }
};
const exposure = await page.evaluate(() => data.runs[0].pictures.exposure);
await press("Escape", "Home", "ArrowRight");
await expectColour("#a", 1, false, exposure);
await press("]", "]", "]", "]");
assert.match(await text("stops-text"), /^\+2 stops/);
await expectColour("#a", 1, false, 4 * exposure);
await press("[", "[", "[", "[");

// The strip has every bounce and the rest, or every sum, as bright as the large picture, or a power of two brighter where the brightest
// hundredth of what is lit has less than an eighth of white, which is said; a click chooses.
const brightest = (i, sum) => {
  const exr = pixels[fileOf(i, sum)], light = exr.R.map((r, p) => .2126 * r + .7152 * exr.G[p] + .0722 * exr.B[p]).filter(v => v > 0).sort((a, b) => a - b);
  return light[Math.floor(.99 * (light.length - 1))];
};
const timesOf = (i, sum) => {
  const times = 2 ** Math.floor(Math.log2(1 / (brightest(i, sum) * exposure)));
  return times >= 8 ? times : 1;
};
const expectTile = async (i, sum) => {
  const times = timesOf(i, sum), told = page.locator(`#strip button:nth-child(${i + 1})`);
  assert.equal(await told.locator(".times").textContent(), times > 1 ? `×${times}` : "", `what is said of tile ${i}`);
  assert.equal((await told.getAttribute("aria-label")).includes(`, ${times} times as bright`), times > 1);
  await expectColour(tile(i), i, sum, exposure * times);
  return times;
};
const tiles = page.locator("#strip button");
const tile = i => `#strip button:nth-child(${i + 1}) canvas`;
const drawn = async p => {
  await settled(p);
  await p.waitForFunction(() => !strip.asked);
};
await drawn(page);
const tileNames = () => tiles.evaluateAll(all => all.map(t => t.lastChild.textContent));
assert.deepEqual(await tileNames(), ["0", "1", "2", "3", "4", "rest"]);
const brightened = [];
for (let i = 0; i <= last + 1; ++i) brightened.push(await expectTile(i, false));
assert.ok(brightened[1] === 1 && brightened[4] >= 8, String(brightened));
await press("s");
await drawn(page);
assert.deepEqual(await tileNames(), ["0", "0–1", "0–2", "0–3", "0–4"]);
for (let i = 0; i <= last; ++i) await expectTile(i, true);
await press("s", "f");
await drawn(page);
// Each as bright as it takes: its brightest hundredth is white.
for (let i = 1; i <= last + 1; ++i) {
  await expectColour(tile(i), i, false, 1 / brightest(i, false));
}
await press("f");
await tiles.nth(3).click();
await settled(page);
assert.match(await text("name"), /^bounce 3: K³ Le$/);
await expectColour("#a", 3, false, exposure);
assert.deepEqual(await tiles.evaluateAll(all => all.map(t => t.ariaCurrent)), ["false", "false", "false", "true", "false", "false"]);
// An arrow key goes on from there, and the focus with it.
await press("ArrowRight");
assert.match(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), /^bounce 4\b/);
// The large picture keeps the exposure of all, and says what brightens it.
assert.ok(await page.locator("#dark").isVisible());
await expectColour("#a", 4, false, exposure);
await tiles.nth(1).click();
await settled(page);

// A click on a plot goes to the bounce at that place, or to the picture of the curve under the pointer. The bound, which is far above, does
// not squeeze the others, and the chosen bounce's curve is in front of the others.
const clickPlot = async (chart, at) => {
  const { x, y } = await page.evaluate(([chart, at]) => {
    const c = { energyPlot, errorPlot }[chart], box = c.canvas.getBoundingClientRect(), { scales } = c;
    c.canvas.scrollIntoView({ block: "center" });
    const p = at.label ? c.data.datasets.flatMap(d => d.data).find(p => p.label === at.label) : at, now = c.canvas.getBoundingClientRect();
    return { x: now.x + scales.x.getPixelForValue(p.x), y: now.y + (p.y ? scales.y.getPixelForValue(p.y) : (c.chartArea.top + c.chartArea.bottom) / 2) };
  }, [chart, at]);
  await page.mouse.click(x, y);
  await settled(page);
};
await clickPlot("energyPlot", { x: 3, y: json.bounces[3].mean });
assert.match(await text("name"), /^bounce 3: K³ Le$/);
await clickPlot("energyPlot", { x: 5 });
assert.match(await text("name"), /^rest, /);
await clickPlot("errorPlot", { label: "bounce 2" });
assert.match(await text("name"), /^bounce 2: /);
const drawnFirst = await page.evaluate(() => errorPlot.getSortedVisibleDatasetMetas().map(m => m.label).reverse());
assert.ok(drawnFirst.lastIndexOf("") < drawnFirst.indexOf("bounce 2") && drawnFirst[0] === "", JSON.stringify(drawnFirst));
{
  const { high, low, top, bottom, bound } = await page.evaluate(ends => ({ low: energyPlot.scales.y.getPixelForValue(ends[0]), high: energyPlot.scales.y.getPixelForValue(ends[1]), ...energyPlot.chartArea,
    bound: energyPlot.data.datasets.at(-1).label }), [json.bounces[last].mean, json.bounces[0].mean]);
  assert.ok(low - high > .5 * (bottom - top), `means from ${high} to ${low} in a plot from ${top} to ${bottom}`);
  assert.match(bound, /^bound on all that follows: \S+ to \S+, above the plot$/);
}
await page.evaluate(() => scrollTo(0, 0));
await tiles.nth(1).click();
await settled(page);

// The wipe shows the next bounce on the right of its edge.
await press("w");
await expectColour("#b", 2, false, exposure);
assert.deepEqual([await text("side-a"), await text("side-b")], ["A: bounce 1", "B: bounce 2"]);
const cut = () => page.evaluate(() => parseFloat(document.getElementById("b").style.clipPath.split(" ").at(-1)));
const middle = await cut();
await press("<", "<");
assert.ok(await cut() < middle);
await page.selectOption("#other", "0-sum-3");
await settled(page);
await expectColour("#b", 3, true, exposure);
await press("w");

// Noise and false colour come with a scale.
assert.ok(await page.locator("#scale").isHidden());
await press("n");
assert.match(await text("quantity"), /standard error of a pixel/);
const relativeShown = await page.evaluate(p => image.relative(p), y * side + x);
const exr = pixels["bounce_001.exr"], size = of => Math.hypot(...["R", "G", "B"].map(c => exr[of + c][y * side + x]));
expectClose(relativeShown, size("stderr.") / size(""), .06 + size("stderr.") / size("") / 16, "noise");
await press("n", "c");
assert.match(await text("quantity"), /luminance of the radiance, W·m⁻²·sr⁻¹/);
await press("c");

// Play goes on by itself, around, until it is stopped.
await press("End", " ");
await page.waitForFunction(() => state.i === 1, null, { timeout: 10000 });
assert.equal(await text("play"), "Stop");
await press(" ");
const stopped = await page.evaluate(() => state.i);
await page.waitForTimeout(900);
assert.equal(await page.evaluate(() => state.i), stopped);

// Without a mouse: to the picture, three pixels to the left, ten down; zoom keeps that pixel in view.
await press("p", "ArrowLeft", "ArrowLeft", "ArrowLeft", "Shift+ArrowDown");
assert.deepEqual(await page.evaluate(() => state.pixel), { x: side / 2 - 3, y: side / 2 + 10 });
await expectReadout(side / 2 - 3, side / 2 + 10, stopped, false);
await press("+", "+", "+", "+");
const [mx, my] = await shownAt(side / 2 - 3, side / 2 + 10), box = await page.locator("#stage").boundingBox();
assert.ok(mx > box.x && mx < box.x + box.width && my > box.y && my < box.y + box.height);
await page.mouse.click(mx, my);
await settled(page);
assert.deepEqual(await page.evaluate(() => state.pixel), { x: side / 2 - 3, y: side / 2 + 10 });
await press("0", "?");
assert.ok(await page.locator("#help").isVisible());
await page.keyboard.press("Escape");
assert.ok(await page.locator("#help").isHidden());
await expectNames(page);

// Slides: nothing but the picture and its formula, as large as the screen, until Escape.
const caption = () => page.evaluate(() => document.getElementById("slide-caption").innerHTML);
const seen = ids => page.evaluate(ids => ids.filter(id => document.getElementById(id).checkVisibility()), ids);
await press("Escape", "Home");
await press("l");
assert.equal(await caption(), "L<sub>e</sub>");
await press("ArrowRight", "ArrowRight", "ArrowRight");
assert.equal(await caption(), "K<sup>3</sup> L<sub>e</sub>");
await expectColour("#a", 3, false, exposure);
await press("s");
assert.equal(await caption(), "Σ K<sup>i</sup> L<sub>e</sub>, i ≤ 3");
await press("s", "End");
assert.equal(await caption(), "rest: Σ K<sup>i</sup> L<sub>e</sub>, i &gt; 4");
assert.deepEqual(await seen(["title", "about", "name", "strip", "steps", "view", "energy", "tables", "stage", "slide-caption", "leave"]), ["stage", "slide-caption", "leave"]);
{
  const [stage, below, window] = [...await Promise.all(["stage", "slide-caption"].map(id => page.locator(`#${id}`).boundingBox())), await page.evaluate(() => [innerWidth, innerHeight])];
  assert.deepEqual([stage.x, stage.y, stage.width], [0, 0, window[0]]);
  assert.ok(stage.height > .8 * window[1] && Math.abs(below.y + below.height - window[1]) < 2, JSON.stringify([stage, below, window]));
}
const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
assert.equal(await ground(), "rgb(0, 0, 0)");
await press("d");
assert.equal(await ground(), "rgb(255, 255, 255)");
await page.mouse.click(200, 200);
await settled(page);
assert.equal(await caption(), "K<sup>4</sup> L<sub>e</sub>");
await press("Escape");
await page.waitForFunction(() => !document.fullscreenElement);
await settled(page);
assert.deepEqual(await seen(["title", "slide-caption", "leave", "strip"]), ["title", "strip"]);
await press("Home", "ArrowRight", "ArrowRight", "ArrowRight", "ArrowRight");

// The mean of a rectangle, drawn with Shift or by the keys, with the interval of errors that are independent.
assert.equal(json.options.method, "walk");  // whose pixels are
const expectRect = async ([x0, x1, y0, y1], i, sum) => {
  const lines = await page.locator("#readout").innerText(), exr = pixels[fileOf(i, sum)], span = (a, b) => a === b ? a : `${a} to ${b}`;
  assert.ok(lines.includes(`Mean of the rectangle ${span(x0, x1)}, ${span(y0, y1)}, W·m⁻²·sr⁻¹; 95% intervals, for errors of pixels that are independent`), lines);
  const figures = await page.locator("#readout .values").last().innerText();
  ["R", "G", "B"].forEach((channel, c) => {
    let mean = 0, variance = 0, n = 0;
    for (let y = y0; y <= y1; ++y) for (let x = x0; x <= x1; ++x, ++n) { mean += exr[channel][y * side + x]; variance += exr[`stderr.${channel}`][y * side + x] ** 2; }
    const [, value, half] = figures.match(new RegExp(`${["red", "green", "blue"][c]} (\\S+) ± (\\S+)`));
    expectClose(read(value), mean / n, .0055, `mean of ${channel} in the rectangle`);
    expectClose(read(half), t * Math.sqrt(variance) / n, .06, `its interval in ${channel}`);
  });
};
await press("Escape", "Home", "ArrowRight", "ArrowRight");
const sizeBefore = await page.locator("#stage").boundingBox();
await page.keyboard.down("Shift");
await page.mouse.move(...await shownAt(20, 25));
await page.mouse.down();
await page.mouse.move(...await shownAt(15, 18), { steps: 5 });
await page.mouse.up();
await page.keyboard.up("Shift");
await page.mouse.move(0, 0);
await settled(page);
await expectRect([15, 20, 18, 25], 2, false);
assert.deepEqual(await page.locator("#stage").boundingBox(), sizeBefore);  // the picture does not move under the pointer
const [rect, corner] = [await page.locator("#rect").boundingBox(), await shownAt(15, 18)];
assert.ok(corner[0] > rect.x && corner[0] < rect.x + rect.width / 6 && corner[1] > rect.y && corner[1] < rect.y + rect.height / 8, JSON.stringify([rect, corner]));
await press("s");
await expectRect([15, 20, 18, 25], 2, true);
await press("s", "Escape");
assert.ok(await page.locator("#rect").isHidden());
await press("a", "ArrowRight", "ArrowRight", "ArrowUp", "a", "ArrowUp");
await expectRect([16, 18, 15, 16], 2, false);
assert.match(await text("readout"), /^Pixel 18, 14,/);
await page.locator("#picking").click();  // for fingers, which have no Shift
await page.mouse.move(...await shownAt(3, 4));
await page.mouse.down();
await page.mouse.move(...await shownAt(5, 4), { steps: 5 });
await page.mouse.up();
await page.mouse.move(0, 0);
await settled(page);
await expectRect([3, 5, 4, 4], 2, false);
assert.equal(await page.locator("#picking").getAttribute("aria-pressed"), "false");
await press("Escape");

// The wheel zooms the picture about the pointer, and beside it scrolls the page, as over the whole picture when it cannot zoom out.
{
  const [mx, my] = await shownAt(9, 20), turn = async (x, y, by) => { await page.mouse.move(x, y); await page.mouse.wheel(0, by); };
  const beside = await page.locator(".controls").boundingBox(), scrolled = () => page.evaluate(() => scrollY), pause = () => page.waitForTimeout(400);
  await page.evaluate(() => document.activeElement.blur());
  await turn(mx, my, -300);
  await page.waitForFunction(() => state.zoom > 1.7 && state.zoom < 1.95);  // e^.6
  assert.deepEqual([await page.evaluate(([x, y]) => pixelAt({ clientX: x, clientY: y }), [mx, my]), await scrolled()], [{ x: 9, y: 20 }, 0]);
  await turn(mx, my, 900);
  await page.waitForFunction(() => state.zoom === 1);
  assert.equal(await scrolled(), 0);
  await pause();
  await turn(mx, my, 100);
  await page.waitForFunction(() => scrollY > 0);
  await pause();
  await page.evaluate(() => scrollTo(0, 0));
  await pause();
  await turn(beside.x + 5, beside.y + 5, 100);
  await page.waitForFunction(() => scrollY > 0);
  assert.equal(await page.evaluate(() => state.zoom), 1);
  await page.evaluate(() => scrollTo(0, 0));
  await page.mouse.move(0, 0);
  await settled(page);
}

// The histogram counts the pixels of what is shown; its handles set white and the low end of the colours.
const lightOf = name => pixels[name].R.map((r, p) => .2126 * r + .7152 * pixels[name].G[p] + .0722 * pixels[name].B[p]);
const light = lightOf("bounce_002.exr");
await page.evaluate(() => set({ view: "false", wipe: false }));
await settled(page);
const ticksOf = () => page.evaluate(() => [...$("histogram-ticks").children].map(e => [parseFloat(e.style.left) / 100, e.textContent])).then(ticks => [ticks[0], ticks.at(-1)].map(([at, label]) => ({ at, log: Math.log10(read(label)) })));
const bars = await page.evaluate(() => {
  const { width, height } = $("histogram"), { data } = $("histogram").getContext("2d").getImageData(0, 0, width, height);
  return Array.from({ length: width }, (_, x) => Array.from({ length: height }, (_, y) => data[4 * (y * width + x) + 3] > 0).filter(Boolean).length);
});
{
  const [p, q] = await ticksOf(), binOf = v => Math.floor(bars.length * (p.at + (Math.log10(v) - p.log) / (q.log - p.log) * (q.at - p.at)));
  const counts = new Array(bars.length).fill(0);
  for (const v of light) if (v > 0) ++counts[binOf(v)];
  const most = Math.max(...counts), expected = counts.map(n => Math.round(48 * Math.sqrt(n / most)));
  // Half floats may move a pixel to the next bar.
  const off = expected.map((height, bin) => Math.abs(height - bars[bin])).filter(d => d > 1).length;
  assert.ok(off <= 12 && expected.filter(h => h > 0).length > 20, JSON.stringify([expected, bars]));
  assert.ok((await text("histogram-note")).startsWith("1\u202f024 pixels by luminance"), await text("histogram-note"));
  assert.ok((await text("histogram-note")).includes(`${light.filter(v => v === 0).length} are 0`) || light.every(v => v > 0));
}
const drag = async (id, part) => {  // a handle by the mouse to a part of the track; returns what the axis says of that place
  const [p, q] = await ticksOf();
  const track = await page.locator("#histogram").boundingBox(), from = await page.evaluate(id => +$(id).value, id), y = track.y + track.height + 8;
  await page.mouse.move(track.x + from * track.width, y);
  await page.mouse.down();
  await page.mouse.move(track.x + part * track.width, y, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  return 10 ** (p.log + (part - p.at) / (q.at - p.at) * (q.log - p.log));
};
const asked = await drag("range-high", .7), white = await page.evaluate(() => image.high);
expectClose(white, asked, .05, "white after the drag");  // tenths of a stop: 3.5%, and a pixel of the track
const scaleEnds = await page.evaluate(() => [...$("ticks").children].map(e => [parseFloat(e.style.left) / 100, e.textContent]));
for (const [at, label] of scaleEnds) assert.ok(at >= 0 && at <= 1 && read(label) <= white * 1.01);
await page.evaluate(() => set({ view: "colour" }));
await settled(page);
await expectColour("#a", 2, false, 1 / white);
assert.ok(await page.locator("#range-low").isDisabled());
await page.evaluate(() => set({ view: "false", stops: 0 }));
await settled(page);
const askedLow = await drag("range-low", .5), low = await page.evaluate(() => image.low);
expectClose(low, askedLow, .05, "the low end after the drag");
// All below it has the first colour of the map, all above another.
const canvas = await page.evaluate(() => [...$("a").getContext("2d").getImageData(0, 0, $("a").width, $("a").height).data]);
for (let p = 0; p < side * side; ++p) if (light[p] > 0 && Math.abs(Math.log(light[p] / low)) > .1)
  assert.equal(canvas.slice(4 * p, 4 * p + 3).join() === "68,1,84", light[p] < low, `pixel ${p}`);  // viridis begins with 440154
await page.evaluate(() => set({ view: "colour", stops: 0, decades: 4 }));

// The address tells what is shown: another page at it shows the same. What means nothing in it is as if it were not there.
const atAddress = async hash => {
  const p = await browser.open(at("a/index.html"), { hash });
  await p.waitForSelector("body[data-ready]");
  return p;
};
const shownBy = p => p.evaluate(() => [$("name"), $("readout"), $("bounce-text"), $("stops-text"), $("zoom-text"), $("quantity")].map(e => e.textContent).concat($("a").toDataURL(), $("b").toDataURL(), $("sheet").style.transform.replace(/\.\d+/g, "")));
await page.mouse.move(0, 0);
await page.evaluate(() => set({ i: 3, sum: true, view: "false", stops: 2, pixel: { x: 9, y: 20 }, wipe: true, other: "0-term-2", edge: .25, decades: 3, rect: { x0: 2, y0: 3, x1: 8, y1: 9 } }));
await press("+", "+");
await page.waitForFunction(() => location.hash.includes("zoom"));
const address = await page.evaluate(() => location.hash);
for (const part of ["bounce=3", "sum=1", "view=false", "exposure=2", "pixel=9,20", "wipe=1", "b=0-term-2", "edge=0.25", "decades=3", "rect=2,3,8,9", "zoom=2.25,"]) assert.ok(address.includes(part), `${part} in ${address}`);
const copy = await atAddress(address);
await settled(copy);
assert.deepEqual(await shownBy(copy), await shownBy(page));
assert.match(await copy.locator("#name").innerText(), /^sum of bounces 0 to 3: /);
assert.match(await copy.locator("#readout").innerText(), /^Pixel 9, 20,/);
await copy.evaluate(() => { location.hash = "#bounce=rest"; });
await copy.waitForFunction(() => document.getElementById("name").textContent.startsWith("rest"));
assert.deepEqual(await copy.evaluate(() => [state.sum, state.stops, state.pixel, state.wipe, state.zoom]), [false, 0, null, false, 1]);
const bad = await atAddress("#bounce=99&sum=7&view=z&curve=&exposure=1e9&pixel=-1,5&zoom=0,1,1&run=5&b=zzz&edge=x&wipe&slide=pink&decades=-1&rect=1,2,3&%%%=1&fit=NaN");
const plain = await atAddress(""), beyond = await atAddress("#bounce=5");  // there are 4
assert.match(await beyond.locator("#name").innerText(), /^bounce 1: /);
await beyond.close();
assert.deepEqual(await shownBy(bad), await shownBy(plain));
for (const p of [copy, bad, plain]) await p.close();

// A picture is saved as it is shown, a pixel for a pixel; of the wipe, both sides.
mkdirSync(at("saved"));
const saved = async act => {
  const [download] = await Promise.all([page.waitForEvent("download"), act()]);
  await download.saveAs(at(`saved/${download.suggestedFilename()}`));
  return download.suggestedFilename();
};
const expectPng = (png, x, y, i, sum, exposure) => {
  for (const [channel, byte] of ["R", "G", "B"].map(c => [c, Math.round(255 * png[c][y * side + x])]))
    expectClose(byte, srgb(pixels[fileOf(i, sum)][channel][y * side + x] * exposure), 0, `${channel} of ${x}, ${y} in the PNG`, 1);
};
await page.evaluate(() => set({ i: 2, sum: false, view: "colour", stops: 0, decades: 4, wipe: false, pixel: null, rect: null }));
await press("0");
const single = await saved(() => page.locator("#save-picture").click());
await page.evaluate(() => set({ wipe: true, other: "next", edge: .5 }));
await press("ArrowRight");
const halves = await saved(() => press("i"));
assert.deepEqual([single, halves], ["cornell-box-bounce-2.png", "cornell-box-bounce-3.png"]);
const png = pixelsIn(at("saved"), "*.png");
assert.deepEqual([single, halves].map(name => png[name].R.length), [side * side, side * side]);
for (let y = 0; y < side; ++y) for (let x = 0; x < side; ++x) {
  expectPng(png[single], x, y, 2, false, exposure);
  expectPng(png[halves], x, y, x < side / 2 ? 3 : 4, false, exposure);
}

// A plot as a drawing, read by its own axis, and as a table.
await page.evaluate(() => set({ i: 2, wipe: false, pixel: { x: 9, y: 20 } }));
await settled(page);
const file = async act => readFileSync(at(`saved/${await saved(act)}`), "utf8");
const svg = await file(() => page.getByLabel("Save the plot: energy of each bounce, SVG").click());
{
  const ticks = [...svg.matchAll(/<text x="[^"]*" y="([^"]*)" [^>]*class="y">([^<]+)</g)].map(([, top, label]) => ({ at: top - 4, log: Math.log10(read(label) || 10 ** read("1·" + label)) }));
  const [p, q] = [ticks[0], ticks.at(-1)], means = svg.match(/<title>mean<\/title>(.*?)<\/g>/s)[1];
  const values = [...means.matchAll(/translate\(\S+ (\S+)\)/g)].map(([, top]) => 10 ** (p.log + (top - p.at) / (q.at - p.at) * (q.log - p.log)));
  assert.equal(values.length, last + 1);
  values.forEach((value, i) => expectClose(value, json.bounces[i].mean, .005, `bounce ${i} in the drawing`));
  for (const words of ["mean radiance / W·m⁻²·sr⁻¹", "bounce", "all that follows", "rest"]) assert.ok(svg.includes(`>${words}<`), words);
}
const rows = csv => csv.trim().split("\n").map(row => row.split(","));
const table = rows(await file(() => page.getByLabel("Save the figures: energy of each bounce, CSV").click()));
assert.deepEqual(table[0], ["series", "bounce", "mean radiance / W·m⁻²·sr⁻¹", "half of the 95% interval"]);
assert.deepEqual(table.filter(r => r[0] === "mean").map(r => r.slice(1).map(Number)), json.bounces.map((b, i) => [i, b.mean, b.interval95]));
assert.deepEqual(table.find(r => r[0] === "rest").slice(1), ["rest", String(json.rest.mean), String(json.rest.interval95)]);
const expectPixelRow = (values, i, sum, what) => ["R", "G", "B"].forEach((channel, c) => {
  const exr = pixels[fileOf(i, sum)], p = y * side + x;
  expectClose(+values[2 * c], exr[channel][p], .001, `${what}: ${channel}`, leftOut(i, sum, channel, p));
  expectClose(+values[2 * c + 1], t * exr[`stderr.${channel}`][p], .06, `${what}: interval of ${channel}`);
});
const pixelTable = rows(await file(() => page.getByLabel("Save the figures: the chosen pixel, CSV").click()));
const inTable = (series, i) => pixelTable.find(r => r[0] === series && r[1] === (i > last ? "rest" : String(i))).slice(2);
for (let i = 0; i <= last + 1; ++i) expectPixelRow(["red", "green", "blue"].flatMap(name => inTable(name, i)), i, false, "CSV");  // bounce 0, which is 0, too

// The values of a pixel are copied, or shown where the browser does not let them be.
await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
await page.getByLabel("Copy the values of the chosen pixel").click();
await page.waitForFunction(() => $("copied").textContent === "Copied.");
const copied = await page.evaluate(() => navigator.clipboard.readText());
const lines = copied.trim().split("\n").map(l => l.split("\t"));
assert.equal(lines[0].join("|"), "pixel 9,20, W m^-2 sr^-1|red|± (95%)|green|± (95%)|blue|± (95%)");
assert.equal(lines.length, 1 + 2 * (last + 1) + 1);
for (let i = 0; i <= last + 1; ++i) expectPixelRow(lines[1 + i].slice(1), i, false, "copied");
for (let i = 0; i <= last; ++i) expectPixelRow(lines[3 + last + i].slice(1), i, true, "copied sum");
await page.evaluate(() => { navigator.clipboard.writeText = () => Promise.reject(new Error("no")); });
await press("y");
assert.equal(await page.locator("#copy-text").inputValue(), copied);
await page.keyboard.press("Escape");
await press("Escape", "Home", "ArrowRight", "ArrowRight", "ArrowRight", "ArrowRight");

// A box that was clicked leaves the keys of the bounces alone, and keeps its own.
await page.locator("#wipe").click();
await press("Home", "ArrowRight", "ArrowRight");
assert.match(await text("name"), /^bounce 2: /);
await press(" ");
assert.deepEqual(await page.evaluate(() => [state.wipe, playing]), [false, null]);

// Two methods on one page.
const both = await browser.open(at("both/index.html"));
await both.waitForSelector("body[data-ready]");
assert.match(await both.locator("#side-b").innerText(), /^B: bounce 1$/);
assert.doesNotMatch(await both.locator("#tables").innerText(), /upper bounds/);
const differences = JSON.parse(readFileSync(at("both/compare.json")));
await both.keyboard.press("s");
await both.keyboard.press("End");
await both.selectOption("#view", "difference");
await settled(both);
// The mean over the picture is what compare says of it: luminance weighs channels, so the weighted mean of its three.
const sumRow = differences.pictures.find(p => p.name === `sum_00${last}`);
const expected = .2126 * sumRow.red.mean_difference + .7152 * sumRow.green.mean_difference + .0722 * sumRow.blue.mean_difference;
const mean = await both.evaluate(() => { let d = 0; for (let p = 0; p < all[0].pixels; ++p) d += image.value(p); return d / all[0].pixels; });
expectClose(mean, expected, 0, "mean difference", 2 ** -11 * 2 * sumRow.mean);
// Its scale is its own, whatever the exposure: of the pixels that differ 95% lie within, more than a third of them beyond a sixth of
// it, which is where black ends, and the scale is told.
for (const stops of ["0", "20"]) {
  await both.evaluate(x => set({ stops: +x }), stops);
  await settled(both);
  const shown = await both.evaluate(() => {
    const sizes = [...Array(all[0].pixels).keys()].map(p => Math.abs(image.value(p))).filter(v => v > 0);
    return { within: sizes.filter(v => v <= image.high).length / sizes.length, seen: sizes.filter(v => v > image.high / 6).length / sizes.length,
             low: image.low, high: image.high, told: $("quantity").textContent, ends: $("ticks").lastChild.textContent, text: number(image.high, 2) };
  });
  assert.ok(shown.within >= .94 && shown.within < 1 && shown.seen > .33, JSON.stringify(shown));
  assert.equal(shown.low, -shown.high);
  assert.ok(shown.told.includes(`95% of the pixels that differ do so by at most ${shown.text}`), shown.told);
  assert.equal(shown.ends, shown.text);
}
assert.ok(await both.locator("#stops").isDisabled());
await both.evaluate(() => set({ stops: 0 }));
await both.selectOption("#view", "z");
await expectNames(both);
// B has a bounce more. Rest is compared with rest, and a bounce that only one run has with nothing.
await both.selectOption("#view", "colour");
for (const key of ["s", "r", "End"]) await both.keyboard.press(key);
await settled(both);
assert.deepEqual([await both.locator("#side-a").innerText(), await both.locator("#side-b").innerText()], ["B: rest, all beyond bounce 5", "A: rest, all beyond bounce 4"]);
await both.keyboard.press("ArrowLeft");
await settled(both);
assert.equal(await both.locator("#empty").innerText(), "A: there is no bounce 5");
await both.selectOption("#other", "previous");
await both.keyboard.press("s");
await both.keyboard.press("Home");
await settled(both);
assert.equal(await both.locator("#empty").innerText(), "B: there is no bounce before");
const rests = await both.evaluate(() => energyPlot.data.datasets.filter(d => d.label.startsWith("rest")).map(d => d.data[0].x));
assert.deepEqual(rests, [6, 6]);

// Three renders on one page: the digits choose one, and B is any of the others.
neumann("render", scene, "-D", `res=${side}`, "-n", `${last}`, "--spp", "64", "--seed", "7", "--method", "light", "-o", at("c"), "--quiet");
neumann("compare", at("a"), at("b"), at("c"), "-o", at("three"));
const three = await browser.open(at("three/index.html"));
await three.waitForSelector("body[data-ready]");
assert.match(await three.locator("#title").innerText(), /: A, B and C$/);
const exrOf = { A: pixels, B: pixelsIn(at("b")), C: pixelsIn(at("c")) };
const expectOn = async (canvas, name) => {
  const bytes = await three.evaluate(c => [...$(c).getContext("2d").getImageData(9, 20, 1, 1).data], canvas);
  ["R", "G", "B"].forEach((channel, c) => expectClose(bytes[c], srgb(exrOf[name]["bounce_001.exr"][channel][20 * side + 9] * exposure), 0, `${channel} of ${name} on ${canvas}`, 1));
};
for (const [key, name, next] of [["1", "A", "B"], ["2", "B", "C"], ["3", "C", "A"]]) {
  await three.keyboard.press(key);
  await settled(three);
  assert.deepEqual([await three.locator("#side-a").innerText(), await three.locator("#side-b").innerText()], [`${name}: bounce 1`, `${next}: bounce 1`]);
  await expectOn("a", name);
  await expectOn("b", next);
}
await three.selectOption("#view", "difference");
await settled(three);
assert.match(await three.locator("#quantity").innerText(), /^C − A, luminance/);
await three.selectOption("#view", "colour");
await three.selectOption("#other", "run-1");
await settled(three);
await expectOn("b", "B");
// Those of light are of paths that many pixels have in common: the mean of a rectangle has but a bound.
await three.evaluate(() => set({ rect: { x0: 4, y0: 4, x1: 7, y1: 7 }, wipe: false }));
await settled(three);
const ofC = exrOf.C["bounce_001.exr"], four = [4, 5, 6, 7], together = four.flatMap(y => four.map(x => ofC["stderr.R"][y * side + x])).reduce((a, b) => a + b) / 16;
assert.match(await three.locator("#readout").innerText(), /upper bounds/);
expectClose(read((await three.locator("#readout .values").last().innerText()).match(/red \S+ ± (\S+)/)[1]), await three.evaluate(() => all[2].intervalFactor) * together, .06, "the bound on the mean of a rectangle");
await expectNames(three);

// One sample tells no errors: the warning is on top, intervals are unknown, and the noise is grey.
neumann("render", scene, "-D", "res=8", "-n", "0", "--spp", "1", "-o", at("one"), "--quiet");
const one = await browser.open(at("one/index.html"));
await one.waitForSelector("body[data-ready]");
assert.equal(await one.locator("#warnings").innerText(), "a single replicate was sampled: the standard errors are unknown");
await one.locator("#stage").click();
await one.selectOption("#view", "noise");
await settled(one);
assert.match(await one.locator("#readout .values").innerText(), /red (\S+) ± unknown.*relative standard error unknown|red 0 ± unknown/s);
assert.deepEqual(await one.evaluate(() => [unknown, image.at(0)]), [0xff808080, 0xff808080]);

// Of many warnings two are in sight, the others a click away; each is told once.
neumann("render", path.join(process.env.SCENES, "glass-ball/glass-ball.xml"), "-D", "res=64", "-n", "8", "--spp", "64", "--method", "walk", "-o", at("ball"), "--quiet");
const ball = await browser.open(at("ball/index.html")), sick = JSON.parse(readFileSync(at("ball/run.json"))), told = sick.health.complaints.length + sick.warnings.length;
assert.ok(sick.health.complaints.length > 2);
await ball.waitForSelector("body[data-ready]");
assert.equal(await ball.locator("#warnings > .warning").count(), 2);
assert.equal((await folds(ball))[`${told - 2} more warnings`]?.open, false);
const everything = await ball.evaluate(() => ["header", "main", "#tables"].map(part => document.querySelector(part).textContent).join());
for (const complaint of sick.health.complaints) assert.equal(everything.split(complaint).length - 1, 1, complaint);

// Parts of run.json that this page does not know are tables all the same.
const cells = await page.evaluate(() => [...generic([{ part: "mirrors", kept: false, light: { mean: .5, stderr: .1, interval95: .2 } }, { part: "glass", kept: true, count: 12345 }])
  .querySelectorAll("tr")].map(row => [...row.cells].map(c => c.textContent)));
assert.deepEqual(cells, [["part", "kept", "light", "count"], ["mirrors", "no", "0.5 ± 0.2", ""], ["glass", "yes", "", "12\u202f345"]]);

// Picture and what is beside it end at about the same height, with the plots below: at most 250 pixels of the window stay empty.
const expectNoEmptyColumn = async p => {
  const { picture, beside, plots } = await p.evaluate(() => Object.fromEntries([["picture", ".viewer"], ["beside", ".beside"], ["plots", ".plots"]].map(([name, of]) => {
    const { top, bottom, left, right } = document.querySelector(of).getBoundingClientRect();
    return [name, { top, bottom, left, right }];
  })));
  assert.ok(Math.abs(picture.bottom - beside.bottom) < 250, JSON.stringify([picture, beside]));
  assert.ok(plots.top >= Math.max(picture.bottom, beside.bottom) - 1 && plots.left <= picture.left && plots.right >= beside.right, JSON.stringify([picture, beside, plots]));
};

// Many bounces: picture, strip and what steers them are in sight at once; the strip scrolls by itself, and what is shown stays in sight.
neumann("render", scene, "-D", "res=256", "-n", "17", "--spp", "4", "--method", "walk", "-o", at("many"), "--quiet");
const many = await browser.open(at("many/index.html"), { width: 1366, height: 768 });
await many.waitForSelector("body[data-ready]");
await drawn(many);
assert.deepEqual(await many.evaluate(() => [strip.tiles[1], strip.tiles[18]].map(t => "drawnAs" in t)), [true, false]);  // what is out of sight waits
for (const id of ["stage", "strip", "bounce", "play", "readout", "term", "sum", "view", "curve", "stops", "fit", "help-button"]) {
  const { y, height } = await many.locator(`#${id}`).boundingBox();
  assert.ok(y >= 0 && y + height <= 768, `${id} from ${y} to ${y + height}`);
}
assert.ok((await many.locator("#stage").boundingBox()).height > 345);
await expectNoSidewaysScroll(many);
await expectNoEmptyColumn(many);
await many.setViewportSize({ width: 1920, height: 1080 });
await settled(many);
await expectNoEmptyColumn(many);
// On paper nothing is wider than the page, plots have its width, no plot is cut and no heading stands alone.
await many.emulateMedia({ media: "print" });
await many.evaluate(() => dispatchEvent(new Event("beforeprint")));
await many.setViewportSize({ width: 680, height: 960 });
await settled(many);
await expectNoSidewaysScroll(many);
assert.deepEqual(await many.evaluate(() => [...new Set([...document.querySelectorAll(".plot")].map(e => getComputedStyle(e).breakInside).concat([...document.querySelectorAll("h2")].map(e => getComputedStyle(e).breakAfter)))]), ["avoid"]);
for (const id of ["stage", "energy", "error"]) {
  const { x, width } = await many.locator(`#${id}`).boundingBox();
  assert.ok(x >= 0 && x + width <= 680 && width > 600, `${id} from ${x}, ${width} wide`);
}
await many.evaluate(() => dispatchEvent(new Event("afterprint")));
await many.emulateMedia({ media: "screen" });
await many.setViewportSize({ width: 1366, height: 768 });
await settled(many);
const inStrip = i => many.evaluate(i => {
  const box = document.getElementById("strip").getBoundingClientRect(), tile = document.querySelectorAll("#strip button")[i].getBoundingClientRect();
  return tile.left >= box.left && tile.right <= box.right;
}, i);
assert.deepEqual([await inStrip(1), await inStrip(18)], [true, false]);
await many.keyboard.press("End");
await drawn(many);
assert.deepEqual([await inStrip(1), await inStrip(18)], [false, true]);
assert.ok(await many.evaluate(() => "drawnAs" in strip.tiles[18]));
assert.equal(await many.evaluate(() => scrollY), 0);

// On a phone nothing is wider than the screen, in either scheme.
for (const [name, scheme] of [["a", "light"], ["both", "dark"]]) {
  const phone = await browser.open(at(`${name}/index.html`), { width: 375, height: 720, scheme });
  await phone.waitForSelector("body[data-ready]");
  await phone.locator("#stage").click();
  await settled(phone);
  assert.match(await phone.locator("#readout").innerText(), /^Pixel \d+, \d+,/);
  await phone.locator("#in").click();
  await phone.locator("#whole").click();
  await phone.evaluate(() => scrollTo(0, 0));
  await expectNoSidewaysScroll(phone);
  // Two fingers that part from 40 to 120 pixels zoom three times, and what was between them stays there.
  const box = await phone.locator("#stage").boundingBox();
  const middle = { x: box.x + 0.4 * box.width, y: box.y + 0.5 * box.height };
  const between = () => phone.evaluate(({ clientX, clientY }) => pixelAt({ clientX, clientY }), { clientX: middle.x, clientY: middle.y });
  const touch = await phone.context().newCDPSession(phone);
  const fingers = apart => [-0.5, 0.5].map((part, id) => ({ x: middle.x + part * apart, y: middle.y, id }));
  const pixel = await between();
  await touch.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: fingers(40) });
  for (let apart = 50; apart <= 120; apart += 10) await touch.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: fingers(apart) });
  await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await settled(phone);
  expectClose(await phone.evaluate(() => state.zoom), 3, 0.01, "zoom of two fingers");
  assert.deepEqual(await between(), pixel);
  // A finger's tap chooses the pixel.
  await touch.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [middle] });
  await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await settled(phone);
  assert.deepEqual(await phone.evaluate(() => state.pixel), pixel);
}

// The weights of a mixture add up to white, to the rounding of ninths, and are the digits of run.json.
neumann("render", path.join(process.env.SCENES, "glossy-floor/glossy-floor.xml"), "-D", "res=32", "-n", "2", "--method", "mixed", "--spp", "64", "-o", at("mixed"), "--quiet");
{
  const { blocks, methods } = JSON.parse(readFileSync(at("mixed/run.json"))).samples.mixture, mixed = await browser.open(at("mixed/index.html"));
  await mixed.waitForSelector("body[data-ready]");
  const drawn = await mixed.locator(".weights canvas").evaluateAll(all => all.map(c => [...c.getContext("2d").getImageData(0, 0, c.width, c.height).data].filter((_, i) => i % 4 === 0)));
  assert.equal(drawn.length, 3 * methods.length);
  drawn.forEach((map, k) => assert.deepEqual(map, [...methods[Math.floor(k / 3)].weights_of_bounces[k % 3]].map(d => Math.round(d * 255 / 9))));
  for (let bounce = 0; bounce < 3; ++bounce)
    for (let block = 0; block < blocks[0] * blocks[1]; ++block) {
      const all = methods.reduce((sum, m) => sum + Number(m.weights_of_bounces[bounce][block]), 0);
      assert.ok(Math.abs(all - 9) <= methods.length / 2, `bounce ${bounce}, block ${block}: ${all} ninths`);
    }
  assert.ok((await mixed.locator("summary").allInnerTexts()).some(head => head.startsWith("What is mixed: ")));
  await mixed.close();
}

await browser.close();
assert.deepEqual(browser.complaints, []);
console.log("the explorer shows what the files say");
