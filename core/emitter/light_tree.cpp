#include "core/emitter/light_tree.h"

#include "core/sampling/warp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace neumann {

namespace {

constexpr std::uint32_t no_leaf = 0xffffffffu;

// A cone of directions with its half angle in radians; π stands for all directions.
struct Cone {
    Vec3 axis;
    double angle;
};
Cone around_both(const Cone& a, const Cone& b) {
    if (b.angle > a.angle) return around_both(b, a);
    const double between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0, 1.0));
    if (std::min(between + b.angle, pi) <= a.angle) return a;
    const double angle = 0.5 * (a.angle + between + b.angle);
    const Vec3 across = b.axis - a.axis * glm::dot(a.axis, b.axis);
    const double length = glm::length(across);
    // For opposite axes the plane in which to turn is rounding alone.
    constexpr double opposite = 1e-6;
    if (angle >= pi || !(length > opposite)) return {a.axis, pi};
    const double turn = angle - a.angle;
    return {a.axis * std::cos(turn) + across * (std::sin(turn) / length), angle};
}

// cos(max(a − b, 0)) of angles in [0, π].
double cosine_of_difference(double cos_a, double cos_b) {
    if (cos_a >= cos_b) return 1.0;
    return cos_a * cos_b + std::sqrt(std::max(1.0 - cos_a * cos_a, 0.0) * std::max(1.0 - cos_b * cos_b, 0.0));
}

Vec3 as_vec3(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
std::array<float, 3> as_floats(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// The bounds of the lights below a node.
struct Made {
    Bounds bounds;
    Cone cone;
    double power;
    bool all_sides;
};

}  // namespace

struct LightTree::Builder {
    const std::vector<Light>& lights;
    std::vector<Node>& nodes;
    std::vector<std::uint32_t>& leaves;

    Made add(std::span<std::uint32_t> some, std::uint32_t parent) {
        const auto own = static_cast<std::uint32_t>(nodes.size());
        nodes.emplace_back().parent = parent;
        Made made;
        if (some.size() == 1) {
            const Light& light = lights[some[0]];
            nodes[own].light = some[0];
            leaves[some[0]] = own;
            made = {light.bounds, {light.axis, light.has_normal ? 0.0 : pi}, light.power, !light.has_normal};
        } else {
            const std::size_t half = split(some);
            const Made first = add(some.first(half), own);
            nodes[own].second = static_cast<std::uint32_t>(nodes.size());
            const Made second = add(some.subspan(half), own);
            made = first;
            made.bounds.add(second.bounds);
            made.cone = around_both(first.cone, second.cone);
            made.power += second.power;
            made.all_sides = first.all_sides || second.all_sides;
        }
        Node& node = nodes[own];
        // The sphere around the box must still hold it when rounded to floats, and the cone its normals.
        node.center = as_floats(made.bounds.center());
        const Vec3 center = as_vec3(node.center);
        const double far = glm::length(glm::max(glm::abs(center - made.bounds.low), glm::abs(made.bounds.high - center)));
        constexpr double rounding = 1e-6;
        node.radius = static_cast<float>(far * (1.0 + rounding)) + std::numeric_limits<float>::min();
        node.axis = as_floats(made.cone.axis);
        node.cosine = made.all_sides ? -2.0f : static_cast<float>(std::cos(std::min(made.cone.angle + rounding, pi)) - rounding);
        node.power = static_cast<float>(made.power);
        return made;
    }

    // Splits across the widest axis of the lights' centres, or anywhere if these are in one place.
    std::size_t split(std::span<std::uint32_t> some) const {
        Bounds centers;
        for (const std::uint32_t light : some) centers.add(lights[light].bounds.center());
        const Vec3 extent = centers.high - centers.low;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const std::size_t half = some.size() / 2;
        std::ranges::nth_element(some, some.begin() + static_cast<std::ptrdiff_t>(half), {},
                                 [&](std::uint32_t light) { return std::pair(lights[light].bounds.center()[axis], light); });
        return half;
    }
};

LightTree::LightTree(const std::vector<Light>& lights) : leaves_(lights.size(), no_leaf) {
    std::vector<std::uint32_t> some;
    for (std::uint32_t light = 0; light < lights.size(); ++light)
        if (lights[light].power > 0.0) some.push_back(light);
    if (some.empty()) return;
    nodes_.reserve(2 * some.size() - 1);
    Builder{lights, nodes_, leaves_}.add(some, 0);
}

double LightTree::importance(const Node& node, const Vec3& x, const Vec3& normal) {
    const Vec3 d = as_vec3(node.center) - x;
    const double distance2 = glm::dot(d, d), radius = node.radius, nearest2 = std::max(distance2, radius * radius);
    if (distance2 <= radius * radius) return node.power / nearest2;
    const double distance = std::sqrt(distance2), sine = radius / distance, cosine = std::sqrt(1.0 - sine * sine);
    const Vec3 w = d / distance;
    double result = node.power / nearest2;
    if (node.cosine >= -1.0f) {
        const double of_cone = cosine_of_difference(-glm::dot(as_vec3(node.axis), w), node.cosine);
        result *= std::max(cosine_of_difference(of_cone, cosine), 0.0);
    }
    if (normal != Vec3(0.0)) result *= std::max(cosine_of_difference(glm::dot(normal, w), cosine), 0.0);
    return result;
}

std::optional<LightTree::Choice> LightTree::choose(const Vec3& x, const Vec3& normal, double u) const {
    if (nodes_.empty()) return std::nullopt;
    double probability = 1.0;
    std::uint32_t node = 0;
    while (nodes_[node].second != 0) {
        const double first = importance(nodes_[node + 1], x, normal), second = importance(nodes_[nodes_[node].second], x, normal);
        if (!(first + second > 0.0)) return std::nullopt;
        const double share = first / (first + second);
        const bool takes_first = u < share;
        u = takes_first ? u / share : (u - share) / (1.0 - share);
        probability *= takes_first ? share : 1.0 - share;
        node = takes_first ? node + 1 : nodes_[node].second;
    }
    return Choice{nodes_[node].light, probability, std::clamp(u, 0.0, 0x1.fffffffffffffp-1)};
}

double LightTree::probability(std::uint32_t light, const Vec3& x, const Vec3& normal) const {
    std::uint32_t node = light < leaves_.size() ? leaves_[light] : no_leaf;
    if (node == no_leaf) return 0.0;
    double probability = 1.0;
    while (node != 0) {
        const std::uint32_t parent = nodes_[node].parent;
        const double first = importance(nodes_[parent + 1], x, normal),
                     second = importance(nodes_[nodes_[parent].second], x, normal);
        if (!(first + second > 0.0)) return 0.0;
        const double share = first / (first + second);
        probability *= node == parent + 1 ? share : 1.0 - share;
        node = parent;
    }
    return probability;
}

}  // namespace neumann
