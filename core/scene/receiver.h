// The receiver of light that a side of a surface is.
#pragma once

#include "core/emitter/light_sampler.h"
#include "core/material/materials.h"

namespace neumann {

inline Receiver receiver(const SurfaceSide& side) { return {side.p.position, transmits(*side.bsdf) ? Vec3(0.0) : side.p.frame.n}; }

}  // namespace neumann
