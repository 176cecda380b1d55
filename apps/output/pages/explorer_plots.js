"use strict";
// The plots beside the picture. Their datasets are computed from the state whenever it changes.

// Draws a vertical line through the bounce that is shown.
const here = at => ({
  id: "here",
  beforeDatasetsDraw(chart) {
    const { ctx, scales: { x }, chartArea: area } = chart, i = at();
    if (i === null) return;
    ctx.save();
    ctx.strokeStyle = color("accent");
    ctx.globalAlpha = .35;
    ctx.lineWidth = 9;
    ctx.beginPath();
    ctx.moveTo(x.getPixelForValue(i), area.top);
    ctx.lineTo(x.getPixelForValue(i), area.bottom);
    ctx.stroke();
    ctx.restore();
  }
});
const radianceOf = s => `${s.importance ? "importance" : "radiance"} / ${s.unit}`;
const positive = p => p.y > 0 && Number.isFinite(p.y);
// A dataset of Chart.js. Its `data` are the points with positive values, which a logarithmic axis can show; `all` keeps all points,
// for the CSV file.
const line = (label, all, colour, more = {}) => ({ label, all, data: all.filter(positive), showLine: true, borderColor: colour, backgroundColor: colour, borderWidth: 1.6, pointRadius: 0, pointHitRadius: 4, pointStyle: "line", ...more });
const dots = (label, data, colour, mark, more = {}) => line(label, data, colour, { pointStyle: mark, pointRadius: 4, pointHoverRadius: 6, pointHitRadius: 8, ...more });

// What a click on a plot chooses: what the point under it shows, or else the bounce at that place of an axis of bounces.
const chosenBy = ({ x, y }, found, chart, onBounce) => {
  const { left, right, top, bottom } = chart.chartArea, point = found.map(f => chart.data.datasets[f.datasetIndex].data[f.index]).find(p => p.shows);
  if (point) return () => { stop(); set(point.shows); };
  if (onBounce && x >= left && x <= right && y >= top && y <= bottom) return () => onBounce(chart.scales.x.getValueForPixel(x));
};
const plot = (id, xAxis, yTitle, plugins, onBounce) => new Chart($(id), {
  type: "scatter",
  data: { datasets: [] },
  options: {
    animation: false, maintainAspectRatio: false,
    scales: { x: xAxis, y: logAxis(yTitle) },
    onClick: (event, found, chart) => chosenBy(event, found, chart, onBounce)?.(),
    onHover: (event, found, chart) => { chart.canvas.style.cursor = chosenBy(event, found, chart, onBounce) ? "pointer" : ""; },
    plugins: {
      legend: { position: "bottom", labels: { usePointStyle: true, boxWidth: 8, boxHeight: 8, color: () => color("text"), filter: item => item.text !== "" } },
      tooltip: { callbacks: { label: item => [item.dataset.label || item.raw.label,
        number(item.raw.y) + (item.raw.half === undefined ? "" : ` ± ${number(item.raw.half, 2)}`) + (item.raw.note ? `, ${item.raw.note}` : "")] } }
    }
  },
  plugins
});
const bounceAxis = (last, hasRest) => ({
  type: "linear", min: -.5, max: last + (hasRest ? 1.5 : .5),
  title: { display: true, text: "bounce", color: () => color("text") },
  grid: { display: false },
  afterBuildTicks: axis => { axis.ticks = [...Array(last + (hasRest ? 2 : 1)).keys()].map(value => ({ value })); },
  ticks: { autoSkip: true, maxRotation: 0, color: () => color("dim"), callback: v => hasRest && v === last + 1 ? "rest" : v }
});
const point = (x, y, half, bounce = x) => ({ x, y, half, bounce, ...(half > 0 && Number.isFinite(half) ? { low: y - half, high: y + half } : {}) });
// The range of the values, without those of a set that may lie `beyond` the plot.
const fitRange = (chart, sets) => {
  const values = sets.filter(s => !s.beyond).flatMap(s => s.data).filter(positive).flatMap(p => [p.y, ...(p.high ? [p.high, Math.max(p.low, p.y / 3)] : [])]);
  range(chart.options.scales.y, values);
};

// The means of all bounces with error bars. For a single run, also the sum of the bounces after each, the bound on that sum, and
// the fitted decay.
const energySets = (all, names, restAt) => all.flatMap((s, r) => {
  const bounces = s.run.bounces, tag = names[r], { color: main } = style(r), dash = r ? { borderDash: dashes[r % dashes.length] } : {};
  const sets = [dots("mean" + tag, bounces.map((b, i) => point(i, b.mean, s.wholeMean({ i }).interval95)), main, marks[r % marks.length], dash)];
  if (s.hasRest) sets.push(dots("rest" + tag, [point(restAt, s.run.rest.mean, s.wholeMean({ i: s.last + 1 }).interval95, "rest")], main, "rectRot", { showLine: false }));
  if (all.length > 1) return sets;
  if (s.decay) {
    const { ratio, log_at_0, first, last } = s.decay;
    sets.push(line(`fitted decay: × ${number(ratio)} a bounce`, [first - .4, last + .4].map(x => ({ x, y: Math.exp(log_at_0) * ratio ** x })), colors[1], { borderDash: dashes[1], borderWidth: 2.5 }));
  }
  if (s.hasRest) {
    let after = s.run.rest.mean;
    const follow = bounces.map(b => b.mean).reverse().map((mean, k) => { const y = after; after += mean; return { x: s.last - k, y }; }).reverse();
    sets.push(line("all that follows", follow, colors[2]));
  }
  const bound = bounces.map((b, i) => ({ x: i, y: b.tail_bound })).filter(positive), highest = Math.max(...sets.flatMap(set => set.data.map(p => p.y)));
  const where = bound.length && bound.every(p => p.y > highest) ? `: ${number(bound[0].y)} to ${number(bound.at(-1).y)}, above the plot` : "";
  sets.push(line("bound on all that follows" + where, bound, color("dim"), { borderDash: dashes[2], beyond: true }));
  return sets.filter(set => set.data.length > 0);
});

const channelColours = () => ["#d55e00", "#009e73", matchMedia("(prefers-color-scheme: dark)").matches ? "#56b4e9" : "#0072b2"];
const pixelSets = (all, names, p, sum, restAt) => all.flatMap((s, r) => ["red", "green", "blue"].map((name, c) => {
  const data = [];
  for (let i = 0; i <= s.last + (s.hasRest && !sum ? 1 : 0); ++i) {
    const ref = { i, sum };
    if (s.isLoaded(ref)) data.push(point((i > s.last ? restAt : i) + (c - 1) * .06, s.meanAt(ref, p + c * s.pixels), s.halfInterval(ref, p + c * s.pixels), i > s.last ? "rest" : i));
  }
  return dots(name + names[r], data, channelColours()[c], marks[c], r ? { borderDash: dashes[1], pointBackgroundColor: color("back") } : {});
}));

// Chart.js draws datasets of a higher order first. A curve that is not the chosen one lies behind, and can be clicked.
const behind = { order: 1, pointHitRadius: 8 };
const errorSets = (all, names, i) => all.flatMap((s, r) => {
  const rows = s.convergence, dash = r ? { borderDash: dashes[1] } : {};
  const of = key => rows.map(row => ({ x: row.seconds, y: row[key], note: `${row.samples} samples a pixel in ${number(row.seconds)} s` })).filter(p => p.x > 0 && positive(p));
  const key = k => String(k).padStart(3, "0");
  const sets = [];
  for (let k = 0; k <= s.last; ++k) if (k !== i) {
    const points = of(`relative_stderr_${key(k)}`).map(p => ({ ...p, label: `bounce ${k}${names[r]}`, shows: { run: r, i: k, sum: false } }));
    sets.push(points.length === 1 ? dots("", points, color("line"), "circle", { pointRadius: 2, ...behind }) : line("", points, color("faint"), { ...dash, ...behind }));
  }
  if (i <= s.last) sets.push(dots(`bounce ${i}${names[r]}`, of(`relative_stderr_${key(i)}`), style(0).color, "circle", dash));
  sets.push(dots("sum" + names[r], of("relative_stderr_sum").map(p => ({ ...p, shows: { run: r, i: s.last, sum: true } })), color("text"), "rect", dash));
  if (rows.length && "relative_error_sum" in rows[0]) {
    if (i <= s.last) sets.push(dots(`bounce ${i}, true error${names[r]}`, of(`relative_error_${key(i)}`), colors[1], "triangle", { borderDash: dashes[2] }));
    sets.push(dots("sum, true error" + names[r], of("relative_error_sum"), colors[3], "rectRot", { borderDash: dashes[2] }));
  }
  return sets.filter(set => set.data.length > 0);
});
const slopeGuide = sets => {
  const all = sets.filter(s => s.label && s.data.length > 1).flatMap(s => s.data);
  if (all.length === 0) return [];
  const mean = f => Math.exp(all.reduce((a, p) => a + Math.log(f(p)), 0) / all.length), xs = all.map(p => p.x);
  const x0 = mean(p => p.x), y0 = mean(p => p.y);
  return [line("slope −1/2", [Math.min(...xs), Math.max(...xs)].map(x => ({ x, y: y0 * Math.sqrt(x0 / x) })), color("line"), { borderWidth: 1, borderDash: dashes[5], pointHitRadius: 0 })];
};
