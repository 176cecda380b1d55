#include "apps/commands/compare_command.h"

#include "apps/output/files/json_text.h"
#include "apps/output/files/output_folder.h"
#include "apps/output/files/rendered_picture.h"
#include "apps/output/pages/compare_page.h"
#include "core/base/error.h"
#include "operators/statistics/flip.h"
#include "operators/statistics/metrics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace neumann {
namespace {

namespace fs = std::filesystem;

constexpr double confidence = 0.95;

struct Row {
    std::string name;
    Metrics metrics;
    MeanDifferences means;
    double noise = 0.0;
    std::optional<double> flip = {};  // the mean, if it was requested
    bool a_has_error = false, b_has_error = false, degrees_known = true, infinite_variance = false;
    // Whether the mean has the widest interval, because the errors of a picture's pixels may be correlated.
    bool widest = false;

    bool has_error() const { return a_has_error || b_has_error; }
    bool has_interval() const { return has_error() && !infinite_variance; }
};

struct Comparison {
    std::vector<Row> rows;
    std::vector<std::string> only_in_a, only_in_b;
    std::optional<std::pair<std::string, std::string>> rests;  // set if they differ: the bounces after which they begin
};

ComparedPicture compared(const RenderedPicture& p) {
    return {p.picture, p.degrees_of_freedom.value_or(exact_degrees_of_freedom), p.means ? &*p.means : nullptr};
}

Row compare_pictures(const std::string& name, const std::string& path_a, const std::string& path_b, bool flip) {
    const RenderedPicture a = read_rendered_picture(path_a), b = read_rendered_picture(path_b);
    try {
        Row row{name,
                compare(a.picture.mean, b.picture.mean),
                {},
                expected_rmse(a.picture, b.picture),
                {},
                a.has_error(),
                b.has_error(),
                true};
        if (flip) row.flip = mean_hdr_flip(a.picture.mean, b.picture.mean);
        row.means = compare_means(compared(a), compared(b), confidence);
        row.degrees_known = (!a.has_error() || a.degrees_of_freedom) && (!b.has_error() || b.degrees_of_freedom);
        row.infinite_variance = a.infinite_variance || b.infinite_variance;
        const auto may_go_together = [&](const RenderedPicture& p) {
            return p.has_error() && !p.picture.pixels_are_independent && !(p.means && row.metrics.not_finite == 0);
        };
        row.widest = may_go_together(a) || may_go_together(b);
        return row;
    } catch (const InputError& error) {
        throw InputError(fmt::format("{} and {}: {}", path_a, path_b, error.what()));
    }
}

// The order of the pictures of a series: bounces, sums, rest, each by number.
struct SeriesOrder {
    bool operator()(const std::string& a, const std::string& b) const { return key(a) < key(b); }
    static std::tuple<int, std::size_t, std::string> key(const std::string& name) {
        return {name.starts_with("bounce_") ? 0 : name.starts_with("sum_") ? 1 : 2, name.size(), name};
    }
};

std::set<std::string, SeriesOrder> pictures_in(const std::string& folder) {
    std::set<std::string, SeriesOrder> names;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.ends_with(".exr") && is_output_name(name)) names.insert(name);
    }
    if (error) throw InputError(fmt::format("{}: cannot be read: {}", folder, error.message()));
    if (names.empty()) throw InputError(folder + ": no bounce_*.exr, sum_*.exr or rest.exr");
    return names;
}

Comparison compare_folders(const std::string& a, const std::string& b, bool flip) {
    const auto in_a = pictures_in(a), in_b = pictures_in(b);
    Comparison out;
    std::set_difference(in_a.begin(), in_a.end(), in_b.begin(), in_b.end(), std::back_inserter(out.only_in_a), SeriesOrder());
    std::set_difference(in_b.begin(), in_b.end(), in_a.begin(), in_a.end(), std::back_inserter(out.only_in_b), SeriesOrder());
    // If the series end at different bounces, their rests differ.
    const auto last_bounce = [](const auto& names) {
        const auto end = names.lower_bound("sum_");
        return end == names.begin() ? std::string() : fs::path(*std::prev(end)).stem().string();
    };
    const bool rests_differ = last_bounce(in_a) != last_bounce(in_b);
    if (rests_differ && in_a.contains("rest.exr") && in_b.contains("rest.exr"))
        out.rests = {{last_bounce(in_a), last_bounce(in_b)}};
    for (const std::string& name : in_a) {
        if (!in_b.contains(name) || (out.rests && name == "rest.exr")) continue;
        out.rows.push_back(
            compare_pictures(fs::path(name).stem(), (fs::path(a) / name).string(), (fs::path(b) / name).string(), flip));
    }
    if (out.rows.empty()) throw InputError(fmt::format("{} and {}: no picture that both have", a, b));
    return out;
}

bool is_folder(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) throw InputError(fmt::format("{}: cannot be read: {}", path, error.message()));
    return fs::is_directory(status);
}

// In files, infinity means that an error is unknown, for example after a single replicate.
std::string interval_text(const Row& row, const MeanDifference& d) {
    if (!row.has_error()) return "no standard error in the file";
    if (row.infinite_variance) return "none: infinite variance";
    return std::isfinite(d.half_width) ? fmt::format("± {:.2e}", d.half_width) : "unknown";
}

void print_means(const Row& row, const std::string& name, const MeanDifference& d) {
    fmt::print("{:<13}{:>13.5e}{:>14.5e}{:>14.3e}   {}\n", name, d.mean, d.reference_mean, d.difference, interval_text(row, d));
}

void print_notes(const Comparison& comparison) {
    const auto any = [&](const auto& holds) { return std::any_of(comparison.rows.begin(), comparison.rows.end(), holds); };
    for (const Row& row : comparison.rows) {
        if (row.metrics.not_finite == 0) continue;
        fmt::print("{}: {} of {} pixels are not finite in A or B and left out.\n", row.name, row.metrics.not_finite,
                   row.metrics.pixels + row.metrics.not_finite);
    }
    if (any([](const Row& row) { return row.a_has_error != row.b_has_error; })) {
        fmt::print("Where one file has no standard error, it is taken as exact.\n");
    }
    if (any([](const Row& row) { return row.has_interval() && !row.degrees_known; })) {
        fmt::print("Where a file does not say its degrees of freedom, they are taken as many.\n");
    }
    if (any([](const Row& row) { return row.has_interval() && row.widest; })) {
        fmt::print(
            "Errors of the pixels of one picture may go together here (all methods but those that walk from the camera), and a "
            "file\n"
            "does not hold the error of its mean, or not all pixels count: intervals are upper bounds then, perhaps far too "
            "wide.\n");
    }
    if (comparison.rests)
        fmt::print("The rests are not compared: that of A begins after {}, that of B after {}.\n", comparison.rests->first,
                   comparison.rests->second);
    if (!comparison.only_in_a.empty()) fmt::print("Only in A: {}\n", fmt::join(comparison.only_in_a, " "));
    if (!comparison.only_in_b.empty()) fmt::print("Only in B: {}\n", fmt::join(comparison.only_in_b, " "));
}

void print_table(const std::string& a, const std::string& b, const Comparison& comparison, bool by_channel) {
    fmt::print("A  {}\nB  {}  (the reference)\n\n", a, b);
    const bool flip = comparison.rows.front().flip.has_value();
    fmt::print("{:<13}{:>13}{:>13}{:>13}{:>13}{:>13}{:>13}{}\n", "", "RMSE", "by noise", "relMSE", "MAPE", "SMAPE", "max |A-B|",
               flip ? "     FLIP" : "");
    for (const Row& row : comparison.rows) {
        const Metrics& m = row.metrics;
        const std::string noise = row.has_interval() && std::isfinite(row.noise) ? fmt::format("{:.4e}", row.noise) : "unknown";
        fmt::print("{:<13}{:>13.4e}{:>13}{:>13.4e}{:>13.4e}{:>13.4e}{:>13.4e}{}\n", row.name, m.rmse, noise, m.rel_mse, m.mape,
                   m.smape, m.max_error, row.flip ? fmt::format("{:>9.4f}", *row.flip) : "");
    }
    fmt::print("\n{:<13}{:>13}{:>14}{:>14}   {}\n", "", "mean A", "mean B", "mean A-B", "95% interval of mean A-B");
    for (const Row& row : comparison.rows) {
        print_means(row, row.name, row.means.all);
        constexpr const char* names[] = {"  red", "  green", "  blue"};
        for (int c = 0; by_channel && c < 3; ++c) print_means(row, names[c], row.means.channel[c]);
    }
    fmt::print(
        "\nMeans over pixels and channels, fractions and not percent, with ε = {}:\n"
        "  RMSE² (A-B)²    relMSE (A-B)²/(B²+ε·mean(B)²)    MAPE |A-B|/(|B|+ε·mean|B|)\n"
        "  SMAPE 2|A-B|/(|A|+|B|+ε·(mean|A|+mean|B|))\n"
        "By noise: the RMSE that the standard errors alone explain.\n",
        metrics_epsilon);
    if (flip) fmt::print("FLIP: the mean of HDR-FLIP, from 0, no difference that is seen, to 1.\n");
    print_notes(comparison);
}

nlohmann::ordered_json json_of(const Row& row, const MeanDifference& d) {
    nlohmann::ordered_json j = {{"mean", d.mean}, {"reference_mean", d.reference_mean}, {"mean_difference", d.difference}};
    if (row.has_interval()) {
        j["standard_error"] = d.standard_error;
        j["degrees_of_freedom"] = d.degrees_of_freedom;
        j["interval"] = {d.difference - d.half_width, d.difference + d.half_width};
    } else {
        j["standard_error"] = j["degrees_of_freedom"] = j["interval"] = nullptr;
    }
    return j;
}

// Infinity and NaN become null, because JSON has neither.
nlohmann::ordered_json json_of(const Row& row) {
    const Metrics& m = row.metrics;
    nlohmann::ordered_json j = {{"name", row.name},
                                {"rmse", m.rmse},
                                {"rmse_by_noise", nullptr},
                                {"rel_mse", m.rel_mse},
                                {"mape", m.mape},
                                {"smape", m.smape},
                                {"max_error", m.max_error},
                                {"pixels", m.pixels},
                                {"not_finite", m.not_finite},
                                {"infinite_variance", row.infinite_variance},
                                {"interval_is_upper_bound", row.has_interval() && row.widest}};
    if (row.has_interval()) j["rmse_by_noise"] = row.noise;
    if (row.flip) j["flip"] = *row.flip;
    j.update(json_of(row, row.means.all));
    constexpr const char* names[] = {"red", "green", "blue"};
    for (int c = 0; c < 3; ++c) j[names[c]] = json_of(row, row.means.channel[c]);
    return j;
}

nlohmann::ordered_json json_of(const std::string& a, const std::string& b, const Comparison& comparison) {
    nlohmann::ordered_json j = {{"a", a}, {"b", b}, {"reference", "b"}, {"epsilon", metrics_epsilon}, {"confidence", confidence}};
    j["pictures"] = nlohmann::ordered_json::array();
    for (const Row& row : comparison.rows) j["pictures"].push_back(json_of(row));
    j["only_in_a"] = comparison.only_in_a;
    j["only_in_b"] = comparison.only_in_b;
    return j;
}

}  // namespace

int compare_command(const CompareRequest& request) {
    const auto& [a, b, output, more, flip, json] = request;
    const bool a_is_folder = is_folder(a), b_is_folder = is_folder(b);
    if (a_is_folder != b_is_folder) {
        throw InputError(fmt::format("{} and {}: a folder against a picture", a_is_folder ? a : b, a_is_folder ? b : a));
    }
    const bool folders = a_is_folder && b_is_folder;
    if (!folders && !output.empty())
        throw InputError(fmt::format("-o: {} is a picture; a page is made of two folders of render", a));
    if (!more.empty() && output.empty())
        throw InputError(fmt::format("{}: figures are of two, A and B; more folders are for the page of -o", more.front()));
    const Comparison comparison =
        folders ? compare_folders(a, b, flip) : Comparison{{compare_pictures("A against B", a, b, flip)}, {}, {}, {}};
    const auto figures = json_of(a, b, comparison);
    if (!output.empty()) {
        std::vector<std::string> shown = {a, b};
        shown.insert(shown.end(), more.begin(), more.end());
        write_compare_page(output, shown, figures);
    }
    if (json) {
        fmt::print("{}\n", json_text(figures, 2));
    } else {
        print_table(a, b, comparison, !folders);
        if (!output.empty())
            fmt::print("{} are on the page {}\n", more.empty() ? "Both" : "All", (fs::path(output) / "index.html").string());
    }
    return 0;
}

}  // namespace neumann
