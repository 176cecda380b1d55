// Chromium, driven by playwright-core, and what the tests of pages want of it.
import { createRequire } from "node:module";
import { spawnSync } from "node:child_process";
import assert from "node:assert/strict";
import path from "node:path";
import { pathToFileURL } from "node:url";

const { chromium } = createRequire(path.join(process.env.PLAYWRIGHT, "x.js"))(".");

// Runs a program and returns what it prints.
export const run = (program, ...args) => {
  const done = spawnSync(program, args, { encoding: "utf8", maxBuffer: 1 << 28 });
  assert.equal(done.status, 0, `${program} ${args.join(" ")}: ${done.error ?? done.stderr}`);
  return done.stdout;
};
export const neumann = (...args) => run(process.env.NEUMANN, ...args);

// Opens pages in one browser. A page that asks for anything but itself, or complains, fails the test at the end.
export const openBrowser = async () => {
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM, args: ["--no-sandbox"] });
  const complaints = [];
  return {
    complaints,
    close: () => browser.close(),
    // What printing a page into a PDF file gives, a byte a character.
    async pdf(html) {
      const page = await browser.newPage();
      await page.setContent(html);
      const file = await page.pdf({ preferCSSPageSize: true, printBackground: true });
      await page.close();
      return file.toString("latin1");
    },
    open(file, { hash = "", ...how } = {}) { return this.visit(pathToFileURL(file).href, { hash, alone: true, ...how }); },
    // `alone`: a page that asks for nothing but itself; otherwise only its own server is asked.
    async visit(url, { width = 1280, height = 900, scheme = "light", hash = "", alone = false } = {}) {
      const page = await browser.newPage({ viewport: { width, height }, colorScheme: scheme });
      page.setDefaultTimeout(120000);  // a machine that does much else
      page.on("request", r => { if (alone ? r.url().split("#")[0] !== url : !r.url().startsWith(url)) complaints.push(`asked for ${r.url()}`); });
      page.on("console", m => { if (["error", "warning"].includes(m.type())) complaints.push(m.text()); });
      page.on("pageerror", e => complaints.push(e.message));
      await page.goto(url + hash);
      return page;
    }
  };
};

// Nothing is wider than the window.
export const expectNoSidewaysScroll = async page => {
  const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(content <= window, `content of ${content} pixels in a window of ${window}`);
};

// Whatever can be operated has a name that a screen reader says.
export const expectNames = async page => {
  const nameless = await page.evaluate(() => [...document.querySelectorAll("button, input, select, [tabindex]")].filter(e =>
    !(e.getAttribute("aria-label") || e.textContent.trim() && e.tagName === "BUTTON" || [...(e.labels ?? [])].some(l => l.textContent.trim()))).map(e => e.outerHTML));
  assert.deepEqual(nameless, []);
};
