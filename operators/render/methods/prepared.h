// What `guided` and `corrected` make ready before their first sample, once for a render: a pilot that tries a method leaves its
// tables or fields to the render that follows.
#pragma once

#include "operators/paths/corrected/approximation.h"
#include "operators/paths/guided/guide.h"
#include "operators/render/methods/method.h"
#include "operators/watch.h"

#include <cstdint>
#include <memory>

namespace neumann {

class Prepared {
public:
    // For a render with this seed, up to this bounce at least.
    explicit Prepared(std::uint64_t seed, int bounces = 0) : seed_(seed), bounces_(bounces) {}

    // Up to this bounce at least, approximately in so many bytes. They hold no reference to the scene, but to its geometry. Throw
    // InputError, and Stopped if `watch` stops them.
    std::shared_ptr<const Guide> guide(const method::Guided& guided, const Scene& scene, int bounces, double memory,
                                       const Watch& watch);
    std::shared_ptr<const Approximation> approximation(const method::Corrected& corrected, const Scene& scene, int bounces,
                                                       double memory, const Watch& watch);
    // Forgets what other methods have made.
    void keep_only(const Method& method);

private:
    std::uint64_t seed_;
    int bounces_;
    std::shared_ptr<const Guide> guide_;
    std::shared_ptr<const Approximation> approximation_;
};

}  // namespace neumann
