#include "core/material/materials.h"

namespace neumann {

namespace {

template <class Bound>
Rgb largest(const std::vector<Bsdf>& bsdfs, const std::vector<Materials::Sides>& sides_of_shape, const Bound& bound) {
    Rgb largest(0.0);
    for (const Materials::Sides& sides : sides_of_shape)
        for (const int index : {sides.front, sides.back})
            if (index != Materials::absorbing) largest = glm::max(largest, bound(bsdfs[static_cast<std::size_t>(index)]));
    return largest;
}

}  // namespace

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
    return largest(bsdfs_, sides_of_shape_, [](const Bsdf& b) { return neumann::largest_albedo(b); });
}
Rgb Materials::largest_basic_albedo() const {
    return largest(bsdfs_, sides_of_shape_, [](const Bsdf& b) { return neumann::largest_basic_albedo(b); });
}

bool has_specular(const Materials& materials) {
    return std::ranges::any_of(materials.bsdfs(), [](const Bsdf& b) { return lobe(b).kind == Lobe::Kind::specular; });
}

}  // namespace neumann
