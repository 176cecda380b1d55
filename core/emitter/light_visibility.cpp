#include "core/emitter/light_visibility.h"

#include <cmath>

namespace neumann {

namespace {

// One of 27 groups of normals, so that rounding does not part the normals of a wall along an axis.
std::uint64_t facing(const Vec3& normal) {
    std::uint64_t code = 0;
    for (int k = 0; k < 3; ++k) code = 3 * code + (normal[k] > 0.5 ? 2u : normal[k] < -0.5 ? 0u : 1u);
    return code;
}

}  // namespace

LightVisibility::LightVisibility(PlaceCells cells, std::size_t lights, const std::vector<Ray>& learned)
    : cells_(cells), lights_(lights), rays_(learned.size()) {
    struct Count {
        std::uint32_t rays = 0, seen = 0;
    };
    std::vector<Count> counts;
    for (const Ray& ray : learned)
        for (const Vec3& normal : {ray.normal, Vec3(0.0)}) {
            const auto [row, is_new] = rows_.try_emplace(key(ray.x, normal), rows_.size());
            if (is_new) counts.resize(counts.size() + lights_);
            Count& count = counts[row->second * lights_ + ray.light];
            ++count.rays;
            count.seen += ray.seen;
        }
    // The mean of the probability if every value of it was alike before.
    for (const Count& c : counts) weights_.push_back(static_cast<float>(std::sqrt((c.seen + 1.0) / (c.rays + 2.0))));
}

std::uint64_t LightVisibility::key(const Vec3& x, const Vec3& normal) const { return cells_.cell(x, facing(normal)); }

const float* LightVisibility::weights(const Vec3& x, const Vec3& normal) const {
    const auto row = rows_.find(key(x, normal));
    return row == rows_.end() ? nullptr : weights_.data() + row->second * lights_;
}

}  // namespace neumann
