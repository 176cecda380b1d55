#include "operators/fields/matrix/sides.h"

#include "core/base/error.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann {

namespace {

constexpr std::uint32_t coarsest = 4, finest = 16;

// Slopes of roughness α turn a reflected direction by about 2α to either side, and cells are 2/k wide; k gives four cells per lobe.
std::uint32_t directions_of(const Bsdf& bsdf) {
    const Lobe lobe = neumann::lobe(bsdf);
    if (lobe.kind == Lobe::Kind::diffuse) return 1;
    std::uint32_t k = coarsest;
    while (k < finest && k * lobe.alpha < 2.0) k *= 2;
    return k;
}

// Whether the material does not transmit light, or transmits it reciprocally with one refractive index.
bool passes_as_glass(const Bsdf& bsdf) {
    const bool mixes = std::holds_alternative<Mask>(bsdf) || std::holds_alternative<Blend>(bsdf);
    return !transmits(bsdf) || (is_lawful(bsdf) && !(mixes && refractive_ratio(bsdf) != 1.0));
}

[[noreturn]] void refuse(const Scene& scene, std::uint32_t shape, const std::string& why) {
    if (shape >= scene.origins.size()) throw InputError(fmt::format("the material of shape {} {}", shape, why));
    const Origin& origin = scene.origins[shape];
    throw InputError(origin.place, fmt::format("{} of {} {}", origin.bsdf, origin.shape, why));
}

void check(const Scene& scene, std::uint32_t shape, const Bsdf& bsdf) {
    if (!passes_as_glass(bsdf))
        refuse(scene, shape, "lets light through otherwise than glass does, which patches do not hold, and walk does");
    if (!factors(bsdf))
        refuse(scene, shape, "varies by more than a factor of its reflectance, which patches do not hold, and walk does");
    if (needs_coordinates(white(bsdf))) refuse(scene, shape, "is anisotropic, which patches do not hold, and walk does");
}

}  // namespace

double refractive_index(const Bsdf* side) { return side ? std::max(1.0, 1.0 / refractive_ratio(*side)) : 1.0; }

bool is_glossy(const Bsdf* side) { return side && lobe(*side).kind != Lobe::Kind::diffuse; }

namespace {

template <class Predicate>
bool any_side(const Scene& scene, const Predicate& holds) {
    for (std::uint32_t shape = 0; shape < scene.geometry.shapes().size(); ++shape)
        for (const bool front : {true, false})
            if (const Bsdf* bsdf = scene.materials.at(shape, front); bsdf && holds(bsdf)) return true;
    return false;
}

}  // namespace

Glossy glossy_of_pictures(const Scene& scene) {
    const bool some_go_on = any_side(scene, [](const Bsdf*bsdf) { return is_glossy(bsdf); }),
               some_end = any_side(scene, [](const Bsdf*bsdf) { return !is_glossy(bsdf); });
    return some_go_on && some_end ? Glossy::by_rays : Glossy::in_cells;
}

bool has_glossy_lights(const Scene& scene) {
    for (std::uint32_t shape = 0; shape < scene.geometry.shapes().size(); ++shape)
        if (scene.emitters.is_emitter(shape) && is_glossy(scene.materials.at(shape, true))) return true;
    return false;
}

std::vector<SideDirections> side_directions(const Scene& scene, Glossy glossy) {
    std::vector<SideDirections> sides;
    const bool lit_from_elsewhere = scene.emitters.has_environment() || scene.emitters.has_delta_lights();
    for (std::uint32_t shape = 0; shape < scene.geometry.shapes().size(); ++shape) {
        const bool emits = scene.emitters.is_emitter(shape);
        const Bsdf *front = scene.materials.at(shape, true), *back = scene.materials.at(shape, false);
        const auto directions = [&](const Bsdf* bsdf, bool shines) -> std::uint32_t {
            if (!bsdf) return shines ? 1 : 0;
            if (glossy == Glossy::by_rays && is_glossy(bsdf)) return 0;
            check(scene, shape, *bsdf);
            return directions_of(*bsdf);
        };
        sides.push_back({directions(front, emits), directions(back, false), emits, lit_from_elsewhere, refractive_index(front),
                         refractive_index(back)});
    }
    return sides;
}

bool is_grey(const Scene& scene) {
    const auto& bsdfs = scene.materials.bsdfs();
    return scene.emitters.is_grey() && std::all_of(bsdfs.begin(), bsdfs.end(), [](const Bsdf& b) { return is_grey(b); });
}

}  // namespace neumann
