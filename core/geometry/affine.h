// How an affine map acts on points, vectors and normals.
#pragma once

#include "core/base/vec.h"

namespace neumann {

inline Vec3 transformed_point(const Mat4& m, const Vec3& p) { return Vec3(m * glm::dvec4(p, 1.0)); }
inline Vec3 transformed_vector(const Mat4& m, const Vec3& v) { return Vec3(m * glm::dvec4(v, 0.0)); }

// The largest entry of the linear part, and the linear part over it, whose products are representable.
inline double largest_entry(const Mat4& m) {
    return max_component(
        {max_component(glm::abs(Vec3(m[0]))), max_component(glm::abs(Vec3(m[1]))), max_component(glm::abs(Vec3(m[2])))});
}
inline glm::dmat3 scaled_to_one(const Mat4& m) { return glm::dmat3(m) / largest_entry(m); }

inline bool is_mirroring(const Mat4& m) { return glm::determinant(scaled_to_one(m)) < 0.0; }
// The map is up to a positive factor; normals stay on their side, also if m mirrors.
inline glm::dmat3 map_of_normals(const Mat4& m) { return glm::transpose(glm::inverse(scaled_to_one(m))); }

}  // namespace neumann
