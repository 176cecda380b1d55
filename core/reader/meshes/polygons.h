// Polygons that are not convex as triangles.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

namespace neumann {

using CornerTriples = std::vector<std::array<std::uint32_t, 3>>;

// A polygon of more than three corners, as triangles around its first: (0, 1, 2), (0, 2, 3) and so on, which is right for convex
// ones.
struct Fan {
    std::size_t first_triangle, corners;
};

// Makes other triangles, as many, of polygons that turn to both sides; they may be a little uneven. One ear after the other is cut
// off (Meisters, Polygons have ears, 1975). A polygon whose outline crosses itself, of which nothing is right, remains a fan. What
// else the triangles have, corner by corner, goes along `beside` them.
void cut_fans(const std::vector<Fan>& fans, CornerTriples& triangles, const std::function<Vec3(std::uint32_t corner)>& position,
              std::initializer_list<CornerTriples*> beside = {});

}  // namespace neumann
