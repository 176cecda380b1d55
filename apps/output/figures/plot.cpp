#include "apps/output/figures/plot.h"

#include "apps/output/figures/axis.h"
#include "core/image/image_io.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace neumann {

namespace {

constexpr double letters = 8.0, line = 11.0, frame_height = 140.0, mark_radius = 2.2, edge = 3.0;
constexpr Ink frame_ink{90, 90, 90};

// Of increasing lightness (L* 0 to 70, from the palette of Okabe and Ito), so that they differ in grey, too.
struct CurveStyle {
    Ink ink;
    std::vector<int> dashes;
};
CurveStyle style_of(std::size_t curve) {
    static const std::vector<Ink> inks{{0, 0, 0}, {0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}};
    static const std::vector<std::vector<int>> dashes{{}, {4, 2}, {1, 2}, {6, 2, 1, 2}};
    return {inks[curve % inks.size()], dashes[curve % dashes.size()]};
}

// The marks: polygons with 4, 3, 20 … corners, filled or as strokes from the middle.
std::vector<DrawnPath> mark(std::size_t curve, DrawnPoint at, const Ink& ink) {
    struct Shape {
        int corners;
        double turn;  // of the first corner from above, in degrees
        bool is_filled;
    };
    static const std::vector<Shape> shapes{{20, 0, true},  {4, 45, true}, {3, 0, true},  {4, 0, true}, {3, 180, true},
                                           {4, 45, false}, {4, 0, false}, {3, 0, false}, {5, 0, true}, {6, 0, false}};
    const Shape& shape = shapes[curve % shapes.size()];
    std::vector<DrawnPoint> corners;
    for (int i = 0; i < shape.corners; ++i) {
        const double angle = (shape.turn / 180.0 + 2.0 * i / shape.corners) * std::numbers::pi;
        corners.push_back({at.x + mark_radius * std::sin(angle), at.y - mark_radius * std::cos(angle)});
    }
    if (shape.is_filled) return {{corners, ink, 0.0}};
    std::vector<DrawnPath> strokes;
    for (const DrawnPoint& corner : corners) strokes.push_back({{at, corner}, ink, 0.8});
    return strokes;
}

double width_of(const std::string& text, double size) {
    static const std::optional<std::string> font = find_label_font();
    constexpr int measured = 100;
    return size / measured * (font ? text_width(text, measured, *font) : 0.6 * measured * static_cast<double>(text.size()));
}

// Where the curves and the labels are.
class Layout {
public:
    explicit Layout(const Plot& plot) : plot_(plot), x_(x_axis()), y_(y_axis()) {
        legend_size_ = letters;
        double widest = 0.0;
        for (const PlotCurve& curve : plot.curves) widest = std::max(widest, width_of(curve.name, letters));
        legend_columns_ = widest + sample_width < column_width / 2.0 - edge ? 2 : 1;
        const double most = column_width / static_cast<double>(legend_columns_) - sample_width - 2.0 * edge;
        if (widest > most) legend_size_ = letters * most / widest;
        if (plot.curves.size() > 1)
            top_ += line * std::ceil(static_cast<double>(plot.curves.size()) / static_cast<double>(legend_columns_));
        y_ticks_ = y_.ticks(line / frame_height);
        for (const Tick& tick : y_ticks_) left_ = std::max(left_, line + edge + width_of(tick.label, letters) + 2.0 * edge);
        x_ticks_ = x_.ticks((plot.x_is_whole ? 18.0 : 28.0) / (right_ - left_));
    }

    Drawing draw() const {
        Drawing drawing{column_width, bottom() + 2.0 * line + 2.0 * edge};
        drawing.groups.push_back(frame());
        for (std::size_t i = 0; i < plot_.curves.size(); ++i) drawing.groups.push_back(curve(i));
        if (plot_.curves.size() > 1) drawing.groups.push_back(legend());
        return drawing;
    }

private:
    static constexpr double sample_width = 26.0;  // of a curve in the legend

    bool is_shown(const PlotPoint& p) const {
        return std::isfinite(p.x) && std::isfinite(p.y) && p.y > 0.0 && (plot_.x_is_whole || p.x > 0.0);
    }

    Axis x_axis() const {
        const auto [least, most] = range([](const PlotPoint& p) { return std::pair(p.x, p.x); });
        return plot_.x_is_whole ? Axis::of_whole_numbers(most) : Axis::logarithmic(least, most);
    }
    Axis y_axis() const {
        const auto [least, most] =
            range([](const PlotPoint& p) { return std::pair(std::max(p.low, p.y / 3.0), std::isfinite(p.high) ? p.high : p.y); });
        return Axis::logarithmic(least, most);
    }
    template <class Function>
    std::pair<double, double> range(const Function& of) const {
        std::optional<std::pair<double, double>> found;
        for (const PlotCurve& curve : plot_.curves)
            for (const PlotPoint& p : curve.points) {
                if (!is_shown(p)) continue;
                const auto [low, high] = of(p);
                found = found ? std::pair(std::min(found->first, low), std::max(found->second, high)) : std::pair(low, high);
            }
        return found.value_or(std::pair(1.0, 1.0));
    }

    double bottom() const { return top_ + frame_height; }
    double right_of(double place) const { return left_ + place * (right_ - left_); }
    double level_of(double place) const { return bottom() - place * frame_height; }
    DrawnPoint at(double x, double y) const { return {right_of(x_.place(x)), level_of(std::clamp(y_.place(y), 0.0, 1.0))}; }

    DrawnGroup frame() const {
        DrawnGroup group;
        group.paths.push_back({{{left_, top_}, {right_, top_}, {right_, bottom()}, {left_, bottom()}, {left_, top_}}, frame_ink});
        for (const Tick& tick : x_ticks_) {
            const double x = right_of(x_.place(tick.value));
            group.paths.push_back({{{x, bottom()}, {x, bottom() - (tick.label.empty() ? 2.0 : 4.0)}}, frame_ink});
            if (!tick.label.empty()) group.texts.push_back({tick.label, {x, bottom() + line}, 0.5, letters});
        }
        for (const Tick& tick : y_ticks_) {
            const double y = level_of(y_.place(tick.value));
            group.paths.push_back({{{left_, y}, {left_ + (tick.label.empty() ? 2.0 : 4.0), y}}, frame_ink});
            if (!tick.label.empty()) group.texts.push_back({tick.label, {left_ - edge, y + 0.36 * letters}, 1.0, letters});
        }
        group.texts.push_back({plot_.x_label, {(left_ + right_) / 2.0, bottom() + 2.0 * line + 1.0}, 0.5, letters});
        group.texts.push_back({plot_.y_label, {line, (top_ + bottom()) / 2.0}, 0.5, letters, true});
        return group;
    }

    DrawnGroup curve(std::size_t i) const {
        const auto [ink, dashes] = style_of(i);
        DrawnGroup group{plot_.curves[i].name};
        DrawnPath joined{{}, ink, 0.8, dashes};
        std::vector<DrawnPath> bars, marks;
        for (const PlotPoint& p : plot_.curves[i].points) {
            if (!is_shown(p)) continue;
            const DrawnPoint middle = at(p.x, p.y);
            joined.points.push_back(middle);
            if (p.low < p.high) bars.push_back({{at(p.x, std::max(p.low, 0.0)), at(p.x, p.high)}, ink, 0.8});
            for (DrawnPath& path : mark(i, middle, ink)) marks.push_back(std::move(path));
        }
        if (joined.points.size() > 1) group.paths.push_back(std::move(joined));
        for (std::vector<DrawnPath>* paths : {&bars, &marks}) std::ranges::move(*paths, std::back_inserter(group.paths));
        return group;
    }

    DrawnGroup legend() const {
        DrawnGroup group;
        for (std::size_t i = 0; i < plot_.curves.size(); ++i) {
            const auto [ink, dashes] = style_of(i);
            const double x = edge + static_cast<double>(i % legend_columns_) * column_width / static_cast<double>(legend_columns_);
            const double y = edge + line * (static_cast<double>(i / legend_columns_) + 0.5);
            group.paths.push_back({{{x, y}, {x + sample_width - edge, y}}, ink, 0.8, dashes});
            for (DrawnPath& path : mark(i, {x + (sample_width - edge) / 2.0, y}, ink)) group.paths.push_back(std::move(path));
            group.texts.push_back({plot_.curves[i].name, {x + sample_width, y + 0.36 * letters}, 0.0, legend_size_});
        }
        return group;
    }

    const Plot& plot_;
    Axis x_, y_;
    double top_ = 2.0 * edge, left_ = 0.0, right_ = column_width - 2.0 * edge, legend_size_;
    std::size_t legend_columns_;
    std::vector<Tick> x_ticks_, y_ticks_;
};

}  // namespace

Drawing draw_plot(const Plot& plot) { return Layout(plot).draw(); }

}  // namespace neumann
