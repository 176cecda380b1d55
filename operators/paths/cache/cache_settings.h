// The settings of an irradiance cache.
#pragma once

#include <cstdint>

namespace neumann {

// What says how far from its place a record is read.
enum class Spacing {
    split_sphere,  // the distances of what it sees (Ward, Rubinstein and Clear, A Ray Tracing Solution for Diffuse
                   // Interreflection, 1988)
    hessian        // how fast the gradient of its irradiance changes (Schwarzhaupt, Jensen and Jarosz, Practical Hessian-Based
                   // Error Control for Irradiance Caching, 2012)
};

struct CacheSettings {
    Spacing spacing = Spacing::hessian;
    // split_sphere: the radius as a part of the mean distance. hessian: the relative error of what a record says, as a mean over a
    // disk of usual size around it (RecordPlaces::disk()).
    double accuracy = 0.0;
    std::uint32_t rays = 0;  // of a record, in each pass; as many as cells (hemisphere_cells.h) have about that number
};

constexpr double default_accuracy(Spacing spacing) { return spacing == Spacing::split_sphere ? 0.25 : 0.05; }
constexpr std::uint32_t default_rays_of_record = 256;
// A record is read within its radius; and within a radius this much larger for another picture, whose difference tells the bias.
constexpr double wider = 1.4142135623730951;

}  // namespace neumann
