// Pictures by a sampler whose settings no method has.
#pragma once

#include "operators/render/from_paths/picture_sampler.h"

namespace neumann::physics {

struct Pictures {
    SeriesMoments::Result result;
    Tally tally;
};

// `replicates`: a power of two.
inline Pictures render(const Scene& scene, const PictureSampler::Settings& settings, std::uint64_t replicates) {
    const PictureSampler sampler(scene, settings);
    Tally tally(sampler.quantities());
    SeriesMoments moments(sampler.width(), sampler.height(), sampler.quantities());
    moments.add(*sampler.run(0, replicates, tally));
    return {moments.result(), std::move(tally)};
}

}  // namespace neumann::physics
