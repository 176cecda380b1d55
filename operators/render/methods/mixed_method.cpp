#include "core/base/error.h"
#include "operators/render/from_paths/mixed_sampler.h"
#include "operators/render/from_paths/mixture_pilot.h"
#include "operators/render/methods/ahead.h"
#include "operators/render/methods/candidates.h"
#include "operators/render/methods/method_plan.h"
#include "operators/render/methods/prepared.h"
#include "operators/render/methods/sampling.h"

#include <algorithm>

namespace neumann::method {

namespace {

// The pilot's film is smaller by this factor, but has at least size_of_pilot pixels on its larger side.
constexpr int scale_of_pilot = 4, size_of_pilot = 32;

}  // namespace

std::shared_ptr<const PathMethod> Mixed::prepare(const Preparing& in) const {
    const Scene& scene = in.scene;
    std::vector<MixtureCandidate> all;
    for (const Candidate& candidate : mixture_candidates(*this, scene)) try {
            SamplingSettings own = in.settings;
            own.walk.left_out = plan_for(candidate.method, scene).walk;
            sampling_settings(candidate.method, scene, {}, own.seed);  // throws if the method cannot render the scene
            Prepared prepared(own.seed);
            set_up(candidate.method, scene, own.walk.bounces, in.memory / 2.0, own, prepared, in.watch);
            all.push_back({name_of(candidate.method), own, candidate.price});
        } catch (const InputError&) {
            // Methods other than the walk may refuse a scene: one without surfaces has no patches.
            if (all.empty()) throw;
        }
    const int size = std::max(scene.film.crop_width, scene.film.crop_height);
    Mixture mixture = mix(scene, scene.with(small_film(scene.film, std::max(size / scale_of_pilot, size_of_pilot))), all,
                          adaptive.value_or(LeastError::of_all), in.watch);
    for (const MixtureCandidate& candidate : all) mixture.rays += candidate.settings.method->rays();
    return std::make_shared<const MixedPaths>(std::make_shared<const Mixture>(std::move(mixture)));
}

}  // namespace neumann::method
