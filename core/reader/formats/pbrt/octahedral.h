// Pictures of all directions as in pbrt: P. Clarberg, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD, 2008. The
// middle of the square is +z, its corners are −z, and u and v grow with x and y.
#pragma once

#include "core/base/vec.h"
#include "core/image/texels.h"
#include "core/reader/formats/pbrt/texture_values.h"

#include <memory>

namespace neumann::reader::pbrt {

// The place of a direction in the square [0, 1]².
Vec2 square_of_direction(const Vec3& w);
// The inverse of square_of_direction().
Vec3 direction_of_square(const Vec2& p);

// The picture as an `envmap` holds it, with pbrt's +z up (+y there) and pbrt's −y along +z there; it is twice as wide
// as the square.
std::shared_ptr<const Texels> to_latitude_longitude(const Picture& square, Importer& importer);
// The map from the space of that `envmap` to pbrt's.
Mat4 from_envmap();

// The illuminance as pbrt computes it, which is half of the integral ∫ L cosθ over the upper half.
double illuminance_of(const Picture& square, Importer& importer);

}  // namespace neumann::reader::pbrt
