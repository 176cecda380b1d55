// The results of `neumann spectrum`, before they are printed.
#pragma once

#include "apps/commands/spectrum_command.h"
#include "operators/matrix/refinement.h"
#include "operators/spectrum/convergence.h"
#include "operators/spectrum/radius_bounds.h"
#include "operators/spectrum/spectrum.h"

#include <array>
#include <functional>
#include <optional>

namespace neumann {

struct ChannelSpectrum {
    const char* name = "";
    double largest_albedo = 0.0;
    OperatorNorms norms;
    double one_error = 0.0, one_part = 0.0;  // of ‖K‖₁: standard error by the rays, and its unknown's part of the measure
    Eigenpairs leading;
    double radius = 0.0, shift = 0.0;    // spectral radius, and how far it moves when patches or rays are quartered
    std::optional<RadiusBounds> bounds;  // of the radius, if the eigenvalues were not found
    Convergence convergence = Convergence::undecided;
    std::array<std::optional<int>, 3> bounces;       // number of bounces until the part `remaining` is left
    bool bounces_stopped = false;                    // time ran out before they were known
    std::array<double, 2> rounding{}, stagnation{};  // in float and in double
};

struct SpectrumReport {
    static constexpr std::array<double, 3> remaining{0.1, 0.01, 0.001};
    static constexpr int most_bounces = 10000;

    double row_min = 0.0, row_mean = 0.0, row_max = 0.0;  // sums of rows of T
    double rays_without_hit = 0.0;                        // fraction of all rays
    double reciprocity_defect = 0.0;
    bool emits = false;
    std::vector<ChannelSpectrum> channels;
    std::vector<RefinementRow> coarser;
    std::vector<std::string> warnings;
};

// Calls `tell` with the progress from time to time. If out of time or interrupted, returns what was found so far, with a warning.
SpectrumReport spectrum_report(
    const PatchScene& scene, const SpectrumRequest& request,
    const std::function<void(const std::function<std::string()>&)>& tell = [](const auto&) {});

void print_spectrum(const PatchScene& scene, const SpectrumReport& report);
void print_spectrum_csv(const PatchScene& scene, const SpectrumReport& report);
nlohmann::ordered_json spectrum_json(const PatchScene& scene, const SpectrumReport& report);

}  // namespace neumann
