// Cuts polygons that are not convex into triangles.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

namespace neumann {

using CornerTriples = std::vector<std::array<std::uint32_t, 3>>;

// A polygon of more than three corners as triangles around its first corner, (0, 1, 2), (0, 2, 3) and so on, which is
// right for convex polygons.
struct Fan {
    std::size_t first_triangle, corners;
};

// Replaces the triangles of polygons that turn to both sides by as many others; the polygons may be a little uneven. One ear after
// the other is cut off (Meisters, Polygons have ears, 1975). A polygon whose outline crosses itself, for which no triangles are
// right, remains a fan. The arrays `beside`, which hold other values of the triangles' corners, change with the triangles.
void cut_fans(const std::vector<Fan>& fans, CornerTriples& triangles, const std::function<Vec3(std::uint32_t corner)>& position,
              std::initializer_list<CornerTriples*> beside = {});

}  // namespace neumann
