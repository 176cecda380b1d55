// The pictures that a path tracer makes with a mistake: those of mistake_kinds(), all sampled along the same paths. A
// mistake multiplies the contribution of a path by a factor that depends on its vertices, so that one walk gives a
// sample of every wrong picture.
#pragma once

#include "core/scene/scene.h"
#include "operators/experiments/blame/difference_test.h"
#include "operators/experiments/blame/mistake_kinds.h"
#include "operators/experiments/blame/other_pictures.h"
#include "operators/watch.h"

#include <cstdint>
#include <string>
#include <vector>

namespace neumann {

struct WrongTerms {
    const MistakeKind* kind;
    // Light samples and directions that hit lamps, or one of the two alone.
    DirectLight direct_light = DirectLight::mis;
    double limit = 0.0;                    // for `clamped`: the limit in units of the mean of the range in which it begins
    std::vector<PictureNoise> terms = {};  // for each of the ranges

    Mistake mistake() const { return kind->mistake; }
};

// What is sampled. Roulette and limits begin with `ranges[begins]`; pixels are joined by `factor` (joined_pixels.h).
struct WrongPaths {
    std::vector<BounceRange> ranges;
    std::size_t begins = 0;
    int factor = 1;
    bool (*is_wanted)(Mistake) = [](Mistake) { return true; };

    bool operator==(const WrongPaths&) const = default;
};

// Samples the pictures of the mistakes that are wanted, `samples` paths for each pixel of the film. Throws Stopped.
std::vector<WrongTerms> wrong_terms(const Scene& scene, const WrongPaths& wanted, int samples, std::uint64_t seed,
                                    const Watch& watch = {});

}  // namespace neumann
