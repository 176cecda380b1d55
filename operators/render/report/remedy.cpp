#include "operators/render/report/remedy.h"

#include "operators/render/report/replay.h"

#include <algorithm>

namespace neumann {

namespace {

// The reflections of the path with the largest contribution to a quantity, from the camera on: for each, whether it is
// by a delta lobe. The last one hit or sampled the light.
std::vector<bool> deltas_of_largest(const Replay& replay, std::size_t quantity) {
    std::vector<bool> path, largest;
    double most = 0.0;
    for (const ReplayedStep& s : replay.steps) {
        if (s.step.from_light) continue;
        const auto reflections = static_cast<std::size_t>(s.step.bounce);
        if (reflections > 0) {
            path.resize(reflections);
            path.back() = s.step.kind == PathStep::Kind::goes_on && s.step.pdf == delta_pdf;
        }
        for (const auto& found : s.found) {
            if (found.quantity != quantity || found.pixel || max_component(found.value) <= most) continue;
            most = max_component(found.value);
            largest = path;
        }
    }
    return largest;
}

}  // namespace

std::vector<Remedy> remedies(const Scene& scene, const PictureSampler& sampler, const SampleName& name, std::size_t quantity) {
    const SamplingSettings& settings = sampler.settings();
    const bool rest = quantity == settings.pictures() - 1;
    if (auto of_method = settings.method->remedies(scene, rest)) return std::move(*of_method);
    const std::vector<bool> is_delta = deltas_of_largest(replay(sampler, name), quantity);
    const auto scatters = [](bool delta) { return !delta; };
    // The place behind the last reflection that is not by a delta lobe.
    const auto last = std::find_if(is_delta.rbegin(), is_delta.rend(), scatters).base();
    if (last == is_delta.begin()) return {};
    const bool has_light_samples = settings.walk.direct.direct == DirectLight::mis;
    if (last == is_delta.end() && !has_light_samples) return {Remedy::sample_lights};
    const auto neighbours = std::adjacent_find(is_delta.begin(), last, [](bool a, bool b) { return !a && !b; });
    if (scene.hide_emitters || (is_delta.front() && neighbours == last)) return {};
    if (rest) return {Remedy::bidirectional, Remedy::more_bounces};
    return {Remedy::bidirectional};
}

}  // namespace neumann
