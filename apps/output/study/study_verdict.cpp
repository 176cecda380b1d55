// The verdict of a study on a picture, in a sentence or two.
#include "apps/output/study/study_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace neumann {

namespace {

// A number with two digits and no exponent.
std::string times_text(double x) {
    if (!std::isfinite(x)) return "∞";
    const double unit = std::pow(10.0, std::floor(std::log10(std::max(x, 0.01))) - 1.0);
    return fmt::format("{:g}", std::round(x / unit) * unit);
}

std::string interval_text(const RatioInterval& times) {
    return std::isfinite(times.high) ? fmt::format("{} to {}", times_text(times.low), times_text(times.high))
                                     : fmt::format("{} or more", times_text(times.low));
}

// Whether nothing is known of the ratio.
bool is_unbounded(const RatioInterval& times) { return times.low == 0.0 && std::isinf(times.high); }

std::string faster_text(const StudyData& data, const SpeedRatio& other) {
    const std::string& name = data.methods[other.method].name;
    if (std::isinf(other.times.low)) return fmt::format("without error where {} has one", name);
    if (std::isinf(other.times.high)) return fmt::format("at least {} times as fast as {}", times_text(other.times.low), name);
    return fmt::format("{} times as fast as {} ({})", times_text(other.times.ratio), name, interval_text(other.times));
}

}  // namespace

std::string StudyData::picture_title(std::size_t picture) const {
    if (picture > sum()) return fmt::format("bounces {} to {} together", of_verdict().first, of_verdict().last);
    return picture == sum() ? fmt::format("the sum of bounces 0 to {}", bounces) : "bounce " + picture_name(picture);
}

std::string verdict_text(const StudyData& data, std::size_t picture, const StudyVerdict& verdict) {
    const std::string where = "In " + data.picture_title(picture), &best = data.methods[verdict.best].name;
    if (!verdict.is_known) return where + " no method has a finite variance: there is no verdict.";
    std::vector<std::string> seen, not_seen, unknown;
    for (const SpeedRatio& other : verdict.others) {
        const std::string& name = data.methods[other.method].name;
        if (!other.is_known)
            unknown.push_back(name);
        else if (other.is_seen())
            seen.push_back(faster_text(data, other));
        else
            not_seen.push_back(is_unbounded(other.times) ? name : fmt::format("{} ({})", name, interval_text(other.times)));
    }
    if (seen.size() > 3) seen = {seen[0], seen[1], "… and " + seen.back()};
    std::string text = where;
    if (!seen.empty()) text += fmt::format(" {} is {}{}", best, fmt::join(seen, ", "), not_seen.empty() ? "" : ";");
    if (!not_seen.empty()) text += fmt::format(" no difference is seen between {} and {}", best, fmt::join(not_seen, ", "));
    if (verdict.others.size() == unknown.size())
        text += fmt::format(" {} is the only method {}", best, unknown.empty() ? "here" : "that can be judged");
    text += ".";
    if (!unknown.empty()) text += fmt::format(" The variance of {} is infinite.", fmt::join(unknown, ", "));
    if (verdict.own_error)
        text += fmt::format(" The own error of {}, which samples do not remove, shows below an RMSE of {:.2g}.", best,
                            *verdict.own_error);
    return text;
}

}  // namespace neumann
