// Materials that promise neither to conserve energy nor to be reciprocal: Disney's, and those under normal and bump maps. What they
// do is measured where they stand.
#pragma once

#include "core/scene/scene.h"

namespace neumann {

// Of what is reflected at p, 0 for a reciprocal material and 2 where light goes one way only:
//
//     ∫∫ |fs(ωi → ωo) − fs(ωo → ωi)| cosθi cosθo dωi dωo  /  ∫∫ fs(ωi → ωo) cosθi cosθo dωi dωo
//
// by `count` pairs of directions, of the mean of the channels. Deltas are reciprocal.
double reciprocity_defect(const Bsdf& bsdf, const ShadingPoint& p, std::uint32_t count);

struct MeasuredLaws {
    std::size_t materials = 0;
    double largest_albedo = 0.0;      // as it enters the bounds on the series
    double reciprocity_defect = 0.0;  // the largest of all materials' means over points
    // The shapes on which these were found.
    std::uint32_t brightest = 0, least_reciprocal = 0;
};
MeasuredLaws measure_laws(const Geometry& geometry, const Materials& materials);

}  // namespace neumann
