// The table that a study prints: for each bounce, and for the sum, the methods in order of rank.
#include "apps/output/study/study_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace neumann {

namespace {

// The text in lines of at most 120 characters.
std::string folded(const std::string& text) {
    constexpr std::size_t most = 120;
    std::string out;
    std::size_t width = 0;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const auto length = static_cast<std::size_t>(std::ranges::count_if(word, [](char c) { return (c & 0xc0) != 0x80; }));
        if (width > 0) out += width + 1 + length > most ? "\n" : " ";
        width = width > 0 && width + 1 + length <= most ? width + 1 + length : length;
        out += word;
    }
    return out;
}

std::string slope_text(const PictureSummary& s) {
    if (!s.slope) return "-";
    return fmt::format("{:.2f} ± {:.2f}", s.slope->slope, s.slope->half_width);
}

std::string seconds_text(const std::optional<WorkToError>& seconds) {
    if (!seconds) return "-";
    return fmt::format("{}{:.3g}", seconds->below ? "< " : "", seconds->work);
}

// bias² relative to MSE, with its sign.
std::string bias_text(const PointSummary& p) {
    const double mse = p.rmse.value * p.rmse.value;
    if (!(mse > 0.0) || !std::isfinite(p.bias_half_width)) return "-";
    return fmt::format("{:.0f} ± {:.0f}%{}", 100.0 * p.bias_squared.value / mse, 100.0 * p.bias_half_width / mse,
                       p.biased ? " *" : "");
}

// The time taken, with the budget if it differs.
std::string taken_text(const StudyData& data, const StudiedMethod& method) {
    const auto missed = missed_budget(data.plan, *points_of_method(data.points, method.method).back());
    const double seconds = method.summary.points.back().seconds.value;
    return missed ? fmt::format("{:.3g} for {:g}", seconds, *missed) : fmt::format("{:.3g}", seconds);
}

void print_method(const StudyData& data, const StudiedMethod& method) {
    const PictureSummary& s = method.summary;
    const PointSummary& last = s.points.back();
    const bool exact = last.rmse.value == 0.0 && last.rmse.standard_error == 0.0;
    const std::string rmse =
        last.resolved || exact ? fmt::format("{:.3g}", last.rmse.value) : fmt::format("≤ {:.2g}", last.largest_rmse());
    std::string name = data.methods[method.method].name;
    if (name.size() > 30) name = name.substr(0, 29) + "…";
    const std::string efficiency = s.infinite_variance ? "infinite V" : fmt::format("{:.3g}", last.efficiency);
    fmt::print("{:>3} {:<30} {:>9} {:>8.2g} {:>13} {:>10} {:>8} {:>14} {:>14}\n", s.rank, name, rmse, last.rel_mse.value,
               taken_text(data, method), efficiency, seconds_text(s.seconds_to_error), slope_text(s), bias_text(last));
}

}  // namespace

void print_study(const StudyData& data, const std::vector<StudiedPicture>& pictures) {
    fmt::print("{}\n\n", folded(verdict_text(data, pictures.size() - 1, verdict_on(pictures.back(), data.fewest_repeats()))));
    for (std::size_t q = 0; q < pictures.size(); ++q) {
        const StudiedPicture& p = pictures[q];
        fmt::print("{}   (rms of the reference {:.4g}, its noise {:.2g}; the given error {:.3g})\n", data.picture_title(q),
                   p.reference_size, p.reference_noise, p.error);
        fmt::print("{:>3} {:<30} {:>9} {:>8} {:>13} {:>10} {:>8} {:>14} {:>14}\n", "", "method", "RMSE", "relMSE", "seconds",
                   "1/(V T)", "s to it", "slope", "bias²/MSE");
        for (const StudiedMethod& m : p.methods) print_method(data, m);
        fmt::print("\n");
    }
    fmt::print(
        "At the largest budget, of {} repeats, ranked by 1/(MSE T). T: seconds of a run with all its bounces and its set-up. "
        "Slope: of\n"
        "log RMSE against log T. ±: 95% intervals. *: bias² is above 0 at 99.9%.\n"
        "Reference: {}.\n",
        data.request.repeats, data.reference.description);
    if (!data.reference.choice.empty()) fmt::print("Chosen: {}.\n", data.reference.choice);
    for (const std::string& warning : data.warnings()) fmt::print("warning: {}\n", warning);
    fmt::print("Tables and plots are in {}\n", data.request.output);
}

}  // namespace neumann
