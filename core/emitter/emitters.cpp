#include "core/emitter/emitters.h"

#include <algorithm>

namespace neumann {

Emitters::Emitters(const Geometry& geometry, std::vector<AreaLight> lights, std::vector<int> light_of_shape)
    : lights_(std::move(lights)), light_of_shape_(std::move(light_of_shape)), density_of_shape_(light_of_shape_.size(), 0.0) {
    double total = 0.0;
    for (std::uint32_t shape = 0; shape < light_of_shape_.size(); ++shape) {
        if (light_of_shape_[shape] == none) continue;
        if (geometry.area(shape) == 0.0) {
            ++without_area_;
            continue;
        }
        const Rgb& radiance = lights_[static_cast<std::size_t>(light_of_shape_[shape])].largest;
        const double brightness = mean_component(radiance);
        if (brightness == 0.0) continue;
        largest_radiance_ = glm::max(largest_radiance_, radiance);
        density_of_shape_[shape] = brightness;
        for (std::uint32_t primitive = 0; primitive < geometry.primitive_count(shape); ++primitive) {
            const double weight = brightness * geometry.area(shape, primitive);
            if (weight == 0.0) continue;
            total += weight;
            primitives_.push_back({shape, primitive});
            cumulative_.push_back(total);
        }
    }
    for (double& c : cumulative_) c /= total;
    for (double& d : density_of_shape_)
        if (d != 0.0) d /= total;
}

}  // namespace neumann
