#include "operators/render/methods/prepared.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace neumann {

namespace {

// Whether what was made with these settings serves for others.
template <class Settings>
bool serves(const Settings& made, const Settings& wanted) {
    return made.patches == wanted.patches && made.rays == wanted.rays && made.bounces >= wanted.bounces;
}

}  // namespace

std::shared_ptr<const Guide> Prepared::guide(const method::Guided& guided, const Scene& scene, int bounces, double memory,
                                             const Watch& watch) {
    GuideSettings settings{.bounces = std::max(bounces, bounces_), .seed = seed_, .memory = memory};
    if (guided.patches) settings.patches = *guided.patches;
    if (guided.directions) {
        settings.rays = *guided.directions;
        if (!std::has_single_bit(settings.rays) || settings.rays < CellDistribution::cells)
            throw InputError(fmt::format("--directions {}: --method guided expects a power of two, at least {}", settings.rays,
                                         CellDistribution::cells));
    }
    if (!guide_ || !serves(guide_->settings(), settings)) guide_ = std::make_shared<const Guide>(scene, settings, watch);
    return guide_;
}

std::shared_ptr<const Approximation> Prepared::approximation(const method::Corrected& corrected, const Scene& scene, int bounces,
                                                             double memory, const Watch& watch) {
    ApproximationSettings settings{.bounces = std::max(bounces, bounces_), .seed = seed_, .memory = memory};
    if (corrected.patches) settings.patches = *corrected.patches;
    if (corrected.directions) {
        settings.rays = *corrected.directions;
        if (!std::has_single_bit(settings.rays))
            throw InputError(fmt::format("--directions {}: --method corrected expects a power of two", settings.rays));
    }
    if (!approximation_ || !serves(approximation_->settings(), settings))
        approximation_ = std::make_shared<const Approximation>(scene, settings, watch);
    return approximation_;
}

void Prepared::keep_only(const Method& method) {
    if (!std::holds_alternative<method::Guided>(method)) guide_.reset();
    if (!std::holds_alternative<method::Corrected>(method)) approximation_.reset();
}

}  // namespace neumann
