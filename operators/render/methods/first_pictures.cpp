#include "operators/render/methods/first_pictures.h"

#include "core/base/error.h"
#include "operators/render/from_fields/field_rendering.h"
#include "operators/render/methods/ahead.h"
#include "operators/statistics/joined_neighbours.h"

#include <algorithm>

namespace neumann {

namespace {

constexpr std::uint64_t stream = 0x66697273ull;  // differs from the seed of the pictures
constexpr int most_pixels = 192, bounces = 6;
constexpr std::size_t most_shapes = 20'000;

bool shows_fields_first(const Method& method) {
    return std::visit(
        []<class M>(const M&) {
            if constexpr (MakesPaths<M>) return M::shows_fields_first;
            return false;
        },
        method);
}

}  // namespace

void show_first_pictures(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch) {
    if (!watch.show || goal.colors || !shows_fields_first(method) || scene.geometry.shapes().size() > most_shapes) return;
    FieldSettings settings;
    settings.bounces = std::min(goal.bounces.value_or(scene.bounces.value_or(bounces)), bounces);
    if (expected_rays(with_default_limits(goal), scene.film, settings.bounces) < rays_of_a_long_render) return;
    settings.patching.patches = 1000;
    settings.rays = 64;
    settings.samples = 2;
    settings.replicates = 4;
    settings.seed = goal.seed ^ stream;
    settings.rest = false;
    try {
        const auto pictures = render_fields(scene.with(small_film(scene.film, most_pixels)), settings, {.stop = watch.stop});
        if (pictures) watch.show(pictures->bounces(), [&](std::size_t i) { return joined_neighbours(pictures->term(i)); });
    } catch (const InputError&) {
        // Fields cannot render some scenes, such as those without surfaces.
    }
}

}  // namespace neumann
