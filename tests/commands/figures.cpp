// Figures and tables for papers: what they show is what the tables of numbers say.
#include "apps/output/figures/latex_table.h"
#include "apps/output/sheets/superscript.h"
#include "tests/commands/study_output.h"

#include <pugixml.hpp>

#include <regex>

namespace neumann::figures_test {

// "0.05", "10⁻³", "5·10⁻³"
double value_of_label(std::string label) {
    if (label.find("10") == std::string::npos || label.find_first_not_of("0.1") == std::string::npos) return std::stod(label);
    const auto replace = [&](const std::string& from, const std::string& to) {
        for (std::size_t at; (at = label.find(from)) != std::string::npos;) label.replace(at, from.size(), to);
    };
    for (std::size_t digit = 0; digit < 10; ++digit) replace(superscript(digit), std::to_string(digit));
    replace("⁻", "-");
    const std::size_t dot = label.find("·");
    const std::size_t ten = dot == std::string::npos ? 0 : dot + std::string("·").size();
    return (ten ? std::stod(label) : 1.0) * std::pow(10.0, std::stod(label.substr(ten + 2)));
}

// A figure read again: the values of its marks by the labels of its axes.
class Figure {
public:
    explicit Figure(const std::filesystem::path& path) {
        EXPECT_TRUE(file_.load_file(path.c_str()));
        const pugi::xml_node frame = svg().child("g");
        for (const pugi::xml_node& text : frame.children("text")) {
            const std::string anchor = text.attribute("text-anchor").value();
            const double x = text.attribute("x").as_double(), y = text.attribute("y").as_double();
            if (text.attribute("transform") || (anchor == "middle" && y > height() - 10.0)) continue;  // the axes' titles
            (anchor == "end" ? ys_ : xs_).emplace_back(anchor == "end" ? y - 0.36 * 8.0 : x, value_of_label(text.child_value()));
        }
        std::ranges::sort(xs_);
        std::ranges::sort(ys_);
    }

    pugi::xml_node svg() const { return file_.child("svg"); }
    double width() const { return svg().attribute("width").as_double(); }
    double height() const { return svg().attribute("height").as_double(); }
    std::vector<std::string> curves() const {
        std::vector<std::string> names;
        for (const pugi::xml_node& group : svg().children("g"))
            if (group.child("title")) names.emplace_back(group.child("title").child_value());
        return names;
    }

    // The vertices of the line that joins the points of a curve.
    std::vector<std::pair<double, double>> points(const std::string& curve, bool x_is_whole) const {
        std::vector<std::pair<double, double>> points;
        for (const pugi::xml_node& group : svg().children("g")) {
            if (group.child("title").child_value() != curve) continue;
            std::string d = group.child("path").attribute("d").value();
            std::ranges::replace_if(
                d, [](char c) { return c == 'M' || c == 'L'; }, ' ');
            std::istringstream numbers(d);
            for (double x, y; numbers >> x >> y;) points.emplace_back(at(xs_, x, !x_is_whole), at(ys_, y, true));
        }
        return points;
    }

    // Within the sheet, and no two on each other.
    void expect_readable() const {
        std::vector<std::array<double, 4>> boxes;
        const auto font = find_label_font();
        ASSERT_TRUE(font);
        for (const pugi::xpath_node& node : svg().select_nodes(".//text")) {
            const pugi::xml_node text = node.node();
            const double size = text.attribute("font-size").as_double(),
                         length = size / 100 * text_width(text.child_value(), 100, *font);
            const std::string anchor = text.attribute("text-anchor").value();
            const double before = anchor == "end" ? length : anchor == "middle" ? length / 2 : 0.0;
            const double x = text.attribute("x").as_double(), y = text.attribute("y").as_double();
            const auto box = text.attribute("transform") ? std::array{x - 0.75 * size, y - length + before, x, y + before}
                                                         : std::array{x - before, y - 0.75 * size, x - before + length, y};
            EXPECT_TRUE(box[0] >= 0.0 && box[1] >= 0.0 && box[2] <= width() && box[3] <= height()) << text.child_value();
            for (const auto& other : boxes)
                EXPECT_TRUE(box[0] >= other[2] || other[0] >= box[2] || box[1] >= other[3] || other[1] >= box[3])
                    << text.child_value();
            boxes.push_back(box);
        }
    }

private:
    // Places and values of two labels give all others.
    static double at(const std::vector<std::pair<double, double>>& labels, double place, bool is_logarithmic) {
        const auto value = [&](double v) { return is_logarithmic ? std::log10(v) : v; };
        const auto [p, v] = labels.front();
        const auto [q, w] = labels.back();
        const double found = value(v) + (place - p) / (q - p) * (value(w) - value(v));
        return is_logarithmic ? std::pow(10.0, found) : found;
    }

    pugi::xml_document file_;
    std::vector<std::pair<double, double>> xs_, ys_;
};

struct Printed {
    double value, error, unit;  // the unit of the last digit
};
// Reads $0.1234(56)$ and $1.2(3)\times10^{-7}$.
Printed printed(const std::string& tex) {
    static const std::regex form(R"(\$(-?\d+)(?:\.(\d+))?\((\d+)\)(?:\\times10\^\{(-?\d+)\})?\$)");
    std::smatch found;
    if (!std::regex_match(tex, found, form)) throw std::invalid_argument(tex);
    const double power = found[4].matched ? std::pow(10.0, std::stod(found[4])) : 1.0;
    const double unit = power * std::pow(10.0, -static_cast<double>(found[2].length()));
    return {std::stod(found[1].str() + "." + found[2].str()) * power, std::stod(found[3]) * unit, unit};
}

// The cells of the rows of a LaTeX table.
std::vector<Strings> rows_of(const std::string& tex) {
    std::vector<Strings> rows;
    std::istringstream lines(tex.substr(tex.find("\\midrule\n") + 9));
    for (std::string line; std::getline(lines, line) && line != "\\bottomrule";) {
        Strings& row = rows.emplace_back();
        line = line.substr(0, line.size() - 3);
        for (std::size_t at; (at = line.find(" & ")) != std::string::npos; line = line.substr(at + 3))
            row.push_back(line.substr(0, at));
        row.push_back(line);
    }
    return rows;
}

class Figures : public StudyTest {
protected:
    void expect_shows(const std::string& tex, double value, double error) const {
        const Printed p = printed(tex);
        EXPECT_LE(std::abs(p.value - value), 0.501 * p.unit) << tex << " " << value;
        EXPECT_LE(std::abs(p.error - error), 0.501 * p.unit) << tex << " " << error;
        EXPECT_LE(p.error / p.unit, 35.5) << tex;
    }
    // LaTeX has to read it, where there is one.
    void expect_latex(const std::string& tex) const {
        if (std::system("command -v pdflatex >/dev/null") != 0) return;
        write("try.tex", "\\documentclass{article}\\usepackage{booktabs}\\begin{document}" + tex + "\\end{document}");
        EXPECT_EQ(std::system(fmt::format("cd '{}' && pdflatex -halt-on-error try.tex >/dev/null", path("").string()).c_str()), 0);
    }
};

// The Particle Data Group's own examples of its rule, 0.827 ± 0.119 and 0.827 ± 0.367; 954 is rounded up and keeps two digits.
TEST_F(Figures, ErrorsAreRounded) {
    EXPECT_EQ(latex_with_error(0.827, 0.119), "$0.83(12)$");
    EXPECT_EQ(latex_with_error(0.827, 0.367), "$0.8(4)$");
    EXPECT_EQ(latex_with_error(0.8273, 0.0954), "$0.83(10)$");
    EXPECT_EQ(latex_with_error(1234.0, 56.0), "$1.23(6)\\times10^{3}$");
    EXPECT_EQ(latex_with_error(-1.2346e-7, 2e-9), "$-1.235(20)\\times10^{-7}$");
    EXPECT_EQ(latex_with_error(0.0, 0.01), "$0.000(10)$");
    EXPECT_EQ(latex_with_error(0.25, 0.0), "$0.250000$");
    EXPECT_EQ(latex_with_error(3.0, HUGE_VAL), "$3.0$\\,($\\infty$)");
    EXPECT_EQ(latex_number(9.996, 3), "$10.0$");
    EXPECT_EQ(latex_text("a_b ± 10%"), "a\\_b $\\pm$ 10\\%");
}

// Places are written to 0.01 points; a decade takes more than 10, so values are read to within 0.3%.
TEST_F(Figures, OfARender) {
    render("scene.xml", "a", {"-n", "4", "--spp", "64", "--quiet", "--files", "tables,figures"});
    EXPECT_EQ(names("a"),
              (Names{"run.json", "series.csv", "convergence.csv", "figure-decay.svg", "figure-decay.pdf", "series.tex"}));
    const Table table(path("a/series.csv"));
    const Figure figure(path("a/figure-decay.svg"));
    EXPECT_NEAR(figure.width(), 85.0 / 25.4 * 72.0, 0.01);
    figure.expect_readable();
    const auto points = figure.points("mean radiance", true);
    const std::string tex = text_of(path("a/series.tex"));
    const auto rows = rows_of(tex);
    ASSERT_EQ(points.size(), table.size());
    ASSERT_EQ(rows.size(), table.size());
    for (std::size_t i = 0; i < table.size(); ++i) {
        EXPECT_NEAR(points[i].first, static_cast<double>(i), 0.01);
        EXPECT_NEAR(points[i].second / table.number(i, "mean"), 1.0, 0.003) << i;
        expect_shows(rows[i][1], table.number(i, "mean"), table.number(i, "mean_stderr"));
        EXPECT_EQ(rows[i].back(), table.text(i, "rays"));
    }
    expect_latex(tex);
    EXPECT_TRUE(text_of(path("a/figure-decay.pdf")).starts_with("%PDF-"));
    EXPECT_NE(text_of(path("a/figure-decay.pdf")).find("/MediaBox [ 0 0 240.94"), std::string::npos);
}

// With a range the verdict is on pictures whose MSE is the mean of those of its bounces, run by run.
TEST_F(Figures, OfAStudyOfSomeBounces) {
    study("a", {"--methods", "walk,walk:direct=light:sampler=independent,matrix", "--samples", "4,16,64", "--repeats", "4", "-n",
                "1-3"});
    const nlohmann::json json = study_json("a");
    EXPECT_TRUE(json.at("verdict").get<std::string>().starts_with("In bounces 1 to 3 together ")) << json.at("verdict");
    const Table table(path("a/study.csv"));
    double mse = 0.0, mean = 0.0;
    for (std::size_t row = 0; row < table.size(); ++row) {
        const std::string bounce = table.text(row, "bounce");
        if (bounce == "0") mse = mean = 0.0;
        if (bounce == "1" || bounce == "2" || bounce == "3")
            mse += table.number(row, "mse") / 3, mean += table.number(row, "mean") / 3;
        if (bounce != "1-3") continue;
        EXPECT_NEAR(table.number(row, "mse") / mse, 1.0, 1e-5) << row;
        EXPECT_NEAR(table.number(row, "mean") / mean, 1.0, 1e-6) << row;
    }
    EXPECT_EQ(table.text(table.size() - 1, "bounce"), "1-3");

    const Figure figure(path("a/figure-error.svg"));
    figure.expect_readable();
    EXPECT_EQ(figure.curves().size(), 3u);
    const std::string tex = text_of(path("a/verdict.tex"));
    const auto rows = rows_of(tex);
    ASSERT_EQ(rows.size(), 3u);
    std::size_t row = 0;
    for (const nlohmann::json& m : picture(json, "1-3").at("methods")) {
        const auto points = figure.points(m.at("method"), false);
        ASSERT_EQ(points.size(), 3u);
        for (std::size_t b = 0; b < 3; ++b) {
            EXPECT_NEAR(points[b].first / m.at("points")[b].at("seconds").at("value").get<double>(), 1.0, 0.003);
            EXPECT_NEAR(points[b].second / m.at("points")[b].at("rmse").at("value").get<double>(), 1.0, 0.003);
        }
        EXPECT_EQ(rows[row][0], latex_text(m.at("method")));
        const nlohmann::json last = m.at("points")[2];
        if (last.at("resolved")) expect_shows(rows[row][1], last.at("rmse").at("value"), last.at("rmse").at("standard_error"));
        ++row;
    }
    expect_latex(tex);
    EXPECT_EQ(refused({"study", "scene.xml", "-o", "new", "--methods", "walk", "-n", "3-1"}),
              "-n: '3-1' is not the last bounce, from 0 to 100000, or the first and the last, as in 1-4\n"
              "Run with --help for more information.\n");
}

}  // namespace neumann::figures_test
