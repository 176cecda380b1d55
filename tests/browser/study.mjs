// The page of a real study in a real browser.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { expectNoSidewaysScroll, neumann, openBrowser } from "./browser.mjs";

const folder = mkdtempSync(path.join(tmpdir(), "neumann-study-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
const scene = path.join(process.env.SCENES, "cornell-box/cornell-box.xml");
process.env.XDG_CACHE_HOME = folder;
neumann("study", scene, "-D", "res=8", "-n", "1", "--methods", "walk,bidirectional", "--samples", "4,8", "--repeats", "3", "--reference", "walk", "-o", folder, "--quiet");
const study = JSON.parse(readFileSync(path.join(folder, "study.json")));

const browser = await openBrowser();
const page = await browser.open(path.join(folder, "index.html"));
const points = await page.evaluate(() => charts.map(({ picture, chart }) => [String(picture.bounce), chart.data.datasets.filter(d => d.pointRadius).map(d => d.data.map(p => p.y))]));
for (const [bounce, sets] of points) {
  const picture = study.pictures.find(p => String(p.bounce) === bounce);
  sets.forEach((ys, m) => {
    const found = picture.methods.find(q => q.method === study.methods[m].name);
    assert.deepEqual(ys, found.points.map(p => p.rmse.value).filter(v => v > 0));
  });
}
const phone = await browser.open(path.join(folder, "index.html"), { width: 375, height: 720, scheme: "dark" });
await expectNoSidewaysScroll(phone);
await browser.close();
assert.deepEqual(browser.complaints, []);
console.log("the study's page shows what study.json says");
