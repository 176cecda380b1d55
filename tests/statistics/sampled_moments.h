// The moments of a picture over replicates.
#pragma once

#include "operators/render/from_paths/picture_sampler.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace neumann {

inline SeriesMoments::Result sample(const Scene& scene, const SamplingSettings& settings, std::uint64_t replicates) {
    const PictureSampler sampler(scene, settings);
    Tally tally(sampler.quantities());
    SeriesMoments moments(sampler.width(), sampler.height(), sampler.quantities());
    moments.add(*sampler.run(0, replicates, tally));
    EXPECT_EQ(tally.non_finite_samples(), 0u);
    return moments.result();
}

}  // namespace neumann
