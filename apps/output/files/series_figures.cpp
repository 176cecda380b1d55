#include "apps/output/files/series_figures.h"

#include "apps/output/figures/latex_table.h"

#include <fmt/format.h>

#include <limits>

namespace neumann {

namespace {

const char* quantity(const SeriesReport& report) { return report.importance ? "mean importance" : "mean radiance"; }

Plot decay(const SeriesReport& report) {
    const char* unit = report.importance ? "m⁻² sr⁻¹" : "W m⁻² sr⁻¹";
    Plot plot{"bounce", fmt::format("{} / {}", quantity(report), unit), true, {{quantity(report), {}}}};
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        const BounceReport& bounce = report.bounces[i];
        const double mean = bounce.mean.mean;
        const double half = bounce.infinite_variance ? std::numeric_limits<double>::infinity() : bounce.mean.interval();
        plot.curves[0].points.push_back({static_cast<double>(i), mean, mean - half, mean + half});
    }
    return plot;
}

std::string table(const SeriesReport& report) {
    const bool discretised = report.sum_discretisation.has_value();
    std::vector<std::string> head{"bounce", quantity(report), "ratio", "bound on the rest"};
    if (discretised) head.emplace_back("discretisation");
    head.emplace_back("rays");
    std::vector<std::vector<std::string>> rows;
    for (std::size_t i = 0; i < report.bounces.size(); ++i) {
        const BounceReport& b = report.bounces[i];
        const double error = b.infinite_variance ? std::numeric_limits<double>::infinity() : b.mean.standard_error;
        std::vector<std::string>& row = rows.emplace_back();
        row.push_back(std::to_string(i));
        row.push_back(b.unmet ? "$\\le$ " + latex_number(b.mean.interval(), 2) : latex_with_error(b.mean.mean, error));
        row.push_back(b.ratio ? latex_number(*b.ratio, 3) : "--");
        row.push_back(latex_number(b.bound, 3));
        if (discretised) row.push_back(b.discretisation ? latex_number(b.discretisation->mean, 2) : "--");
        row.push_back(std::to_string(b.rays));
    }
    return latex_table(discretised ? "rrrrrr" : "rrrrr", head, rows, "in brackets the standard error, in units of the last digit");
}

}  // namespace

void write_figure(OutputFolder& folder, const std::string& name, const Plot& plot) {
    const Drawing drawing = draw_plot(plot);
    folder.write(name + ".svg", svg_of(drawing));
    folder.write(name + ".pdf", encode_pdf(drawing));
}

void write_figures(OutputFolder& folder, const SeriesReport& report) {
    write_figure(folder, "figure-decay", decay(report));
    folder.write("series.tex", table(report));
}

}  // namespace neumann
