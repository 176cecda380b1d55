#include "operators/render/methods/candidates.h"

#include "operators/render/from_paths/splat_sampler.h"

#include <algorithm>
#include <cstddef>

namespace neumann {

namespace {

// From this number of lights on, choosing a light by the place where it is wanted saves more than it costs: with 16 point lights in
// a room the walk's squared noise in bounce 1 is a third at 1.2 times the time, with a thousand 1/25 at 1.5 times.
constexpr std::ptrdiff_t many_lights = 16;
bool has_many_lights(const Emitters& emitters) {
    return std::ranges::count_if(emitters.powers(), [](double power) { return power > 0.0; }) >= many_lights;
}
void choose_lights_by_tree(std::vector<Candidate>& all) {
    for (Candidate& candidate : all)
        std::visit(
            [](auto& m) {
                if constexpr (requires { m.direct; }) m.direct.lights = LightChoice::tree;
            },
            candidate.method);
}

}  // namespace

std::vector<Candidate> candidates(const method::PathOptions& options, const Scene& scene) {
    const Candidate both{method::Bidirectional{options}, 1.4};
    // Light from a light without extent that mirrors and glass pass on is found by paths from the light alone.
    const bool from_lights_alone = scene.emitters.has_delta_lights() && has_specular(scene.materials) && !scene.hide_emitters;
    std::vector<Candidate> all;
    if (!from_lights_alone) all = {{method::Walk{options}, 1.0}, {method::Corrected{options}, 1.3}, {method::Guided{options}, 1.2}};
    if (!scene.hide_emitters) all.push_back(both);
    if (has_many_lights(scene.emitters)) choose_lights_by_tree(all);
    return all;
}

std::vector<Candidate> mixture_candidates(const method::PathOptions& options, const Scene& scene) {
    std::vector<Candidate> all = candidates(options, scene);
    if (scene.hide_emitters) return all;
    if (LightPaths().paths(scene) == Paths::all && scene.camera.can_be_joined()) all.push_back({method::Light{options}, 1.2});
    all.push_back({method::Metropolis{options}, 1.5});
    return all;
}

std::vector<Candidate> biased_candidates() { return {{method::Matrix{}, 1.3}, {method::Gather{}, 1.8}}; }

}  // namespace neumann
