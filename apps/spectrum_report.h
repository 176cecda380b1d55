// What `neumann spectrum` finds out, before it is printed in one form or another.
#pragma once

#include "apps/patch_options.h"
#include "operators/matrix/refinement.h"
#include "operators/spectrum/convergence.h"
#include "operators/spectrum/spectrum.h"

#include <array>
#include <optional>

namespace neumann {

struct ChannelSpectrum {
    const char* name = "";
    double largest_albedo = 0.0;
    OperatorNorms norms;
    Eigenpairs leading;
    double radius = 0.0, shift = 0.0;  // and how far it moves when patches or rays are quartered
    Convergence convergence = Convergence::undecided;
    std::array<std::optional<int>, 3> bounces;       // until the part `remaining` is left
    std::array<double, 2> rounding{}, stagnation{};  // in float and in double
};

struct SpectrumReport {
    static constexpr std::array<double, 3> remaining{0.1, 0.01, 0.001};
    static constexpr int most_bounces = 10000;

    double row_min = 0.0, row_mean = 0.0, row_max = 0.0;  // sums of rows of T
    double rays_without_hit = 0.0;                        // part of all
    double reciprocity_defect = 0.0;
    bool emits = false;
    std::vector<ChannelSpectrum> channels;
    std::vector<RefinementRow> coarser;
    std::vector<std::string> warnings;
};

SpectrumReport spectrum_report(const PatchScene& scene, int eigenvalues);

void print_spectrum(const PatchScene& scene, const SpectrumReport& report);
void print_spectrum_csv(const PatchScene& scene, const SpectrumReport& report);
nlohmann::ordered_json spectrum_json(const PatchScene& scene, const SpectrumReport& report);

}  // namespace neumann
