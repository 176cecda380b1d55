// Plots for papers: a column wide (85 mm), letters of 8 points, curves that differ by marks and dashes, and so in grey, too.
#pragma once

#include "core/image/drawing.h"

#include <string>
#include <vector>

namespace neumann {

struct PlotPoint {
    double x, y;
    double low, high;  // of the bar; equal to y where there is none
};

struct PlotCurve {
    std::string name;
    std::vector<PlotPoint> points;
};

struct Plot {
    std::string x_label, y_label;
    bool x_is_whole;  // a whole number from 0, on a linear axis; otherwise logarithmic, as is y
    std::vector<PlotCurve> curves;
};

constexpr double column_width = 85.0 / 25.4 * 72.0;  // points

// Points that a logarithmic axis cannot show are left out, and bars end at the frame. A plot of one curve has no legend.
Drawing draw_plot(const Plot& plot);

// The drawing as an SVG file, its text as text; the names of groups are their titles.
std::string svg_of(const Drawing& drawing);

}  // namespace neumann
