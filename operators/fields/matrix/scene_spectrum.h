// The spectrum of a scene: for each colour channel of K its norms and leading eigenvalues, whether and how fast the
// series converges, and how much of that is an effect of patches and rays.
#pragma once

#include "operators/fields/matrix/refinement.h"
#include "operators/solvers/spectrum/convergence.h"
#include "operators/solvers/spectrum/radius_bounds.h"
#include "operators/solvers/spectrum/spectrum.h"

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace neumann {

struct ChannelSpectrum {
    const char* name = "";
    double largest_albedo = 0.0;
    OperatorNorms norms;
    MatrixSystem::PowerError one;  // the error of ‖K‖₁
    Eigenpairs leading;
    std::optional<Eigenpairs> by_slepc;
    double radius = 0.0, shift = 0.0;    // spectral radius, and how far it moves when patches or rays are quartered
    std::optional<RadiusBounds> bounds;  // bounds on the radius, if the eigenvalues were not found
    Convergence convergence = Convergence::undecided;
    std::array<std::optional<int>, 3> bounces;       // number of bounces until the part `remaining` is left
    bool bounces_stopped = false;                    // time ran out before they were known
    std::array<double, 2> rounding{}, stagnation{};  // rounding_floor() and expected_stagnation(), for float and double
};

struct SceneSpectrum {
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

struct SpectrumLimits {
    int eigenvalues = 4;
    std::optional<int> channel = {};  // the only channel; without it, all that differ
    double seconds = 60.0;
    double most = 10000.0;             // applications of K in a search
    std::optional<std::string> petsc;  // SLEPc's options for another search for the eigenvalues of each channel
    // Called in every search with the name of the search and how far it is.
    std::function<void(const std::string& what, const EigenStep&)> look = [](const std::string&, const EigenStep&) {};
};

// If it runs out of time or is stopped, returns what was found so far, with a warning.
SceneSpectrum scene_spectrum(const MatrixSystem& system, const SpectrumLimits& limits, const Watch& watch = {});

}  // namespace neumann
