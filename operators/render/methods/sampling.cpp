#include "operators/render/methods/sampling.h"

#include "core/base/error.h"
#include "operators/paths/walk/direct_light.h"
#include "operators/paths/walk/learned_visibility.h"
#include "operators/render/methods/ahead.h"
#include "operators/render/methods/method_options.h"

#include <fmt/format.h>

#include <stdexcept>

namespace neumann {

namespace {

constexpr int learning_width = 32;  // of the film whose walks learn the visibility of lights, in pixels

void expect_in_reach(const DirectLightSettings& direct, const Emitters& emitters) {
    if (misses_light(direct.direct, emitters))
        throw OptionError(
            "direct",
            fmt::format("{} cannot find {}, of which the scene has some; take mis or light", name_of(direct),
                        emitters.has_delta_lights() ? "lights without extent (directional, directionalarea, point, projector, spot)"
                                                    : "light from infinitely far away (constant, envmap, sunsky)"));
}

template <MakesPaths M>
SamplingSettings settings_of(const M& m, const Scene& scene) {
    SamplingSettings settings;
    m.expect(scene);
    if constexpr (requires { m.direct; }) {
        expect_in_reach(m.direct, scene.emitters);
        settings.walk.direct = m.direct;
    }
    // These methods find lights by directions of their own only in mirrors.
    if constexpr (requires { M::direct_light; }) settings.walk.direct = {.direct = M::direct_light};
    if constexpr (requires { m.roulette; }) settings.walk.roulette = m.roulette;
    if constexpr (requires { m.split; }) settings.walk.split = m.split;
    settings.sampler = m.sampler.value_or(scene.sampler.value_or(SamplerKind::sobol));
    return settings;
}
SamplingSettings settings_of(const method::Auto&, const Scene&) {
    throw std::logic_error("sampling_settings: the method is still open");
}
template <HasFields M>
SamplingSettings settings_of(const M&, const Scene&) {
    throw InputError(fmt::format("{} has no samples of paths: its bounces are read from fields on patches", M::name));
}

}  // namespace

void expect_visible_emitters(const char* method, const Scene& scene) {
    if (scene.hide_emitters)
        throw InputError(fmt::format("{} cannot hide emitters, as the scene's integrator asks for; take walk", method));
}

SamplingSettings sampling_settings(const Method& method, const Scene& scene, const Plan& plan, std::uint64_t seed) {
    SamplingSettings settings = std::visit([&](const auto& m) { return settings_of(m, scene); }, method);
    settings.walk.left_out = plan.walk;
    settings.seed = seed;
    return settings;
}

bool set_up(const Method& method, const Scene& scene, int bounces, double memory, SamplingSettings& settings, Prepared& prepared,
            const Watch& watch) {
    const std::optional<LeastError> least = adaptive_of(method);
    if (least && least->bounce > bounces)
        throw OptionError("adaptive", fmt::format("{}: the last bounce that has a picture is {}", *least->bounce, bounces));
    settings.walk.bounces = bounces;
    settings.method = plain_walks();
    settings.allocation = {};
    const bool learns = settings.walk.direct.lights == LightChoice::seen;
    if (learns)
        settings.walk.direct.visibility = learn_visibility(scene.with(small_film(scene.film, learning_width)), bounces, watch);
    // If the pilots of a mixture, or of the distribution of samples, are stopped, walks can still be sampled, equally
    // many in all pixels; the render reports this (as_it_ran() in describe_paths.cpp).
    const bool may_do_without = std::holds_alternative<method::Mixed>(method);
    try {
        std::visit(
            [&]<class M>(const M& m) {
                if constexpr (MakesPaths<M> && !std::same_as<M, method::Auto>)
                    settings.method = m.prepare({scene, settings, memory, prepared, watch});
            },
            method);
    } catch (const Stopped&) {
        if (!may_do_without) throw;
    }
    if (may_do_without) return true;
    try {
        if (least) settings.allocation = settings.method->allocate(scene, settings, *least, watch);
    } catch (const Stopped&) {
    }
    return least || learns || settings.method->is_prepared();
}

}  // namespace neumann
