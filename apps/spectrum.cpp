#include "apps/spectrum.h"

#include "apps/options.h"
#include "apps/spectrum_report.h"
#include "operators/matrix/scene_patches.h"
#include "operators/spectrum/closure.h"
#include "operators/spectrum/remaining.h"
#include "operators/spectrum/rounding.h"

#include <fmt/format.h>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

// Where the bounces are counted to, well below what is asked for.
constexpr double power_left = 1e-6;

constexpr const char* trapped_light =
    "light that total reflection keeps within glass has the eigenvalue 1; where none gets there, the series converges all the same";

ChannelSpectrum channel_spectrum(const PatchScene& scene, int c, int eigenvalues, const std::vector<RefinementRow>& coarser) {
    const TracedSystem& system = scene.system();
    const TracedChannel K = system.channel(c);
    ChannelSpectrum s;
    s.name = scene.channel_name(c);
    s.largest_albedo = system.largest_albedo(c);
    s.norms = operator_norms(K);
    s.leading = leading_eigenpairs(K, eigenvalues);
    s.radius = s.leading.pairs.empty() ? std::numeric_limits<double>::quiet_NaN() : std::abs(s.leading.pairs.front().value);
    s.shift = radius_shift(coarser, static_cast<std::size_t>(c), s.radius);
    s.convergence = judge(s.radius, s.shift);
    if (s.convergence == Convergence::at_one && has_glass(system.space())) s.convergence = Convergence::undecided;
    if (s.convergence == Convergence::converges) {
        const auto rows = power_rows(K, system.emitted(c), system.direct(c), power_left, SpectrumReport::most_bounces);
        for (std::size_t i = 0; i < s.bounces.size(); ++i) s.bounces[i] = bounces_until(rows, SpectrumReport::remaining[i]);
        const double epsilon[] = {std::numeric_limits<float>::epsilon(), std::numeric_limits<double>::epsilon()};
        for (std::size_t i = 0; i < 2; ++i) {
            s.rounding[i] = rounding_floor(epsilon[i], s.radius);
            s.stagnation[i] = expected_stagnation(epsilon[i], s.radius);
        }
    }
    return s;
}

}  // namespace

SpectrumReport spectrum_report(const PatchScene& scene, int eigenvalues) {
    const TracedSystem& system = scene.system();
    const TracedChannel transport = system.transport();
    SpectrumReport report;
    const Vector sums = row_sums(transport);
    report.row_min = sums.minCoeff();
    report.row_mean = sums.mean();
    report.row_max = sums.maxCoeff();
    report.rays_without_hit = static_cast<double>(system.rays_that_see_nothing()) / static_cast<double>(system.rays());
    report.reciprocity_defect = reciprocity_defect(transport);
    report.emits = !scene.scene().emitters.empty();
    report.coarser = coarser_spectra(scene.scene(), system.settings());
    report.warnings = scene.warnings();
    for (int c = 0; c < system.channels(); ++c) {
        const ChannelSpectrum& s = report.channels.emplace_back(channel_spectrum(scene, c, eigenvalues, report.coarser));
        if (s.norms.sup >= 1.0)
            report.warnings.push_back(
                fmt::format("{}: ‖K‖∞ = {:.6g} is not below 1 and bounds no tail; whether the series converges is for the spectral "
                            "radius to say",
                            s.name, s.norms.sup));
    }
    if (has_glass(system.space())) report.warnings.push_back(trapped_light);
    return report;
}

CLI::App* add_spectrum(CLI::App& app, SpectrumRequest& request) {
    auto* command =
        app.add_subcommand("spectrum", "Print norms and leading eigenvalues of K: whether, and how fast, the series ends");
    add_patch_options(*command, request.patches);
    command->add_option("--eigenvalues", request.eigenvalues, "So many leading eigenvalues")
        ->type_name("N")
        ->check(whole_from(1, 100))
        ->capture_default_str();
    command->add_flag("--csv", request.csv, "Print the eigenvalues as CSV")->excludes("--json");
    return command;
}

int spectrum_command(const SpectrumRequest& request) {
    const PatchScene scene(request.patches);
    const SpectrumReport report = spectrum_report(scene, request.eigenvalues);
    print_warnings(report.warnings, request.patches.quiet);
    if (request.patches.json)
        fmt::print("{}\n", spectrum_json(scene, report).dump(2));
    else if (request.csv)
        print_spectrum_csv(scene, report);
    else
        print_spectrum(scene, report);
    return 0;
}

}  // namespace neumann
