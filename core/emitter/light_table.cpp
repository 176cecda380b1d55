#include "core/emitter/light_table.h"

#include <algorithm>
#include <utility>

namespace neumann {

LightTable::LightTable(const Geometry& geometry, const Emitters& emitters, const std::vector<double>& share, Rectangles rectangles)
    : geometry_(&geometry) {
    if (std::all_of(share.begin(), share.end(), [](double s) { return s == 0.0; })) return;
    const auto add = [&](double s) { cumulative_.push_back((cumulative_.empty() ? 0.0 : cumulative_.back()) + s); };
    const std::size_t shapes = geometry.shapes().size();
    for (std::uint32_t shape = 0; shape < shapes; ++shape) {
        if (share[shape] == 0.0) continue;
        const std::size_t first = parts_.size();
        const auto* mesh = rectangles == Rectangles::whole ? std::get_if<TriangleMesh>(&geometry.shapes()[shape]) : nullptr;
        for (std::uint32_t primitive = 0; primitive < geometry.primitive_count(shape); ++primitive) {
            Part part{shape, primitive};
            if (const auto rectangle = mesh ? rectangle_of(*mesh, primitive) : std::nullopt) {
                part.rectangle = static_cast<std::uint32_t>(rectangles_.size());
                rectangles_.push_back(*rectangle);
                rectangular_.resize(shapes);
                auto& of_primitive = rectangular_[shape];
                of_primitive.resize(mesh->triangles.size(), Part{shape, 0});
                of_primitive[primitive] = of_primitive[primitive + 1] = part;
                ++primitive;
            }
            if (const double a = area(part); a > 0.0) {
                parts_.push_back(part);
                add(share[shape] / emitters.area(shape) * a);
            }
        }
        lights_.push_back({first, cumulative_.size()});
    }
    for (std::size_t i = shapes; i < emitters.powers().size(); ++i) {
        add(share[i]);
        if (share[i] > 0.0) lights_.push_back({cumulative_.size() - 1, cumulative_.size()});
    }
    // Normalises the sums, which have rounding errors, so that the last is 1.
    const double all = cumulative_.back();
    for (double& c : cumulative_) c /= all;
}

LightTable::Part LightTable::part_at(const SurfacePoint& y) const {
    if (!rectangular_.empty() && !rectangular_[y.shape].empty())
        if (const Part& part = rectangular_[y.shape][y.primitive]; part.is_rectangle()) return part;
    return {y.shape, y.primitive};
}

std::size_t LightTable::index_of(const Part& part) const {
    const auto found = std::ranges::lower_bound(parts_, std::pair(part.shape, part.primitive), {},
                                                [](const Part& p) { return std::pair(p.shape, p.primitive); });
    return static_cast<std::size_t>(found - parts_.begin());
}

double LightTable::area(const Part& part) const {
    const double one = geometry_->area(part.shape, part.primitive);
    return part.is_rectangle() ? one + geometry_->area(part.shape, part.primitive + 1) : one;
}

}  // namespace neumann
