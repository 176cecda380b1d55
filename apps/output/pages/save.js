"use strict";
// Saves parts of a page as files: drawings, and tables for spreadsheets and papers.

const save = (name, blob) => {
  const link = element("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
};
const button = (text, name, onclick) => {
  const b = element("button", text);
  b.setAttribute("aria-label", name);
  b.onclick = onclick;
  return b;
};

// Puts a drawing on a sheet of its own size. Printed into a PDF file by the browser, its text can still be selected, and its lines
// are not pixels.
const printable = (name, svg) => {
  const [, width, height] = svg.match(/<svg[^>]* width="([\d.]+)" height="([\d.]+)"/);
  return `<!DOCTYPE html><meta charset="utf-8"><title>${name}</title><style>@page { size: ${width}px ${height}px; margin: 0 } body { margin: 0 } svg { display: block }</style>${svg}`;
};
const print = (name, svg) => {
  const frame = element("iframe");
  frame.style.cssText = "position: fixed; width: 0; height: 0; border: 0";
  frame.srcdoc = printable(name, svg);
  frame.onload = () => {
    frame.contentWindow.onafterprint = () => frame.remove();
    frame.contentWindow.print();
  };
  document.body.append(frame);
};

const cell = v => /[",\n]/.test(v) ? `"${String(v).replaceAll('"', '""')}"` : v ?? "";
const csvOf = rows => rows.map(row => row.map(cell).join(",") + "\n").join("");

// Rows as a LaTeX table with the package booktabs (https://ctan.org/pkg/booktabs). The first row is the head. `textual`: the
// indices of the columns that hold text.
const latexSigns = { "-": "$-$", "\\": "\\textbackslash{}", "~": "\\textasciitilde{}", "^": "\\textasciicircum{}", "±": "$\\pm$", "·": "$\\cdot$", "−": "$-$", "–": "--", "√": "$\\surd$",
                     "×": "$\\times$", "≈": "$\\approx$", "≤": "$\\le$", "∞": "$\\infty$", "<": "$<$", ">": "$>$", "|": "$|$", "\u202f": "\\," };
const superscripts = "⁻⁰¹²³⁴⁵⁶⁷⁸⁹";
const latexText = text => String(text).replace(/(?<!\w)-(?=[\d.])|[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+|[#$%&_{}\\~^±·−–√×≈≤∞<>|\u202f]/g, s => latexSigns[s] ??
  (superscripts.includes(s[0]) ? `$^{${[...s].map(c => "-0123456789"[superscripts.indexOf(c)]).join("")}}$` : "\\" + s));
const latexOf = ([head, ...rows], textual) => {
  const line = row => row.map(latexText).join(" & ") + " \\\\";
  return ["% \\usepackage{booktabs}", `\\begin{tabular}{${head.map((_, c) => textual.includes(c) ? "l" : "r").join("")}}`, "\\toprule", line(head), "\\midrule",
          ...rows.map(line), "\\bottomrule", "\\end{tabular}"].join("\n") + "\n";
};

const savingPlot = (name, what, svg, csv) => [
  button("SVG", `Save the plot: ${what}, SVG`, () => save(name + ".svg", new Blob([svg()], { type: "image/svg+xml" }))),
  button("PDF", `Print the plot: ${what}, into a PDF file`, () => print(name, svg())),
  button("CSV", `Save the figures: ${what}, CSV`, () => save(name + ".csv", new Blob([csv()], { type: "text/csv" })))];
const savingTable = (name, what, rows, textual) => [
  button("CSV", `Save the table: ${what}, CSV`, () => save(name + ".csv", new Blob([csvOf(rows)], { type: "text/csv" }))),
  button("LaTeX", `Save the table: ${what}, LaTeX`, () => save(name + ".tex", new Blob([latexOf(rows, textual)], { type: "text/plain" })))];
