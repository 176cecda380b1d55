#include "operators/render/methods/mixed_method.h"

#include "core/base/error.h"
#include "operators/paths/corrected/approximation.h"
#include "operators/paths/guided/guide.h"
#include "operators/render/from_paths/mixture_pilot.h"
#include "operators/render/methods/ahead.h"
#include "operators/render/methods/candidates.h"
#include "operators/render/methods/method_plan.h"
#include "operators/render/methods/sampling.h"

#include <algorithm>

namespace neumann {

namespace {

// The pilot's film is so much smaller, but has at least so many pixels on its larger side.
constexpr int scale_of_pilot = 4, size_of_pilot = 32;

}  // namespace

Mixture make_mixture(const method::Mixed& mixed, const Scene& scene, const SamplingSettings& settings, double memory,
                     const Watch& watch) {
    std::vector<MixtureCandidate> all;
    for (const Candidate& candidate : mixture_candidates(mixed, scene)) try {
            SamplingSettings own = settings;
            own.generator = sampling_settings(candidate.method, scene, {}, settings.seed).generator;
            own.walk.left_out = plan_for(candidate.method, scene).walk;
            Prepared prepared(settings.seed);
            set_up(candidate.method, scene, settings.walk.bounces, memory / 2.0, own, prepared, watch);
            all.push_back({name_of(candidate.method), own, candidate.price});
        } catch (const InputError&) {
            // Others refuse what the walk does not: a scene without surfaces has no patches.
            if (all.empty()) throw;
        }
    const int size = std::max(scene.film.crop_width, scene.film.crop_height);
    Mixture mixture = mix(scene, scene.with(small_film(scene.film, std::max(size / scale_of_pilot, size_of_pilot))), all,
                          mixed.adaptive.value_or(LeastError::of_all), watch);
    for (const MixtureCandidate& candidate : all) {
        if (candidate.settings.guide) mixture.rays += candidate.settings.guide->rays();
        if (candidate.settings.approximation) mixture.rays += candidate.settings.approximation->rays();
    }
    return mixture;
}

}  // namespace neumann
