// Pictures of all directions as pbrt has them: P. Clarberg, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD, 2008. The
// middle of the square is +z, its corners are −z, u and v grow with x and y.
#pragma once

#include "core/base/vec.h"
#include "core/image/texels.h"
#include "core/reader/formats/pbrt/texture_values.h"

#include <memory>

namespace neumann::reader::pbrt {

// A direction's place in the square [0, 1]².
Vec2 square_of_direction(const Vec3& w);
// The inverse.
Vec3 direction_of_square(const Vec2& p);

// The picture as `envmap` has it, with +z of pbrt up (+y there) and pbrt's −y along +z there; twice as wide as the square.
std::shared_ptr<const Texels> to_latitude_longitude(const Picture& square, Importer& importer);
// From the space of that `envmap` to pbrt's.
Mat4 from_envmap();

// ∫ L cosθ over the upper half as pbrt's `illuminance` has it, which is half of that integral.
double illuminance_of(const Picture& square, Importer& importer);

}  // namespace neumann::reader::pbrt
