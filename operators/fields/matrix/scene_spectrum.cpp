#include "operators/fields/matrix/scene_spectrum.h"

#include "core/base/stopwatch.h"
#include "operators/fields/matrix/scene_patches.h"
#include "operators/solvers/petsc/petsc_solver.h"
#include "operators/solvers/remaining.h"
#include "operators/solvers/spectrum/closure.h"
#include "operators/solvers/spectrum/rounding_floor.h"
#include "operators/solvers/stoppable.h"

#include <fmt/format.h>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

// Bounces are counted until this part of the power is left, well below the parts in SceneSpectrum::remaining.
constexpr double power_left = 1e-6;

constexpr const char* trapped_light =
    "light that total reflection keeps within glass has the eigenvalue 1; where none gets there, the series converges all the same";

// Divides the time limit among the searches.
class SearchTime {
public:
    SearchTime(const SpectrumLimits& limits, const Watch& watch) : limits_(limits), watch_(watch) {}

    double left() const { return std::max(limits_.seconds - clock_.seconds(), 0.0); }
    // The limits for a search that may take this fraction of the time left.
    EigenLimits part(double part, const std::string& what) const {
        EigenLimits limits;
        limits.most = limits_.most;
        limits.look = [this, what](const EigenStep& step) { limits_.look(what, step); };
        limits.watch.stop = [this, end = clock_.seconds() + part * left()] { return watch_.stop() || clock_.seconds() >= end; };
        return limits;
    }

private:
    const SpectrumLimits& limits_;
    const Watch& watch_;
    Stopwatch clock_;
};

ChannelSpectrum channel_spectrum(const MatrixSystem& system, int c, const SpectrumLimits& wanted, const EigenLimits& limits,
                                 const Watch& watch, std::vector<std::string>& messages) {
    const std::unique_ptr<ChannelOperator> K = system.reflected(c);
    ChannelSpectrum s;
    s.name = system.channel_name(c);
    s.largest_albedo = system.largest_albedo(c);
    s.norms = system.norms(*K, limits);
    s.one = system.error_of_power(c, s.norms.one_at);
    s.leading = system.leading(*K, wanted.eigenvalues, limits);
    if (wanted.petsc) s.by_slepc = slepc_eigenpairs(*K, wanted.eigenvalues, *wanted.petsc, limits, &messages);
    s.radius = s.leading.radius();
    if (!std::isfinite(s.radius)) {
        s.bounds = radius_bounds(*K, most_for_bounds, watch);
        if (s.bounds->meet()) s.radius = s.bounds->high;
    }
    return s;
}

void find_convergence(ChannelSpectrum& s, const MatrixSystem& system, int c, const std::vector<RefinementRow>& coarser,
                      const Watch& watch) {
    s.shift = radius_shift(coarser, static_cast<std::size_t>(c), s.radius);
    s.convergence = judge(s.radius, s.shift);
    if (s.convergence == Convergence::at_one && has_glass(system.space())) s.convergence = Convergence::undecided;
    if (s.convergence != Convergence::converges) return;
    try {
        const StoppableChannel stoppable(system.reflected(c), watch);
        const auto rows = power_rows(stoppable, system.emitted(c), system.direct(c), power_left, SceneSpectrum::most_bounces);
        for (std::size_t i = 0; i < s.bounces.size(); ++i) s.bounces[i] = bounces_until(rows, SceneSpectrum::remaining[i]);
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

SceneSpectrum scene_spectrum(const MatrixSystem& system, const SpectrumLimits& limits, const Watch& watch) {
    const SearchTime time(limits, watch);
    const std::unique_ptr<ChannelOperator> transport = system.transported();
    const Agreement& agreement = transport->agreement();
    SceneSpectrum found;
    const Vector sums = row_sums(*transport);
    found.row_min = agreement.lowest(sums);
    found.row_mean = agreement.sum(sums.sum()) / static_cast<double>(transport->unknowns());
    found.row_max = agreement.size(sums);
    found.rays_without_hit = static_cast<double>(system.rays_that_see_nothing()) / static_cast<double>(system.rays());
    found.reciprocity_defect = reciprocity_defect(*transport);
    found.emits = !system.scene().emitters.empty();
    std::vector<int> channels;
    for (int c = 0; c < system.channels(); ++c)
        if (!limits.channel || system.channels() == 1 || c == *limits.channel) channels.push_back(c);
    // Each channel gets as much time as all comparisons together.
    for (const int c : channels) {
        const auto left = static_cast<double>(channels.size() - found.channels.size() + 1);
        found.channels.push_back(
            channel_spectrum(system, c, limits, time.part(1.0 / left, system.channel_name(c)), watch, found.warnings));
    }
    found.coarser = coarser_spectra(system, time.part(1.0, "coarser"));
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const int c = channels[i];
        ChannelSpectrum& s = found.channels[i];
        find_convergence(s, system, c, found.coarser, time.part(1.0, s.name).watch);
        if (s.norms.sup >= 1.0)
            found.warnings.push_back(
                fmt::format("{}: ‖K‖∞ = {:.6g} is not below 1 and bounds no tail; whether the series converges is for the spectral "
                            "radius to say",
                            s.name, s.norms.sup));
        if (!s.leading.converged) found.warnings.push_back(fmt::format("{}: eigenvalues were {}", s.name, s.leading.why));
    }
    for (RefinementRow& row : found.coarser) {
        std::vector<std::vector<std::complex<double>>> chosen;
        for (const int c : channels) chosen.push_back(std::move(row.leading[static_cast<std::size_t>(c)]));
        row.leading = std::move(chosen);
    }
    if (has_glass(system.space())) found.warnings.push_back(trapped_light);
    if (watch.stop())
        found.warnings.push_back("interrupted: this is what was found until then");
    else if (time.left() == 0.0)
        found.warnings.push_back(fmt::format("the time of {:g} s was up: this is what was found until then", limits.seconds));
    return found;
}

}  // namespace neumann
