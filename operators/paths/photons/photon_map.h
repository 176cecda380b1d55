// A photon map (Jensen, Global Illumination using Photon Maps, 1996): the power that arrives at points on surfaces, with the number
// of the bounce by which it leaves them, so that one map gives all terms. Near a point x,
//
//     K^j Le (x, ωo) ≈ Σ_p fs(ω_p → ωo) Φ_p k(|x_p − x|),   k(d) = 2/(π r²) (1 − d²/r²),   over the photons p of bounce j,
//
// with Epanechnikov's kernel, whose integral over the disk of radius r is 1.
#pragma once

#include "core/geometry/surface_point.h"
#include "core/sampling/warp.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace neumann {

struct Photon {
    glm::vec3 position, normal;  // geometric normal
    glm::vec3 wi;                // towards where the light came from
    glm::vec3 power;             // W: β divided by the number of paths
    std::uint32_t bounce;        // ≥ 1
    std::uint32_t path;          // number in its pass
};

class PhotonMap {
public:
    explicit PhotonMap(std::vector<Photon> photons);
    ~PhotonMap();
    PhotonMap(PhotonMap&&) noexcept;

    const std::vector<Photon>& photons() const { return photons_; }

    struct NearPhoton {
        const Photon* photon;
        double distance2;
    };
    // Finds the photons within the radius that lie on about the same surface as x: with a normal up to 60° from its own
    // or its opposite (meshes may be wound either way; the material knows its sides), and a fifth of the radius at most
    // above or below it. Their order depends only on the map and x. Overwrites `near`.
    void find(const SurfacePoint& x, double radius, std::vector<NearPhoton>& near) const;
    // The distance of the k-th nearest photon; ∞ if there are fewer.
    double distance(const Vec3& x, std::size_t k) const;

private:
    struct Tree;
    std::vector<Photon> photons_;
    std::unique_ptr<const Tree> tree_;
};

// The kernel k(d) for d² ≤ r².
inline double kernel(double distance2, double radius2) { return 2.0 / (pi * radius2) * (1.0 - distance2 / radius2); }

}  // namespace neumann
