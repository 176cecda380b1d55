"use strict";
// A plot as an SVG drawing, and as a CSV table. Drawings have a white background even if the page is dark.

const ink = of => {
  const onWhite = { text: "#111111", dim: "#555555", line: "#8a8a8a", faint: "#dddddd", back: "#ffffff" };
  return onWhite[Object.keys(onWhite).find(name => color(name) === of)] ?? of;
};
const escaped = text => String(text).replace(/[&<>"]/g, c => `&#${c.charCodeAt(0)};`);
const shapes = {  // of marks: SVG paths around the origin, in pixels
  triangle: "M0-4.5 4 3H-4Z", rect: "M-3.5-3.5H3.5V3.5H-3.5Z", rectRot: "M0-4.5 4.5 0 0 4.5-4.5 0Z",
  crossRot: "M-3.5-3.5 3.5 3.5M-3.5 3.5 3.5-3.5", cross: "M-4.5 0H4.5M0-4.5V4.5", star: "M-4.5 0H4.5M0-4.5V4.5M-3.2-3.2 3.2 3.2M-3.2 3.2 3.2-3.2",
  rectRounded: "M-2-4H2A2 2 0 0 1 4-2V2A2 2 0 0 1 2 4H-2A2 2 0 0 1-4 2V-2A2 2 0 0 1-2-4Z", circle: "M-4 0A4 4 0 1 0 4 0 4 4 0 1 0-4 0Z"
};
const svgPlot = chart => {
  const { scales: { x, y }, chartArea: area, width, height, legend } = chart, out = [], round = v => +v.toFixed(2);
  const text = (words, at, top, more = "") => out.push(`<text x="${round(at)}" y="${round(top)}" ${more}>${escaped(words)}</text>`);
  const path = (d, stroke, more = "") => out.push(`<path d="${d}" stroke="${ink(stroke)}" fill="none" ${more}/>`);
  const mark = (set, at, top) => set.pointRadius > 0 && out.push(`<path class="mark" transform="translate(${at} ${top})" d="${shapes[set.pointStyle] ?? shapes.circle}" fill="${ink(set.pointBackgroundColor ?? set.backgroundColor)}" stroke="${ink(set.borderColor)}"/>`);
  const [middleX, middleY] = [(area.left + area.right) / 2, (area.top + area.bottom) / 2];
  for (const [axis, isX] of [[x, true], [y, false]]) for (const tick of axis.ticks) {
    const at = round(axis.getPixelForValue(tick.value)), label = Array.isArray(tick.label) ? tick.label.join(" ") : tick.label ?? "";
    if (label === "") continue;
    path(isX ? `M${at} ${area.bottom}v5` : `M${area.left} ${at}H${area.right}`, isX ? "#8a8a8a" : "#dddddd");
    isX ? text(label, at, area.bottom + 18, 'text-anchor="middle" class="x"') : text(label, area.left - 6, at + 4, 'text-anchor="end" class="y"');
  }
  path(`M${area.left} ${area.top}V${area.bottom}H${area.right}`, "#8a8a8a");
  const { title } = chart.options.plugins;
  if (title && title.display) text(title.text, middleX, chart.titleBlock.bottom - 8, 'text-anchor="middle" font-weight="bold"');
  text(x.options.title.text, middleX, area.bottom + 38, 'text-anchor="middle"');
  text(y.options.title.text, 12, middleY, `text-anchor="middle" transform="rotate(-90 12 ${round(middleY)})"`);
  out.push(`<clipPath id="area"><rect x="${area.left}" y="${area.top}" width="${area.right - area.left}" height="${area.bottom - area.top}"/></clipPath><g clip-path="url(#area)">`);
  const inOrder = [...chart.data.datasets].sort((a, b) => (b.order ?? 0) - (a.order ?? 0));
  for (const set of inOrder) {
    const place = p => [x.getPixelForValue(p.x), y.getPixelForValue(p.y)].map(round);
    out.push(`<g class="series"><title>${escaped(set.label)}</title>`);
    if (set.showLine && set.data.length > 1) path("M" + set.data.map(p => place(p).join(" ")).join("L"), set.borderColor, `stroke-width="${set.borderWidth}" stroke-dasharray="${(set.borderDash ?? []).join(" ")}"`);
    for (const p of set.data) {
      const [at, top] = place(p);
      if (p.high !== undefined) path(`M${at} ${round(y.getPixelForValue(p.high))}V${round(p.low > 0 ? y.getPixelForValue(p.low) : area.bottom)}`, set.borderColor);
      mark(set, at, top);
    }
    out.push("</g>");
  }
  out.push("</g>");
  legend.legendItems.forEach((item, k) => {
    const { left, top, height } = legend.legendHitBoxes[k], set = chart.data.datasets[item.datasetIndex], level = round(top + height / 2);
    if (set.showLine) path(`M${left - 2} ${level}h16`, set.borderColor, `stroke-width="2" stroke-dasharray="${(set.borderDash ?? []).join(" ")}"`);
    mark(set, round(left + 6), level);
    text(item.text, left + 18, level + 4);
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="12" fill="#111111"><rect width="100%" height="100%" fill="#ffffff"/>\n${out.join("\n")}\n</svg>\n`;
};

// All points of a plot as CSV, including those that a logarithmic axis cannot show.
const csvPlot = chart => {
  const { x, y } = chart.scales, rows = chart.data.datasets.flatMap(set => (set.all ?? []).map(p => [set.label || p.label, p.bounce ?? p.x, p.y, p.half]));
  return csvOf([["series", x.options.title.text, y.options.title.text, "half of the 95% interval"], ...rows]);
};
