// An orthonormal basis around a unit normal, in which materials live: z is the normal, cosθ is the z component.
#pragma once

#include "core/base/vec.h"

#include <cmath>

namespace neumann {

struct Frame {
    Vec3 s, t, n;

    // Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017. Frame(−n) is (s, −t, −n).
    explicit Frame(const Vec3& normal) : n(normal) {
        const double sign = std::copysign(1.0, n.z);
        const double a = -1.0 / (sign + n.z);
        const double b = n.x * n.y * a;
        s = Vec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
        t = Vec3(b, sign + n.y * n.y * a, -n.y);
    }

    Frame(const Vec3& tangent, const Vec3& bitangent, const Vec3& normal) : s(tangent), t(bitangent), n(normal) {}

    // The same basis seen from the other side of the surface: the tangents stay, so the handedness changes.
    Frame other_side() const { return {s, t, -n}; }

    Vec3 to_local(const Vec3& w) const { return {glm::dot(s, w), glm::dot(t, w), glm::dot(n, w)}; }
    Vec3 to_world(const Vec3& w) const { return s * w.x + t * w.y + n * w.z; }
};

}  // namespace neumann
