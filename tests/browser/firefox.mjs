// Firefox, by WebDriver BiDi (https://w3c.github.io/webdriver-bidi), which it speaks itself: the pages of a render, with paths and
// while it is under way, and of a study.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { neumann, run } from "./browser.mjs";

const { ws: WebSocket } = createRequire(path.join(process.env.PLAYWRIGHT, "x.js"))("./lib/utilsBundle.js");
const folder = mkdtempSync(path.join(tmpdir(), "neumann-firefox-"));
let firefox;
process.on("exit", () => {
  firefox?.kill("SIGKILL");
  rmSync(folder, { recursive: true, force: true });
});
process.env.XDG_CACHE_HOME = folder;
const scene = path.join(process.env.SCENES, "cornell-box/cornell-box.xml"), at = file => path.join(folder, file);
neumann("render", scene, "-D", "res=24", "-n", "3", "--spp", "64", "--method", "walk", "-o", at("a"), "--quiet");
neumann("page", at("a"), "--paths", "10,12", "--files", "page", "--quiet");
neumann("study", scene, "-D", "res=24", "-n", "1", "--methods", "walk,light", "--samples", "4,12", "--repeats", "4", "--reference", "walk", "-o", at("s"), "--quiet");

// Firefox, with a profile of its own, and where it listens.
firefox = spawn(process.env.FIREFOX, ["--headless", "--no-remote", "--profile", mkdtempSync(at("profile-")), "--remote-debugging-port", "0"], { stdio: ["ignore", "ignore", "pipe"] });
const address = await new Promise((found, failed) => {
  let said = "";
  firefox.stderr.on("data", text => {
    said += text;
    const listening = said.match(/WebDriver BiDi listening on (ws:\/\/\S+)/);
    if (listening) found(listening[1]);
  });
  firefox.on("exit", code => failed(new Error(`Firefox ended with ${code}: ${said}`)));
});
const socket = new WebSocket(`${address}/session`), waiting = new Map(), complaints = [];
await new Promise((open, failed) => socket.on("open", open).on("error", failed));
socket.on("message", text => {
  const { id, result, error, message, method, params } = JSON.parse(text);
  if (id !== undefined) error ? waiting.get(id).failed(new Error(`${error}: ${message}`)) : waiting.get(id).done(result);
  else if (method === "log.entryAdded" && ["error", "warn"].includes(params.level)) complaints.push(params.text);
});
let sent = 0;
const send = (method, params = {}) => new Promise((done, failed) => {
  waiting.set(++sent, { done, failed });
  socket.send(JSON.stringify({ id: sent, method, params }));
});
await send("session.new", { capabilities: {} });
await send("session.subscribe", { events: ["log.entryAdded"] });
const { contexts: [{ context }] } = await send("browsingContext.getTree");
const open = file => send("browsingContext.navigate", { context, url: pathToFileURL(file).href, wait: "complete" });
// What an expression gives, through JSON.
const evaluate = async expression => {
  const { result, exceptionDetails } = await send("script.evaluate", {
    expression: `(async () => JSON.stringify(await (${expression})))()`, target: { context }, awaitPromise: true });
  if (exceptionDetails) throw new Error(exceptionDetails.text);
  return result.value === undefined ? undefined : JSON.parse(result.value);
};
const press = key => send("input.performActions", { context, actions: [{ type: "key", id: "keys", actions: [{ type: "keyDown", value: key }, { type: "keyUp", value: key }] }] });
const painted = `new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))`;

// A render: what was unpacked is what the files hold, and the picture is on the canvas.
await open(at("a/index.html"));
await evaluate(`new Promise(done => { const look = () => document.body.dataset.ready !== undefined ? done(true) : setTimeout(look, 20); look(); })`);
const exr = JSON.parse(run(process.env.PYTHON, path.join(path.dirname(new URL(import.meta.url).pathname), "pixels.py"), at("a")));
for (let i = 0; i <= 3; ++i) {
  const file = exr[`bounce_00${i}.exr`], n = file.R.length, largest = Math.max(...file.R, ...file.G, ...file.B);
  const { mean, errors } = await evaluate(`(() => { const s = all[0], ref = { i: ${i}, sum: false }, e = s.errors(ref); return { mean: [...s.mean(ref)], errors: Array.from({ length: 3 * s.pixels }, (_, p) => e(p)) }; })()`);
  ["R", "G", "B"].forEach((channel, c) => file[channel].forEach((value, p) => {
    const error = file[`stderr.${channel}`][p] ?? Infinity;
    assert.ok(Math.abs(mean[c * n + p] - value) <= 2 ** -11 * Math.abs(value) + largest * 2 ** -24 + (error < Infinity ? error / 16 : 0), `bounce ${i} ${channel} ${p}`);
    if (error < Infinity) assert.ok(Math.abs(errors[c * n + p] - error) <= .06 * error, `error of bounce ${i} ${channel} ${p}`);
  }));
}
const colours = () => evaluate(`(() => { const c = $("a"), d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data; return new Set(new Uint32Array(d.buffer)).size; })()`);
assert.ok(await colours() > 50);
assert.equal(await evaluate(`$("name").textContent`), "bounce 1: K Le");
await press("\uE014");  // arrow right
await evaluate(painted);
assert.match(await evaluate(`$("name").textContent`), /^bounce 2: /);
assert.ok(await colours() > 50);

// The paths of a pixel: those that replay tells, a line from above for each ray, and keys go through them.
assert.match(await evaluate(`$("paths-title").textContent`), /^Paths of pixel 10, 12, 64 samples$/);
const expectPath = async () => {
  const sample = await evaluate(`$("path").value`), told = JSON.parse(neumann("replay", at("a"), "--pixel", "10,12", "--sample", sample, "--json"));
  assert.deepEqual(await evaluate(`[...$("path-table").querySelectorAll("tr")].slice(1).map(row => row.cells[1].textContent)`), told.steps.map(s => s.ray));
  assert.equal(await evaluate(`document.querySelectorAll("#plan line.ink.ray").length`), told.steps.length);
  return sample;
};
const firstShown = await expectPath();
await press("j");
await evaluate(painted);
assert.notEqual(await expectPath(), firstShown);
assert.equal(await evaluate(`$("history-part").hidden`), false);

// A render under way: the page that waits becomes the explorer, fills, and in the end has what index.html has.
const render = spawn(process.env.NEUMANN, ["render", scene, "-D", "res=32", "-n", "3", "--method", "walk", "--time", "600", "-o", at("live"), "--live"], { stdio: ["ignore", "ignore", "pipe"] });
process.on("exit", () => render.kill("SIGKILL"));
const ended = new Promise(done => render.on("exit", done));
const server = await new Promise(found => {
  let said = "";
  render.stderr.on("data", text => {
    said += text;
    const at = said.match(/http:\/\/127\.0\.0\.1:\d+\//);
    if (at) found(at[0]);
  });
});
await send("browsingContext.navigate", { context, url: server, wait: "complete" });
const until = async condition => {
  for (let tries = 0; tries < 600; ++tries) {
    const holds = await evaluate(condition).catch(() => false);  // the page that waited loads itself anew
    if (holds) return holds;
    await new Promise(done => setTimeout(done, 100));
  }
  assert.fail(`not so after a minute: ${condition}`);
};
// The address, for until Firefox has another page it answers from the one before, which is ready, too.
const begun = await until(`location.href.startsWith("${server}") && document.body.dataset.ready !== undefined && all[0].run.samples.per_pixel`);
await evaluate(`(set({ i: 3, sum: true }), true)`);
await until(`all[0].run.samples.per_pixel >= 4 * ${begun}`);
assert.match(await evaluate(`$("so-far").textContent`), /^So far [\d\s]+ samples a pixel, .* left\.$/);
assert.deepEqual(await evaluate(`[state.i, state.sum]`), [3, true]);
render.kill("SIGINT");
assert.equal(await ended, 0);
await until(`$("so-far").textContent.startsWith("Finished.")`);
assert.equal(await evaluate(`all[0].run.samples.per_pixel`), JSON.parse(readFileSync(at("live/run.json"))).samples.per_pixel);

// R and T that one can touch: the room without its lamp is dark.
neumann("render", scene, "-D", "res=24", "-n", "2", "--spp", "16", "--touch", "--files", "tables", "-o", at("t"), "--quiet");
await open(at("t/touch.html"));
await until(`window.touched !== undefined`);
assert.ok(await evaluate(`touched.compute().means[2] > 0`));
await evaluate(`(touched.state.room.lamps[0] = [0, 0, 0], touched.frame(), true)`);
assert.deepEqual(await evaluate(`touched.compute().means.filter(m => m !== 0)`), []);

// A study: the verdict, the crops and the plots.
await open(at("s/index.html"));
const study = JSON.parse(readFileSync(at("s/study.json")));
await evaluate(`cropsShown.then(() => true)`);
assert.equal(await evaluate(`$("verdict").textContent`), study.verdict);
assert.equal(await evaluate(`document.querySelectorAll(".crops canvas").length`), study.crops.length * (1 + 2 * study.methods.length));
assert.deepEqual(await evaluate(`charts.map(c => c.chart.data.datasets.length)`), study.pictures.map(() => 1 + study.methods.length));

assert.deepEqual(complaints, []);
console.log("Firefox shows what the files hold");
process.exit();
