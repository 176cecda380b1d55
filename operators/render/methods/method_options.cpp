#include "operators/render/methods/method_options.h"

#include "operators/render/methods/method_table.h"
#include "operators/render/methods/option_makers.h"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <iterator>

namespace neumann {

namespace {

// A value of --direct: everything in DirectLightSettings but the choice among lights.
struct Strategy {
    DirectLight direct = DirectLight::mis;
    LightPlace place = LightPlace::area;
    Heuristic heuristic = Heuristic::power;
    bool operator==(const Strategy&) const = default;
};
const Named<Strategy> strategies{{"hemisphere", {DirectLight::hemisphere}},
                                 {"cosine", {DirectLight::cosine}},
                                 {"bsdf", {DirectLight::bsdf}},
                                 {"surfaces", {DirectLight::surfaces}},
                                 {"light", {DirectLight::light}},
                                 {"solid-angle", {DirectLight::light, LightPlace::solid_angle}},
                                 {"projected", {DirectLight::light, LightPlace::projected}},
                                 {"mis", {}},
                                 {"mis-balance", {.heuristic = Heuristic::balance}},
                                 {"mis-solid-angle", {.place = LightPlace::solid_angle}},
                                 {"mis-projected", {.place = LightPlace::projected}}};
Strategy strategy(const DirectLightSettings& direct) { return {direct.direct, direct.place, direct.heuristic}; }

const Named<LightChoice> light_choices{{"mixed", LightChoice::mixed}, {"uniform", LightChoice::uniform},
                                       {"power", LightChoice::power}, {"contribution", LightChoice::contribution},
                                       {"seen", LightChoice::seen},   {"tree", LightChoice::tree},
                                       {"all", LightChoice::all}};
const Named<SamplerKind> samplers{{"sobol", SamplerKind::sobol}, {"independent", SamplerKind::independent}};
const Named<LeastError> least_errors{{"bounces", LeastError::of_bounces}, {"sum", LeastError::of_sum}, {"all", LeastError::of_all}};
std::optional<LeastError> read_least_error(const std::string& text) {
    if (const auto named = one_of_named(least_errors).read(text)) return named;
    const auto bounce = number_in<int>(text);
    return bounce && *bounce >= 0 ? std::optional(LeastError::of_bounce(*bounce)) : std::nullopt;
}
std::string print_least_error(const LeastError& least) {
    return least.bounce ? fmt::format("{}", *least.bounce) : one_of_named(least_errors).print(least);
}
const Named<method::LeavingOut> plans{{"auto", method::LeavingOut::by_plan}, {"full", method::LeavingOut::nothing}};

std::optional<Roulette> read_roulette(const std::string& text) {
    if (text == "none") return Roulette{};
    if (text == "albedo") return Roulette{Roulette::Kind::albedo};
    if (text == "throughput") return Roulette{Roulette::Kind::throughput};
    const auto survival = number_in<double>(text);
    return survival && *survival > 0.0 && *survival <= 1.0 ? std::optional(Roulette{Roulette::Kind::fixed, *survival})
                                                           : std::nullopt;
}

std::string print_roulette(const Roulette& roulette) {
    switch (roulette.kind) {
        case Roulette::Kind::none:
            return "none";
        case Roulette::Kind::fixed:
            return fmt::format("{}", roulette.survival);
        case Roulette::Kind::albedo:
            return "albedo";
        case Roulette::Kind::throughput:
            return "throughput";
    }
    return "";
}

std::optional<Split> read_split(const std::string& text) {
    const auto in_range = [](int n) { return n >= 1 && n <= 4096; };
    const auto numbers = two_whole(text, ',');
    return numbers && std::ranges::all_of(*numbers, in_range) ? std::optional(Split{(*numbers)[0], (*numbers)[1]}) : std::nullopt;
}

std::vector<MethodOption> options_of_walks() {
    return {
        choice(
            "direct", "HOW",
            "How a walk samples direct light. By directions: hemisphere (uniform), cosine, bsdf (of the material). By points: "
            "surfaces (on all surfaces), light (on lights), solid-angle (on lights, uniform in solid angle), projected "
            "(on lights, in proportion to the cosine). By both: mis (bsdf and light with the power heuristic, the default), "
            "mis-balance, mis-solid-angle, mis-projected",
            strategies, [](const auto& m) requires requires { m.direct; } { return strategy(m.direct); },
            [](auto& m, const Strategy& s) {
                m.direct = {s.direct, m.direct.lights, s.place, s.heuristic};
            }),
        choice(
            "lights", "WHICH",
            "How the light to sample is chosen: mixed (half by power, half uniform, the default), uniform, power, contribution "
            "(radiance times solid angle), seen (the same, less where shadow rays of a pilot were blocked), tree (about "
            "contribution, "
            "for many lights), all (each in turn)",
            light_choices, [](const auto& m) requires requires { m.direct; } {
                return samples_lights(m.direct) ? std::optional(m.direct.lights) : std::nullopt;
            },
            [](auto& m, LightChoice c) { m.direct.lights = c; }),
        option(
            "roulette", "HOW",
            "How Russian roulette ends walks: none (not before the last picture, the default), albedo (by what the last reflection "
            "left of the weight), throughput (by what all reflections left), or a probability of going on, such as 0.9",
            [](const auto& m) requires requires { m.roulette; } { return m.roulette; },
            [](auto& m, const Roulette& r) { m.roulette = r; },
            Form<Roulette>{read_roulette, print_roulette, not_a("none, albedo, throughput or a number above 0 and at most 1")}),
        option(
            "split", "L,C",
            "At the first surface point of each camera ray, take L light samples and let C walks go on; default 1,1",
            [](const auto& m) requires requires { m.split; } { return m.split; }, [](auto& m, const Split& s) { m.split = s; },
            Form<Split>{read_split, [](const Split& s) { return fmt::format("{},{}", s.lights, s.walks); },
                        not_a("two whole numbers from 1 to 4096 with a comma between, such as 8,8")}),
        choice(
            "sampler", "NAME",
            "For the methods that make paths, the random numbers: sobol (scrambled Sobol' points) or independent; default the "
            "scene's",
            samplers, [](const auto& m) requires requires { m.sampler; } { return m.sampler; },
            [](auto& m, SamplerKind s) { m.sampler = s; })};
}

std::vector<MethodOption> shared_options() {
    return {
        option(
            "adaptive", "WHAT",
            "For auto, walk, guided, corrected, bidirectional and mixed: more samples for the pixels that need them, by a pilot, "
            "so "
            "that the largest relative error of a bounce (bounces), that of the sum (sum), both at once (all), or that of one "
            "bounce, such as 3, is least",
            [](const auto& m) requires requires { m.adaptive; } { return m.adaptive; },
            [](auto& m, LeastError least) { m.adaptive = least; },
            Form<LeastError>{read_least_error, print_least_error, not_a("bounces, sum, all or the number of a bounce")}),
        flag(
            "bias-allowed",
            "For auto: choose among matrix and gather, too, whose pictures have an error of their own, which they state; by a "
            "pilot",
            [](const auto& m) requires requires { m.bias_allowed; } { return m.bias_allowed; },
            [](auto& m, bool on) { m.bias_allowed = on; }),
        choice(
            "plan", "NAME",
            "For the methods that make paths: auto leaves out what the scene does not need, as `neumann plan` tells (the default); "
            "full leaves nothing out",
            plans, [](const auto& m) requires requires { m.plan; } { return m.plan; },
            [](auto& m, method::LeavingOut p) { m.plan = p; }),
        whole<std::size_t>(
            "patches", "N", "For guided, corrected, patches, matrix and gather: the approximate number of patches", 0,
            std::uint64_t{1} << 40, [](const auto& m) requires requires { m.patches; } { return m.patches; },
            [](auto& m, std::size_t n) { m.patches = n; }),
        whole<std::uint32_t>(
            "directions", "N",
            "For guided, corrected, patches, matrix and gather: the number of rays of a patch; for cache: of a record, in a pass",
            1, 1u << 20, [](const auto& m) requires requires { m.directions; } { return m.directions; },
            [](auto& m, std::uint32_t n) { m.directions = n; }),
        flag(
            "importance",
            "For patches: show the importance K*^i We in place of K^i Le: by how much the mean of the picture of bounce i grows "
            "with "
            "the radiance given off at each point, per area and projected solid angle (m⁻²·sr⁻¹), as a mean over directions",
            [](const auto& m) requires requires { m.importance; } { return m.importance; },
            [](auto& m, bool on) { m.importance = on; })};
}

template <class M>
void add_own(std::vector<MethodOption>& all) {
    if constexpr (requires { M::own_options(); })
        for (MethodOption& own : M::own_options()) all.push_back(std::move(own));
}

}  // namespace

std::span<const MethodOption> method_options() {
    static const std::vector<MethodOption> all = [] {
        std::vector<MethodOption> options = options_of_walks();
        add_own<method::Walk>(options);
        std::ranges::move(shared_options(), std::back_inserter(options));
        for (const Method& method : all_methods())
            std::visit(
                [&]<class M>(const M&) {
                    if constexpr (!std::same_as<M, method::Walk>) add_own<M>(options);
                },
                method);
        return options;
    }();
    return all;
}

bool samples_lights(const DirectLightSettings& direct) {
    return direct.direct == DirectLight::light || direct.direct == DirectLight::mis;
}
std::string name_of(const DirectLightSettings& direct) { return name(strategies, strategy(direct)); }

void expect_sense(const Method& method, bool lights) {
    std::visit(
        [&](const auto& m) {
            if constexpr (requires { m.expect_sense(lights); }) m.expect_sense(lights);
        },
        method);
}

}  // namespace neumann
