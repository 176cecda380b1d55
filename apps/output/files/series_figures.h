// Figures and a table of a rendered series, for papers.
#pragma once

#include "apps/output/figures/plot.h"
#include "apps/output/files/output_folder.h"
#include "operators/render/report/series_report.h"

namespace neumann {

// Writes NAME.svg and NAME.pdf.
void write_figure(OutputFolder& folder, const std::string& name, const Plot& plot);

// Writes figure-decay.svg, figure-decay.pdf and series.tex: the figures of series.csv.
void write_figures(OutputFolder& folder, const SeriesReport& report);

}  // namespace neumann
