// How often rays between nearby points and a light were free: learned visibility, for the choice of a light. It is a property of T
// alone, and only the efficiency depends on it.
#pragma once

#include "core/geometry/place_cells.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace neumann {

class LightVisibility {
public:
    // A ray from a point to a light, by its index in Emitters::powers(). `normal` is on the side of the ray.
    struct Ray {
        Vec3 x, normal;
        std::size_t light;
        bool seen;
    };

    // `lights`: the length of Emitters::powers().
    LightVisibility(PlaceCells cells, std::size_t lights, const std::vector<Ray>& learned);

    // The square roots of the probabilities that the lights are seen from near x, by their index, none of which is 0; null where
    // nothing was learned. A sample of f = contribution × V has the least variance if it is chosen in proportion to √E[f²], where
    // E[V²] is the probability. `normal` is 0 if x receives light on both sides.
    const float* weights(const Vec3& x, const Vec3& normal) const;
    std::uint64_t rays() const { return rays_; }

private:
    std::uint64_t key(const Vec3& x, const Vec3& normal) const;

    PlaceCells cells_;
    std::size_t lights_;
    std::uint64_t rays_;
    std::unordered_map<std::uint64_t, std::size_t> rows_;
    std::vector<float> weights_;  // row by row
};

}  // namespace neumann
