#include "operators/methods/candidates.h"

#include "operators/pictures/missing_paths.h"

namespace neumann {

std::vector<Candidate> candidates(const method::PathOptions& options, const Scene& scene) {
    const Candidate both{method::Bidirectional{options}, 1.4};
    // What mirrors and glass throw on from a light without extent is found from the light alone.
    if (scene.emitters.has_delta_lights() && has_specular(scene.materials) && !scene.hide_emitters) return {both};
    std::vector<Candidate> all{{method::Walk{options}, 1.0}, {method::Corrected{options}, 1.3}, {method::Guided{options}, 1.2}};
    if (!scene.hide_emitters) all.push_back(both);
    return all;
}

std::vector<Candidate> mixture_candidates(const method::PathOptions& options, const Scene& scene) {
    std::vector<Candidate> all = candidates(options, scene);
    if (scene.hide_emitters) return all;
    if (paths_of(PathGenerator::light, scene) == Paths::all && scene.camera.can_be_joined())
        all.push_back({method::Light{options}, 1.2});
    all.push_back({method::Metropolis{options}, 1.5});
    return all;
}

std::vector<Candidate> biased_candidates() { return {{method::Matrix{}, 1.3}, {method::Gather{}, 1.8}}; }

}  // namespace neumann
