#include "operators/paths/corrected/diffuse_sides.h"

namespace neumann {

namespace {

// The part of the largest albedo of a material that a patch of it reflects on average, roughly.
constexpr double share_of_albedo = 0.5;

Bsdf diffuse_like(const Bsdf& bsdf) {
    if (std::holds_alternative<Diffuse>(bsdf)) return bsdf;
    return Diffuse(glm::min(largest_basic_albedo(bsdf), Rgb(1.0)) * share_of_albedo);
}

}  // namespace

DiffuseSides::DiffuseSides(const Scene& scene, Normals normals) {
    const auto shapes = static_cast<std::uint32_t>(scene.geometry.shapes().size());
    for (std::uint32_t shape = 0; shape < shapes; ++shape)
        for (const bool front : {true, false}) {
            const Bsdf* bsdf = scene.materials.at(shape, front);
            const auto* diffuse = bsdf ? std::get_if<Diffuse>(bsdf) : nullptr;
            const bool has = diffuse && !is_black(diffuse->largest_albedo()) &&
                             (normals == Normals::any || !has_smooth_normals(scene.geometry.shapes()[shape]));
            sides_.push_back(has);
            if (has) empty_ = false;
        }
}

Scene with_diffuse_materials(const Scene& scene) {
    std::vector<Bsdf> bsdfs;
    std::vector<Materials::Sides> sides(scene.geometry.shapes().size());
    for (const Bsdf& bsdf : scene.materials.bsdfs()) bsdfs.push_back(diffuse_like(bsdf));
    const auto index = [&](std::uint32_t shape, bool front) {
        const Bsdf* bsdf = scene.materials.at(shape, front);
        return bsdf ? static_cast<int>(bsdf - scene.materials.bsdfs().data()) : Materials::absorbing;
    };
    for (std::uint32_t shape = 0; shape < sides.size(); ++shape) sides[shape] = {index(shape, true), index(shape, false)};
    return scene.with(Materials(std::move(bsdfs), std::move(sides), scene.geometry.shared_shapes()));
}

}  // namespace neumann
