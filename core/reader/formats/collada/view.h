// Views that the file does not give: of the whole scene.
#pragma once

#include "core/geometry/bounds.h"
#include "core/reader/formats/collada/nodes.h"

#include <optional>

namespace neumann::reader::collada {

// A camera that looks at the middle of the scene, three times the radius of the sphere around its box away, as the courses' program
// places it. `from`: the direction in which it stands, not 0; `up`: an axis, 0 to 2. Mitsuba's to_world.
Mat4 view_of(const Bounds& scene, const Vec3& from, int up);

// The direction in which the courses' program places a camera of the file: it adds the place of the camera and its view, in the
// file's units. It reads what there is of a matrix with too few numbers. Nothing if that is zero or unknown.
std::optional<Vec3> course_direction(const Instance& camera);

// In front of the scene, by the custom of the up axis: for files without a camera.
Vec3 front(int up);

}  // namespace neumann::reader::collada
