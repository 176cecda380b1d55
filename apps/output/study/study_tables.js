"use strict";
// The tables: a ranking for each bounce, and the costs of the runs.

$("ranking-note").textContent = "At the largest budget, by 1/(MSE·T), which counts bias; T is the time of a run with all its bounces and its set-up. " +
  "± are 95% intervals. bias² is signed: MSE − variance; bold where it is above 0 at 99.9%.";
const withError = (e, f = 1.96) => e && e.value !== null ? `${number(e.value)} ± ${number(f * e.standard_error, 2)}` : "–";
const slope = s => s ? `${s.value.toFixed(3)} ± ${s.interval95 === null ? "?" : s.interval95.toFixed(3)}` : "–";
for (const p of [study.pictures[study.pictures.length - 1], ...study.pictures.slice(0, -1)]) {
  $("ranking").append(element("h3", `${pictureTitle(p)}`), element("div",
    `rms of the reference ${number(p.reference_rms)}, its noise ${p.reference_noise_subtracted > 0 ? number(p.reference_noise_subtracted) + " (subtracted)" : "none"}; the given error is an RMSE of ${number(p.given_error)}`, "note"));
  const rows = p.methods.map(m => {
    const last = m.points[m.points.length - 1], bias = element(last.bias_squared.significant ? "b" : "span",
      last.bias_squared.interval95 === null ? number(last.bias_squared.value) : `${number(last.bias_squared.value)} ± ${number(last.bias_squared.interval95, 2)}`);
    return [m.rank, m.method + (m.infinite_variance ? " (infinite variance)" : ""), last.resolved || (last.rmse.value === 0 && last.rmse.standard_error === 0) ? withError(last.rmse) : "below noise", bias,
            number(last.rel_mse.value), number(last.seconds.value) + (last.missed_budget ? ` for ${number(last.budget)}` : ""), number(last.efficiency_with_bias), m.infinite_variance ? "none" : number(last.efficiency),
            m.seconds_to_error ? (m.seconds_to_error.or_less ? "< " : "") + number(m.seconds_to_error.seconds) : "not reached",
            slope(m.slope), slope(m.slope_by_samples)];
  });
  const wide = element("div", undefined, "wide");
  const made = table(["", "method", "RMSE", "bias²", "relMSE", "T / s", "1/(MSE·T)", "1/(V·T)", "s to the given error", "slope in time", "slope in samples"], rows, [1]);
  wide.append(made);
  $("ranking").append(wide, savesOf(made, `ranking-${p.bounce === "sum" ? "sum" : `bounce-${p.bounce}`}`, `ranking, ${pictureTitle(p)}`, [1]));
}
const costRows = [];
study.methods.forEach(method => {
  const found = sumOf(method.name);
  if (found) found.points.forEach(p => costRows.push([method.name, number(p.samples, 9), p.patches ?? "", p.directions ?? "", withError(p.setup_seconds),
    withError(p.sampling_seconds), number(p.rays), number(p.rays / p.seconds.value), megabytes(p.peak_memory),
    p.discretisation_as_estimated_by_the_method === undefined ? "" : number(100 * p.discretisation_as_estimated_by_the_method, 2) + "%"]));
});
const costs = table(["method", "samples a pixel", "patches", "rays of a side", "set-up / s", "sampling / s", "rays of a run", "rays a second", "peak memory",
                     "own estimate of discretisation"], costRows, [0]);
$("costs").append(costs);
$("repeating").append(savesOf(costs, "costs", "set-up, rays and memory", [0]), element("p", `Peak memory: ${study.peak_memory}.`, "note"));
const repeats = element("p", "The first run of each method again, as pictures:", "note");
$("repeating").append(repeats);
study.methods.forEach(m => { if (m.repeat_the_first_run) { const p = element("div"); p.append(element("code", m.repeat_the_first_run)); $("repeating").append(p); } });
