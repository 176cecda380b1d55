#include "apps/commands/spectrum_command.h"

#include "apps/commands/interrupt.h"
#include "apps/commands/progress_line.h"
#include "apps/commands/spectrum_report.h"
#include "core/base/stopwatch.h"
#include "operators/matrix/scene_patches.h"
#include "operators/solvers/stoppable.h"
#include "operators/spectrum/closure.h"
#include "operators/spectrum/remaining.h"
#include "operators/spectrum/rounding.h"

#include <fmt/format.h>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

// Bounces are counted until this part of the power is left, well below what is asked for.
constexpr double power_left = 1e-6;

constexpr const char* trapped_light =
    "light that total reflection keeps within glass has the eigenvalue 1; where none gets there, the series converges all the same";

// Until K ≥ 0 is known to keep some light for good.
constexpr double most_for_bounds = 1000.0;

using Tell = std::function<void(const std::function<std::string()>&)>;

// The time limit of a report, and of its parts.
class Limits {
public:
    Limits(const SpectrumRequest& request, const Tell& tell) : request_(request), tell_(tell) {}

    double left() const { return std::max(request_.seconds - watch_.seconds(), 0.0); }
    // Limits for a part that may take this fraction of the time left.
    EigenLimits part(double part, const std::string& what) const {
        const double end = watch_.seconds() + part * left();
        EigenLimits limits;
        limits.most = static_cast<double>(request_.most);
        limits.look = [this, what](const EigenStep& step) {
            tell_([&] {
                return fmt::format("{}   {:.0f} applications of K   largest residual {:.1e}   {:.0f} s", what, step.applications,
                                   step.residual, watch_.seconds());
            });
        };
        limits.watch.stop = [this, end] { return interrupted() || watch_.seconds() >= end; };
        return limits;
    }

private:
    const SpectrumRequest& request_;
    const Tell& tell_;
    Stopwatch watch_;
};

ChannelSpectrum channel_spectrum(const PatchScene& scene, int c, int eigenvalues, const EigenLimits& limits) {
    const TracedSystem& system = scene.system();
    const TracedChannel K = system.channel(c);
    ChannelSpectrum s;
    s.name = scene.channel_name(c);
    s.largest_albedo = system.largest_albedo(c);
    s.norms = operator_norms(K, limits);
    s.one_error = K.standard_error_of_power(s.norms.one_at);
    s.one_part = K.measure()[s.norms.one_at] / K.measure().sum();
    s.leading = leading_eigenpairs(K, eigenvalues, false, limits);
    s.radius = s.leading.radius();
    if (!std::isfinite(s.radius)) {
        s.bounds = radius_bounds(K, most_for_bounds, {.stop = interrupted});
        if (s.bounds->meet()) s.radius = s.bounds->high;
    }
    return s;
}

void judge(ChannelSpectrum& s, const PatchScene& scene, int c, const std::vector<RefinementRow>& coarser,
           const EigenLimits& limits) {
    const TracedSystem& system = scene.system();
    s.shift = radius_shift(coarser, static_cast<std::size_t>(c), s.radius);
    s.convergence = neumann::judge(s.radius, s.shift);
    if (s.convergence == Convergence::at_one && has_glass(system.space())) s.convergence = Convergence::undecided;
    if (s.convergence != Convergence::converges) return;
    const TracedChannel K = system.channel(c);
    try {
        const StoppableChannel stoppable(K, limits.watch);
        const auto rows = power_rows(stoppable, system.emitted(c), system.direct(c), power_left, SpectrumReport::most_bounces);
        for (std::size_t i = 0; i < s.bounces.size(); ++i) s.bounces[i] = bounces_until(rows, SpectrumReport::remaining[i]);
    } catch (const Stopped&) {
        s.bounces_stopped = true;
    }
    const double epsilon[] = {std::numeric_limits<float>::epsilon(), std::numeric_limits<double>::epsilon()};
    for (std::size_t i = 0; i < 2; ++i) {
        s.rounding[i] = rounding_floor(epsilon[i], s.radius);
        s.stagnation[i] = expected_stagnation(epsilon[i], s.radius);
    }
}

}  // namespace

SpectrumReport spectrum_report(const PatchScene& scene, const SpectrumRequest& request, const Tell& tell) {
    const Limits limits(request, tell);
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
    report.warnings = scene.warnings();
    const int channels = system.channels();
    // Each channel gets as much time as all comparisons together.
    for (int c = 0; c < channels; ++c)
        report.channels.push_back(
            channel_spectrum(scene, c, request.eigenvalues, limits.part(1.0 / (channels - c + 1), scene.channel_name(c))));
    report.coarser = coarser_spectra(scene.scene(), system.settings(), limits.part(1.0, "coarser"));
    for (int c = 0; c < channels; ++c) {
        ChannelSpectrum& s = report.channels[static_cast<std::size_t>(c)];
        judge(s, scene, c, report.coarser, limits.part(1.0, s.name));
        if (s.norms.sup >= 1.0)
            report.warnings.push_back(
                fmt::format("{}: ‖K‖∞ = {:.6g} is not below 1 and bounds no tail; whether the series converges is for the spectral "
                            "radius to say",
                            s.name, s.norms.sup));
        if (!s.leading.converged) report.warnings.push_back(fmt::format("{}: eigenvalues were {}", s.name, s.leading.why));
    }
    if (has_glass(system.space())) report.warnings.push_back(trapped_light);
    if (interrupted())
        report.warnings.push_back("interrupted: this is what was found until then");
    else if (limits.left() == 0.0)
        report.warnings.push_back(fmt::format("the time of {:g} s was up: this is what was found until then", request.seconds));
    return report;
}

int spectrum_command(const SpectrumRequest& request) {
    catch_interrupts();
    ProgressLine line(request.patches.quiet);
    line.show([] { return std::string("tracing T"); });
    const PatchScene scene(request.patches);
    const SpectrumReport report = spectrum_report(scene, request, [&](const auto& text) { line.show(text); });
    line.clear();
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
