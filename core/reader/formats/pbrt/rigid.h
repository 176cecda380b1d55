// Separates transformations from their scale.
#pragma once

#include "core/base/vec.h"

namespace neumann::reader::pbrt {

struct Rigid {
    Mat4 matrix;
    double scale;
};

// A matrix whose linear part is divided by the length of its first column: a rotation or a reflection, if the matrix
// scales all directions alike.
inline Rigid without_scale(const Mat4& m) {
    Rigid r{m, length_of(Vec3(m[0]))};
    for (int i = 0; i < 3; ++i) r.matrix[i] /= r.scale;
    return r;
}

}  // namespace neumann::reader::pbrt
