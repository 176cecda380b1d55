// The settings of an irradiance cache.
#pragma once

#include <cstdint>

namespace neumann {

// The quantity that determines how far from its place a record is read.
enum class Spacing {
    split_sphere,  // the distances of the surfaces that it sees (Ward, Rubinstein and Clear, A Ray Tracing Solution for
                   // Diffuse Interreflection, 1988)
    hessian        // the change of the gradient of its irradiance (Schwarzhaupt, Jensen and Jarosz, Practical
                   // Hessian-Based Error Control for Irradiance Caching, 2012)
};

struct CacheSettings {
    Spacing spacing = Spacing::hessian;
    // For split_sphere: the radius as a part of the mean distance. For hessian: the relative error of the irradiance
    // that a record gives, as a mean over a disk of usual size around it (RecordPlaces::disk()).
    double accuracy = 0.0;
    std::uint32_t rays = 0;  // of a record in each pass; rounded to a number of cells (hemisphere_cells.h)
};

constexpr double default_accuracy(Spacing spacing) { return spacing == Spacing::split_sphere ? 0.25 : 0.05; }
constexpr std::uint32_t default_rays_of_record = 256;
// A record is read within its radius. For another picture, whose difference is the estimate of the bias, it is read
// within a radius larger by this factor.
constexpr double wider = 1.4142135623730951;

}  // namespace neumann
