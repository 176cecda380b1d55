// Chooses one of many lights in proportion to a bound of what it brings, in time logarithmic in their number: a tree of lights,
// each node with a box, a cone of normals and a power (Conty Estevez and Kulla, Importance Sampling of Many Lights with Adaptive
// Tree Splitting, 2018; without the splitting). A choice goes down from the root, to one of two children in proportion to
//
//     power / d² · cos θ'ᵢ · cos θ'ₗ
//
// where d is the distance of the box, at least its radius, and θ'ᵢ and θ'ₗ are the smallest angles with the receiver's normal and
// with the cone that anything in the box may have. A child that cannot be seen from the front is never chosen.
#pragma once

#include "core/base/vec.h"
#include "core/geometry/bounds.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

class LightTree {
public:
    struct Light {
        Bounds bounds;
        double power = 0.0;  // irradiance on a surface that faces it from afar, times the square of the distance
        Vec3 axis{0.0, 0.0, 1.0};
        bool has_normal = false;  // shines on the side of `axis` alone, with the cosine
    };
    struct Choice {
        std::uint32_t light;
        double probability;
        double left;  // a random number that is still uniform in [0, 1)
    };

    LightTree() = default;
    // Lights without power are never chosen.
    explicit LightTree(const std::vector<Light>& lights);

    // The irradiance that all lights together may bring to x; if `normal` is 0, to both sides.
    double importance(const Vec3& x, const Vec3& normal) const { return nodes_.empty() ? 0.0 : importance(nodes_[0], x, normal); }
    // Returns nothing if no light can be seen.
    std::optional<Choice> choose(const Vec3& x, const Vec3& normal, double u) const;
    double probability(std::uint32_t light, const Vec3& x, const Vec3& normal) const;

private:
    // Nodes are in depth-first order: the first child follows its parent.
    struct Node {
        std::array<float, 3> center{}, axis{};
        float radius = 0.0f, power = 0.0f;
        float cosine = 1.0f;  // of the largest angle between a normal and the axis; below −1: lights of all sides
        std::uint32_t parent = 0;
        std::uint32_t second = 0;  // index of the second child; 0: a leaf, of `light`
        std::uint32_t light = 0;
    };
    struct Builder;

    static double importance(const Node& node, const Vec3& x, const Vec3& normal);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> leaves_;  // node of each light
};

}  // namespace neumann
