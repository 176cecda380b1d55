#include "core/material/materials.h"

namespace neumann {

Materials::Materials(std::vector<Bsdf> bsdfs, std::vector<Sides> sides_of_shape, std::shared_ptr<const std::vector<Shape>> shapes)
    : bsdfs_(std::move(bsdfs)), sides_of_shape_(std::move(sides_of_shape)), shapes_(std::move(shapes)) {
    for (std::uint32_t shape = 0; shape < sides_of_shape_.size(); ++shape) {
        bool flat = !has_smooth_normals((*shapes_)[shape]);
        for (const bool front : {true, false})
            if (const Bsdf* bsdf = at(shape, front)) flat = flat && !needs_coordinates(*bsdf);
        is_flat_.push_back(flat);
    }
}

Rgb Materials::largest_albedo() const {
    Rgb largest(0.0);
    for (const Sides& sides : sides_of_shape_)
        for (const int index : {sides.front, sides.back})
            if (index != absorbing) largest = glm::max(largest, neumann::largest_albedo(bsdfs_[static_cast<std::size_t>(index)]));
    return largest;
}

}  // namespace neumann
