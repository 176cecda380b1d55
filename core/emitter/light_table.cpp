#include "core/emitter/light_table.h"

namespace neumann {

LightTable::LightTable(const Geometry& geometry, const Emitters& emitters, const std::vector<double>& share) {
    if (std::all_of(share.begin(), share.end(), [](double s) { return s == 0.0; })) return;
    const auto add = [&](double s) { cumulative_.push_back((cumulative_.empty() ? 0.0 : cumulative_.back()) + s); };
    const std::size_t shapes = geometry.shapes().size();
    for (std::uint32_t shape = 0; shape < shapes; ++shape) {
        if (share[shape] == 0.0) continue;
        const std::size_t first = parts_.size();
        for (std::uint32_t primitive = 0; primitive < geometry.primitive_count(shape); ++primitive)
            if (const double area = geometry.area(shape, primitive); area > 0.0) {
                parts_.push_back({shape, primitive});
                add(share[shape] / geometry.area(shape) * area);
            }
        lights_.push_back({first, cumulative_.size()});
    }
    for (std::size_t i = shapes; i < emitters.powers().size(); ++i) {
        add(share[i]);
        if (share[i] > 0.0) lights_.push_back({cumulative_.size() - 1, cumulative_.size()});
    }
    // Sums of rounded numbers; the last is 1.
    const double all = cumulative_.back();
    for (double& c : cumulative_) c /= all;
}

}  // namespace neumann
