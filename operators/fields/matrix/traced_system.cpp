#include "operators/fields/matrix/traced_system.h"

#include "core/base/error.h"
#include "operators/fields/matrix/light_vector.h"
#include "operators/fields/matrix/reflection_matrix.h"
#include "operators/fields/matrix/scene_patches.h"
#include "operators/fields/matrix/sides.h"
#include "operators/fields/patches/patch_memory.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann {

namespace {

// The approximate memory per unknown, and per ray with its entry in T and in the transpose of one channel.
constexpr double bytes_of_unknown = 160.0, bytes_of_ray = 16.0;

}  // namespace

PatchSpace traced_space(const Scene& scene, const TracedSettings& settings, int processes) {
    const double bytes_of_own = bytes_of_ray / processes;
    check_patch_memory(settings.patches, settings.rays, bytes_of_unknown + settings.rays * bytes_of_own, settings.memory);
    PatchSpace space = scene_patches(scene, {.patches = settings.patches, .compared = false});
    if (space.size() == 0) throw InputError("no surface faces another or shines: K is 0 and has no unknowns");
    const double bytes = space.size() * bytes_of_unknown + static_cast<double>(RayTable::size(space, settings.rays)) * bytes_of_own;
    check_patch_memory(settings.patches, settings.rays, bytes / static_cast<double>(space.patches().size()), settings.memory);
    return space;
}

TracedSystem::TracedSystem(const Scene& scene, const TracedSettings& settings, const Watch& watch)
    : scene_(&scene),
      settings_(settings),
      space_(traced_space(scene, settings)),
      table_(RowShare(space_), settings.rays, settings.seed, watch, {}, settings.kept().get()),
      samples_lights_(!scene.emitters.empty() && rays_that_meet_lights(scene, settings.rays) < enough_rays),
      identity_(ReflectionMatrix<1>::identity(space_)) {
    settings_.store = nullptr;
    is_grey(scene) ? fill<1>() : fill<4>();
}

template <int C>
void TracedSystem::fill() {
    const Eigen::Index n = space_.size(), channels = std::min(C, 3);
    const ReflectionMatrix<C> R(scene_->materials, space_);
    for (int c = 0; c < channels; ++c) R_.push_back(R.channel(c));
    emitted_ = emitted_light<C>(*scene_, space_).values().topLeftCorner(channels, n).matrix();
    if (samples_lights_) {
        direct_ = R(arriving_light<C>(*scene_, R, settings_.rays, settings_.seed)).values().topLeftCorner(channels, n).matrix();
        return;
    }
    direct_.resize(channels, n);
    Vector b(n);
    for (int c = 0; c < channels; ++c) {
        channel(c).apply(emitted(c), b);
        direct_.row(c) = b.transpose();
    }
}

std::size_t TracedSystem::rays_that_see_nothing() const {
    return static_cast<std::size_t>(std::count(table_.seen().begin(), table_.seen().end(), space_.nothing()));
}

}  // namespace neumann
