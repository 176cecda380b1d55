// Polygons that are not convex as triangles.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <cstdint>
#include <vector>

namespace neumann::reader::collada {

// Triangles of a polygon's corners, as many as a fan has, for one that turns to both sides; it may be a little uneven. Empty if a
// fan around its first corner is right, or if nothing is, because its outline crosses itself. One ear after the other is cut off
// (Meisters, Polygons have ears, 1975).
std::vector<std::array<std::uint32_t, 3>> cut_ears(const std::vector<Vec3>& corners);

}  // namespace neumann::reader::collada
