// Figures and a table of a study, for papers.
#include "apps/output/figures/latex_table.h"
#include "apps/output/files/series_figures.h"
#include "apps/output/study/study_data.h"
#include "operators/statistics/student_t.h"

#include <fmt/format.h>

namespace neumann {

namespace {

Plot error_against_time(const StudyData& data, const StudiedPicture& picture) {
    Plot plot{"seconds of a run, with set-up", "RMSE / W m⁻² sr⁻¹", false, {}};
    const auto repeats = static_cast<double>(data.fewest_repeats());
    for (const StudiedMethod& method : picture.methods) {
        PlotCurve& curve = plot.curves.emplace_back(PlotCurve{data.methods[method.method].name, {}});
        for (const PointSummary& p : method.summary.points) {
            const double half = student_t_quantile(0.95, repeats - 1.0) * p.rmse.standard_error;
            curve.points.push_back({p.seconds.value, p.rmse.value, p.rmse.value - half, p.rmse.value + half});
        }
    }
    return plot;
}

std::string verdict_table(const StudyData& data, const StudiedPicture& picture) {
    const StudyVerdict verdict = verdict_on(picture, data.fewest_repeats());
    std::vector<std::vector<std::string>> rows;
    for (const StudiedMethod& method : picture.methods) {
        const PictureSummary& s = method.summary;
        const PointSummary& last = s.points.back();
        std::string slower = method.method == verdict.best ? "$1$" : "--";
        for (const SpeedRatio& other : verdict.others)
            if (other.method == method.method && other.is_known)
                slower = fmt::format("{} ({} to {})", latex_number(other.times.ratio, 2), latex_number(other.times.low, 2),
                                     latex_number(other.times.high, 2));
        rows.push_back({latex_text(data.methods[method.method].name),
                        last.resolved ? latex_with_error(last.rmse.value, last.rmse.standard_error)
                                      : "$\\le$ " + latex_number(last.largest_rmse(), 2),
                        latex_with_error(last.seconds.value, last.seconds.standard_error, 3),
                        s.slope ? latex_with_error(s.slope->slope, s.slope->standard_error, 2) : "--", slower});
    }
    return latex_table("lrrrr", {"method", "RMSE", "seconds", "slope", "time to the same error"}, rows,
                       fmt::format("{}, {} repeats. RMSE, seconds and slope with standard errors in units of the last digit; "
                                   "time with intervals that hold together at 95%",
                                   data.picture_title(data.pictures() - 1), data.request.repeats));
}

}  // namespace

void write_figures(OutputFolder& folder, const StudyData& data, const std::vector<StudiedPicture>& pictures) {
    const StudiedPicture& picture = pictures.back();
    write_figure(folder, "figure-error", error_against_time(data, picture));
    folder.write("verdict.tex", verdict_table(data, picture));
}

}  // namespace neumann
