// Measures energy conservation and reciprocity of materials that guarantee neither (Disney's, and those under normal and bump
// maps), on the shapes that use them.
#pragma once

#include "core/scene/scene.h"

namespace neumann {

// The relative violation of reciprocity at p: 0 for a reciprocal material, 2 if light travels one way only:
//
//     ∫∫ |fs(ωi → ωo) − fs(ωo → ωi)| cosθi cosθo dωi dωo  /  ∫∫ fs(ωi → ωo) cosθi cosθo dωi dωo
//
// estimated with `count` pairs of directions, for the mean of the channels. Delta lobes are reciprocal.
double reciprocity_defect(const Bsdf& bsdf, const ShadingPoint& p, std::uint32_t count);

struct MeasuredLaws {
    std::size_t materials = 0;
    double largest_albedo = 0.0;      // as used in the bounds on the series
    double reciprocity_defect = 0.0;  // mean over points, maximum over materials
    // The shapes on which the two maxima were found.
    std::uint32_t brightest = 0, least_reciprocal = 0;
};
MeasuredLaws measure_laws(const Geometry& geometry, const Materials& materials);

}  // namespace neumann
