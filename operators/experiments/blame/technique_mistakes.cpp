#include "operators/experiments/blame/technique_mistakes.h"

#include "core/base/error.h"
#include "operators/render/methods/method_plan.h"
#include "operators/render/methods/sampling.h"
#include "operators/render/methods/ways.h"

#include <optional>

namespace neumann {

namespace {

struct MissingKind {
    const char *name, *words;
    bool (*is_of)(const Way&);
};
constexpr MissingKind missing_kinds[] = {
    {"no_light_paths",
     "paths from the lights that are joined to the camera are missing (t = 1), and the others have their weights beside them",
     [](const Way& way) { return way.t == 1; }},
    {"no_connections",
     "subpaths from the lights and from the camera are not joined (s, t > 1), and the others have their weights beside them",
     [](const Way& way) { return way.s > 1 && way.t > 1; }},
    {"no_lamp_samples",
     "samples of lamps are missing (s = 1), and the other techniques of bidirectional paths have their weights beside them",
     [](const Way& way) { return way.s == 1; }},
    {"no_hits",
     "directions that hit lamps are missing (s = 0), and the other techniques of bidirectional paths have their weights beside "
     "them",
     [](const Way& way) { return way.s == 0; }},
};

// The techniques share paths; their covariances are small compared with their variances, and are left out.
void add(PictureNoise& sum, const Estimate& way) {
    for (std::size_t p = 0; p < sum.mean.pixels.size(); ++p) {
        sum.mean.pixels[p] += way.mean.pixels[p];
        sum.variance.pixels[p] += way.standard_error.pixels[p] * way.standard_error.pixels[p];
    }
}

std::optional<SamplingSettings> bidirectional_settings(const Scene& scene, std::uint64_t samples, std::uint64_t seed) {
    method::Bidirectional method;
    method.sampler = SamplerKind::independent;
    try {
        SamplingSettings settings = sampling_settings(method, scene, plan_for(method, scene), seed);
        settings.replicate_size = replicate_size(samples);
        return settings;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

}  // namespace

std::vector<WrongPictures> without_techniques(const Scene& scene, const std::vector<BounceRange>& ranges, std::uint64_t samples,
                                              std::uint64_t seed, const Watch& watch) {
    const std::optional<SamplingSettings> settings = bidirectional_settings(scene, samples, seed);
    if (!settings) return {};
    const Image black(scene.film.crop_width, scene.film.crop_height);
    std::vector<WrongPictures> all;
    for (const MissingKind& kind : missing_kinds)
        all.push_back({kind.name, kind.words, std::vector(ranges.size(), PictureNoise{black, black})});
    for (std::size_t r = 0; r < ranges.size(); ++r)
        for (int bounce = ranges[r].first; bounce <= ranges[r].last; ++bounce) {
            const Ways ways = render_ways(scene, *settings, bounce, samples, watch);
            if (watch.stop()) throw Stopped();
            for (const Way& way : ways.ways)
                for (std::size_t k = 0; k < all.size(); ++k)
                    if (!missing_kinds[k].is_of(way)) add(all[k].terms[r], way.weighted.picture);
        }
    return all;
}

}  // namespace neumann
