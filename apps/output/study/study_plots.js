"use strict";
// Plots of error against work, one for each bounce and one for the sum.

const shown = study.methods.map(() => true);

const xTitles = { seconds: "seconds of a run, with set-up", sampling_seconds: "seconds of sampling", samples: "samples a pixel", rays: "rays of a run" };
const yTitles = { rmse: "RMSE", rel_rmse: "√relMSE", deviation: "√variance", bias: "√bias²" };
const root = (square, error) => {
  if (!(square > 0)) return null;
  const low = square - error;
  return { y: Math.sqrt(square), low: low > 0 ? Math.sqrt(low) : 0, high: Math.sqrt(square + error) };
};
const yOf = p => {
  switch ($("y").value) {
    case "rmse": return root(p.rmse.value ** 2, 2 * p.rmse.value * 1.96 * p.rmse.standard_error);
    case "rel_rmse": return root(p.rel_mse.value, 1.96 * p.rel_mse.standard_error);
    case "deviation": return root(p.variance.value, 1.96 * p.variance.standard_error);
    default: return p.bias_squared.significant ? root(p.bias_squared.value, p.bias_squared.interval95) : null;
  }
};
const xOf = (p, whole) => {
  const key = $("x").value;
  if (key === "samples") return { x: p.samples, error: 0 };
  if (key === "rays") return { x: whole.rays, error: 0 };
  return { x: p[key].value, error: 1.96 * p[key].standard_error };
};
const datasetsOf = picture => {
  const sets = study.methods.map((method, i) => {
    const found = picture.methods.find(m => m.method === method.name), s = style(i), data = [];
    if (found && shown[i]) found.points.forEach((p, b) => {
      const y = yOf(p), x = xOf(p, sumOf(method.name).points[b]);
      if (y && x.x > 0) data.push({ x: x.x, xError: x.error, ...y, point: p });
    });
    return { label: method.name, data, all: data.map(p => ({ x: p.x, y: p.y, half: (p.high - p.low) / 2 })), showLine: true, borderColor: s.color, backgroundColor: s.color, borderDash: s.dash, borderWidth: 1.6,
             pointStyle: s.mark, pointRadius: 5, pointBorderWidth: 1.6, pointHoverRadius: 7 };
  });
  const all = sets.flatMap(s => s.data);
  if ($("guide").checked && all.length > 1 && $("y").value !== "bias" ) {
    const mean = f => Math.exp(all.reduce((a, p) => a + Math.log(f(p)), 0) / all.length);
    const least = Math.min(...all.map(p => p.x)), most = Math.max(...all.map(p => p.x)), x0 = mean(p => p.x), y0 = mean(p => p.y);
    sets.push({ label: "slope −1/2", data: [least, most].map(x => ({ x, y: y0 * Math.sqrt(x0 / x) })), showLine: true, borderColor: color("line"),
                borderWidth: 1, pointRadius: 0, pointHitRadius: 0 });
  }
  return sets;
};
// A plot as SVG, with a legend of its own: the page has one legend for all plots.
const drawing = chart => {
  const { legend } = chart.options.plugins;
  legend.display = true;
  chart.update();
  const svg = svgPlot(chart);
  legend.display = false;
  chart.update();
  return svg;
};
const charts = study.pictures.map(picture => {
  const isSum = picture.bounce === "sum" || picture.bounce === study.verdict_on, cell = element("div", undefined, isSum ? "sum" : ""), holder = element("div", undefined, "plot"), canvas = element("canvas");
  holder.append(canvas);
  cell.append(holder);
  if (isSum) $("plots").prepend(cell); else $("plots").append(cell);
  const chart = new Chart(canvas, {
    type: "scatter",
    data: { datasets: [] },
    options: {
      animation: false, maintainAspectRatio: false,
      scales: { x: logAxis(""), y: logAxis("") },
      plugins: {
        legend: { display: false },
        title: { display: true, text: pictureTitle(picture), font: { size: 14 }, color: () => color("text") },
        tooltip: { callbacks: { label: item => {
          const p = item.raw.point;
          return p ? [item.dataset.label, `${yTitles[$("y").value]} ${number(item.raw.y)} at ${number(item.raw.x)}`, `${p.samples} samples a pixel` + (p.patches ? `, ${p.patches} patches, ${p.directions} rays` : "")] : item.dataset.label;
        } } }
      }
    },
    plugins: [intervals(() => $("bars").checked), whereEmpty(() => $("y").value === "bias" ? "no bias² above 0 at 99.9%" : "nothing above 0")]
  });
  const saves = element("div", undefined, "line saves");
  saves.append(...savingPlot(`${$("y").value}-${picture.bounce === "sum" ? "sum" : `bounce-${picture.bounce}`}`, pictureTitle(picture), () => drawing(chart), () => csvPlot(chart)));
  cell.append(saves);
  return { picture, chart };
});
const draw = () => {
  for (const { picture, chart } of charts) {
    chart.data.datasets = datasetsOf(picture);
    const points = chart.data.datasets.filter(s => s.pointRadius !== 0).flatMap(s => s.data), { x, y } = chart.options.scales;
    range(x, points.map(p => p.x));
    range(y, points.flatMap(p => [p.y, p.high, Math.max(p.low, p.y / 3)]));
    x.title.text = xTitles[$("x").value];
    y.title.text = yTitles[$("y").value] + ($("y").value === "rel_rmse" ? "" : " / W m⁻² sr⁻¹");
    chart.update();
  }
  $("note").textContent = {
    rmse: "Against the reference, its noise subtracted. Points where the noise is larger than the error have bars down to the edge.",
    rel_rmse: "Against the reference, its noise subtracted.",
    deviation: "Spread from repeat to repeat, whatever the reference.",
    bias: "Only where bias² is above 0 at 99.9%. Of fields on patches it is the discretisation, of photon maps the blur, of a cache the interpolation." }[$("y").value];
};
const drawLegend = () => $("legend").replaceChildren(...study.methods.map((method, i) => {
  const s = style(i), label = element("label"), box = element("input"), sample = element("canvas");
  box.type = "checkbox";
  box.checked = shown[i];
  box.onchange = () => { shown[i] = box.checked; draw(); };
  sample.width = 56; sample.height = 16;
  const ctx = sample.getContext("2d");
  ctx.strokeStyle = ctx.fillStyle = s.color;
  ctx.lineWidth = 1.6;
  ctx.setLineDash(s.dash);
  ctx.beginPath(); ctx.moveTo(0, 8); ctx.lineTo(56, 8); ctx.stroke();
  ctx.setLineDash([]);
  Chart.helpers.drawPoint(ctx, { pointStyle: s.mark, radius: 5, borderWidth: 1.6 }, 28, 8);
  label.append(box, sample, method.name);
  return label;
}));
drawLegend();
matchMedia("(prefers-color-scheme: dark)").onchange = () => { drawLegend(); draw(); };
for (const id of ["x", "y", "bars", "guide"]) $(id).onchange = draw;
draw();
