"use strict";
// Functions that all pages share: they make elements, numbers, tables and plots.
const $ = id => document.getElementById(id);
const element = (tag, text, name) => {
  const e = document.createElement(tag);
  if (text !== undefined) e.textContent = text;
  if (name) e.className = name;
  return e;
};
// A table of texts or elements. `textual`: the indices of the columns that hold text, which is aligned left.
const table = (head, rows, textual) => {
  const t = element("table"), line = (cells, tag) => {
    const tr = element("tr");
    cells.forEach((c, i) => {
      const cell = element(tag, undefined, textual.includes(i) ? "text" : "");
      cell.append(c);
      tr.append(cell);
    });
    t.append(tr);
  };
  line(head, "th");
  rows.forEach(r => line(r, "td"));
  return t;
};
const facts = (id, rows) => rows.forEach(([a, b]) => {
  const tr = element("tr"), td = element("td");
  tr.append(element("td", a), td);
  td.append(b);
  $(id).append(tr);
});
const superscript = n => [...String(n)].map(c => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("");
const number = (x, digits = 3) => {
  if (x === null || x === undefined) return "–";
  if (x === 0) return "0";
  if (!Number.isFinite(x)) return "unknown";
  const a = Math.abs(x);
  if (a >= 1e-3 && a < 1e5) return String(+x.toPrecision(digits));
  const [m, e] = x.toExponential(digits - 1).split("e");
  return m + "·10" + superscript(+e);
};
const whole = n => String(n).replace(/\B(?=(\d{3})+$)/g, "\u202f");
// Turns "W m^-2 sr^-1" into W·m⁻²·sr⁻¹.
const unitText = unit => unit.replace(/\^(-?\d+)/g, (_, n) => superscript(n)).replaceAll(" ", "·");

// The colours of Okabe and Ito, with the colour of the page's text in place of their black, which a dark page would hide. Series of
// a plot also differ by mark and dash.
const color = name => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
const colors = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "text", "#8a6d00"];
const marks = ["circle", "triangle", "rect", "rectRot", "crossRot", "star", "cross", "rectRounded"];
const dashes = [[], [7, 4], [2, 3], [9, 3, 2, 3], [14, 4], [4, 2, 1, 2]];
const style = i => ({ color: colors[i % 8] === "text" ? color("text") : colors[i % 8], mark: marks[(i + (i >> 3)) % 8], dash: dashes[i % 6] });

// Draws error bars while shown() is true: vertical ones of points with `low` and `high`, horizontal ones of points with `xError`. A
// bar whose `low` is 0 or less goes down to the edge, because the axis is logarithmic.
const intervals = shown => ({
  id: "intervals",
  afterDatasetsDraw(chart) {
    if (!shown()) return;
    const { ctx, scales: { x, y }, chartArea: area } = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(area.left, area.top, area.right - area.left, area.bottom - area.top);
    ctx.clip();
    for (const set of chart.data.datasets) {
      ctx.strokeStyle = set.borderColor;
      ctx.lineWidth = 1.2;
      for (const p of set.data) {
        if (p.high === undefined) continue;
        const at = x.getPixelForValue(p.x), low = p.low > 0 ? y.getPixelForValue(p.low) : area.bottom, high = y.getPixelForValue(p.high);
        ctx.beginPath();
        ctx.moveTo(at, low);
        ctx.lineTo(at, high);
        for (const end of [low, high]) { ctx.moveTo(at - 4, end); ctx.lineTo(at + 4, end); }
        if (p.xError > 0 && p.xError < p.x) {
          const level = y.getPixelForValue(p.y);
          ctx.moveTo(x.getPixelForValue(p.x - p.xError), level);
          ctx.lineTo(x.getPixelForValue(p.x + p.xError), level);
        }
        ctx.stroke();
      }
    }
    ctx.restore();
  }
});
const logAxis = title => ({
  type: "logarithmic",
  title: { display: true, text: title, color: () => color("text") },
  grid: { color: c => Number.isInteger(+Math.log10(c.tick.value).toFixed(6)) ? color("line") + "90" : color("faint") + "90" },
  ticks: { autoSkip: false, maxRotation: 0, color: () => color("dim"), callback(value) {
    const decades = Math.log10(this.max / this.min), exponent = Math.floor(Math.log10(value) + 1e-9), first = value / 10 ** exponent;
    if (decades > 8 && exponent % Math.ceil(decades / 8) !== 0) return "";
    if (Math.abs(exponent) > 3 && Math.abs(first - 1) < 1e-6) return "10" + superscript(exponent);
    return (decades < 2.2 ? [1, 2, 5] : [1]).some(n => Math.abs(first - n) < 1e-6) ? number(value, 1) : "";
  } }
});
// Leaves a factor of 1.35 on both sides of the data, because the logarithmic axes of Chart.js end at the data otherwise.
const range = (axis, values) => {
  axis.display = values.length > 0;
  axis.min = values.length ? Math.min(...values) / 1.35 : undefined;
  axis.max = values.length ? Math.max(...values) * 1.35 : undefined;
};
// Writes into an empty plot why it is empty.
const whereEmpty = why => ({
  id: "where-empty",
  afterDraw(chart) {
    if (chart.data.datasets.some(set => set.data.length > 0)) return;
    const { ctx, chartArea: area } = chart;
    ctx.save();
    ctx.fillStyle = color("dim");
    ctx.font = "14px system-ui, sans-serif";
    ctx.textAlign = "center";
    ctx.fillText(why(), (area.left + area.right) / 2, (area.top + area.bottom) / 2);
    ctx.restore();
  }
});
