// An affine map of texture coordinates: Mitsuba's `to_uv`, of which the third dimension is left out.
#pragma once

#include "core/base/vec.h"

namespace neumann {

class UvTransform {
public:
    explicit UvTransform(const Mat4& m) : u_(m[0][0], m[0][1]), v_(m[1][0], m[1][1]), origin_(m[3][0], m[3][1]) {}

    Vec2 operator()(const Vec2& uv) const { return u_ * uv.x + v_ * uv.y + origin_; }
    // The derivatives by u and v of a function of the transformed coordinates; `s` are those by the transformed coordinates.
    Vec2 slope(const Vec2& s) const { return {glm::dot(u_, s), glm::dot(v_, s)}; }

private:
    Vec2 u_, v_, origin_;
};

}  // namespace neumann
