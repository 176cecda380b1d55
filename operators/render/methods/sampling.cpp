#include "operators/render/methods/sampling.h"

#include "core/base/error.h"
#include "operators/paths/cache/record_places.h"
#include "operators/paths/photons/photon_pilot.h"
#include "operators/paths/walk/direct_light.h"
#include "operators/paths/walk/tree_ratios.h"
#include "operators/render/methods/ahead.h"
#include "operators/render/methods/method_options.h"
#include "operators/render/methods/mixed_method.h"

#include <fmt/format.h>

#include <stdexcept>

namespace neumann {

namespace {

constexpr int tree_width = 32;  // of the pilot of --tree, in pixels
// That use each other's tails with --reuse: more of them cost more rays than they save, in most scenes
// (tests/bench/bench_reuse.cpp).
constexpr std::uint32_t reusing_pixels = 8;

template <class M>
PathGenerator kind() {
    if constexpr (std::same_as<M, method::Walk>) return PathGenerator::walk;
    if constexpr (std::same_as<M, method::Guided>) return PathGenerator::guided;
    if constexpr (std::same_as<M, method::Corrected>) return PathGenerator::corrected;
    if constexpr (std::same_as<M, method::Surface>) return PathGenerator::surface;
    if constexpr (std::same_as<M, method::Light>) return PathGenerator::light;
    if constexpr (std::same_as<M, method::Bidirectional>) return PathGenerator::bidirectional;
    if constexpr (std::same_as<M, method::Photon>) return PathGenerator::photon;
    if constexpr (std::same_as<M, method::Cache>) return PathGenerator::cache;
    if constexpr (std::same_as<M, method::Metropolis>) return PathGenerator::metropolis;
    if constexpr (std::same_as<M, method::Mixed>) return PathGenerator::mixed;
    if constexpr (std::same_as<M, method::Classic>) return PathGenerator::classic;
    return PathGenerator::pointwise;
}

void expect_in_reach(const DirectLightSettings& direct, const Emitters& emitters) {
    if (misses_light(direct.direct, emitters))
        throw InputError(
            fmt::format("--direct {} cannot find {}, of which the scene has some; take --direct mis or light", name_of(direct),
                        emitters.has_delta_lights() ? "lights without extent (directional, directionalarea, point, projector, spot)"
                                                    : "light from infinitely far away (constant, envmap, sunsky)"));
}

template <MakesPaths M>
SamplingSettings settings_of(const M& m, const Scene& scene) {
    SamplingSettings settings;
    settings.generator = kind<M>();
    if (settings.generator == PathGenerator::pointwise && scene.emitters.has_delta_lights())
        throw InputError(
            "--method pointwise finds lights by chance, and no ray meets a light without extent (directional, directionalarea, "
            "point, projector, spot), of which the scene has some; take --method walk, matrix or gather");
    if (scene.hide_emitters && (splats(settings.generator) || settings.generator == PathGenerator::metropolis))
        throw InputError(
            fmt::format("--method {} cannot hide emitters, as the scene's integrator asks for; take --method walk", M::name));
    if (settings.generator == PathGenerator::light && !scene.camera.can_be_joined())
        throw InputError(
            "--method light joins its paths to the sensor, and none meets a single ray, that of a 'radiancemeter' or of a "
            "'distant' sensor with a point as target; take --method walk");
    if constexpr (requires { m.direct; }) {
        expect_in_reach(m.direct, scene.emitters);
        settings.walk.direct = m.direct;
    }
    // Neither finds lights by directions of its own, but in mirrors.
    if (settings.generator == PathGenerator::surface || settings.generator == PathGenerator::classic)
        settings.walk.direct = {.direct = DirectLight::light};
    if constexpr (requires { m.roulette; }) settings.walk.roulette = m.roulette;
    if constexpr (requires { m.split; }) settings.walk.split = m.split;
    if constexpr (requires { m.reuse; }) settings.sharing_pixels = m.reuse ? reusing_pixels : 1;
    if constexpr (std::same_as<M, method::Metropolis>) settings.chain_length = m.chain.value_or(settings.chain_length);
    settings.sampler = m.sampler.value_or(scene.sampler.value_or(SamplerKind::sobol));
    return settings;
}
SamplingSettings settings_of(const method::Auto&, const Scene&) {
    throw std::logic_error("sampling_settings: the method is still open");
}
template <HasFields M>
SamplingSettings settings_of(const M&, const Scene&) {
    throw InputError(fmt::format("--method {} has no samples of paths: its bounces are read from fields on patches", M::name));
}

}  // namespace

CacheSettings settings_of(const method::Cache& cache) {
    return {cache.records, cache.accuracy.value_or(default_accuracy(cache.records)),
            cache.directions.value_or(default_rays_of_record)};
}

SamplingSettings sampling_settings(const Method& method, const Scene& scene, const Plan& plan, std::uint64_t seed) {
    SamplingSettings settings = std::visit([&](const auto& m) { return settings_of(m, scene); }, method);
    settings.walk.left_out = plan.walk;
    settings.seed = seed;
    return settings;
}

bool set_up(const Method& method, const Scene& scene, int bounces, double memory, SamplingSettings& settings, Prepared& prepared,
            const Watch& watch) {
    settings.walk.bounces = bounces;
    if (const auto* guided = std::get_if<method::Guided>(&method))
        settings.guide = prepared.guide(*guided, scene, bounces, memory, watch);
    else if (const auto* corrected = std::get_if<method::Corrected>(&method))
        settings.approximation = prepared.approximation(*corrected, scene, bounces, memory, watch);
    else if (const auto* photon = std::get_if<method::Photon>(&method))
        settings.photons = std::make_shared<const PhotonPilot>(scene, PhotonChoice{photon->photons, photon->radius, photon->gather},
                                                               settings.sampler, settings.seed, memory, watch);
    else if (const auto* cache = std::get_if<method::Cache>(&method))
        settings.records =
            std::make_shared<const RecordPlaces>(scene, settings_of(*cache), settings.sampler, settings.seed, memory, watch);
    else if (const auto* walk = std::get_if<method::Walk>(&method); walk && walk->tree)
        settings.tree = tree_ratios(scene.with(small_film(scene.film, tree_width)), bounces, *walk->tree, watch);
    else if (const auto* mixed = std::get_if<method::Mixed>(&method)) {
        settings.generator = PathGenerator::walk;
        try {
            settings.mixture = std::make_shared<const Mixture>(make_mixture(*mixed, scene, settings, memory, watch));
            settings.generator = PathGenerator::mixed;
        } catch (const Stopped&) {
            // What can still be sampled is walks; the render tells so.
        }
        return true;
    }
    const std::optional<LeastError> least = adaptive_of(method);
    settings.allocation = {};
    try {
        if (least) settings.allocation = allocate(scene, settings, *least, watch);
    } catch (const Stopped&) {
        // What can still be sampled is as much in all pixels; the render tells so (as_it_ran() in render_paths.cpp).
    }
    return least || settings.guide || settings.approximation || settings.photons || settings.records || settings.tree;
}

}  // namespace neumann
