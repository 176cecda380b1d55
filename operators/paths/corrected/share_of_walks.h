// Shared points carry min(g, c) of what arrives at x from z, with g of operators/paths/walk/coupling.h; walks carry the rest.
#pragma once

#include "operators/paths/corrected/diffuse_sides.h"
#include "operators/paths/corrected/field_raster.h"
#include "operators/paths/walk/coupling.h"

#include <optional>

namespace neumann {

// The share of walks from x, a diffuse side with normal nx, to z, which they leave along wo; `clamp` is c, 0 without points.
// Nothing if no point is at z and no field is read there, so that walks carry all.
inline std::optional<double> share_of_walks(const Materials& materials, const FieldRaster* fields, const Vec3& x, const Vec3& nx,
                                            const SurfacePoint& z, const Vec3& wo, double clamp) {
    const bool front = glm::dot(z.normal, wo) > 0.0;
    if (!fields || !fields->covers(z, front)) return std::nullopt;
    const Vec3 normal = front ? z.normal : -z.normal;
    if (fields->is_smooth(z) && !normals_agree(materials, z, normal, wo)) return std::nullopt;
    const double g = coupling(x, nx, z.position, normal);
    return g > clamp ? 1.0 - clamp / g : 0.0;
}

}  // namespace neumann
