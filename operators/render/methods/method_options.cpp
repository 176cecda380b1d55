#include "operators/render/methods/method_options.h"

#include "core/base/error.h"
#include "operators/render/methods/method_table.h"
#include "operators/render/methods/named_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace neumann {

namespace {

using Kind = MethodOption::Kind;

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
bool asks_lights(const DirectLightSettings& s) { return s.direct == DirectLight::light || s.direct == DirectLight::mis; }

const Named<LightChoice> light_choices{{"mixed", LightChoice::mixed}, {"uniform", LightChoice::uniform},
                                       {"power", LightChoice::power}, {"contribution", LightChoice::contribution},
                                       {"tree", LightChoice::tree},   {"all", LightChoice::all}};
const Named<SamplerKind> samplers{{"sobol", SamplerKind::sobol}, {"independent", SamplerKind::independent}};
const Named<Spacing> spacings{{"hessian", Spacing::hessian}, {"split-sphere", Spacing::split_sphere}};
const Named<LeastError> least_errors{{"bounces", LeastError::of_bounces}, {"sum", LeastError::of_sum}, {"all", LeastError::of_all}};
const Named<method::LeavingOut> plans{{"auto", method::LeavingOut::by_plan}, {"full", method::LeavingOut::nothing}};

template <class Number>
std::optional<Number> number(const std::string& text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::optional<double> read_length(const std::string& text) {
    const auto length = number<double>(text);
    return length && *length > 0.0 && std::isfinite(*length) ? length : std::nullopt;
}

std::optional<Roulette> read_roulette(const std::string& text) {
    if (text == "none") return Roulette{};
    if (text == "albedo") return Roulette{Roulette::Kind::albedo};
    if (text == "throughput") return Roulette{Roulette::Kind::throughput};
    const auto survival = number<double>(text);
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

std::optional<TreeGoal> read_tree(const std::string& text) {
    if (text == "sum") return std::make_optional<TreeGoal>();
    const auto bounce = number<int>(text);
    return bounce && *bounce >= 1 && *bounce <= most_depths_of_tree ? std::optional(TreeGoal{*bounce}) : std::nullopt;
}

std::string print_tree(const std::optional<TreeGoal>& tree) {
    if (!tree) return "";
    return tree->bounce ? fmt::format("{}", *tree->bounce) : "sum";
}

std::optional<Split> read_split(const std::string& text) {
    constexpr int most = 4096;
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) return std::nullopt;
    const auto lights = number<int>(text.substr(0, comma)), walks = number<int>(text.substr(comma + 1));
    const auto in_range = [](const std::optional<int>& n) { return n && *n >= 1 && *n <= most; };
    return in_range(lights) && in_range(walks) ? std::optional(Split{*lights, *walks}) : std::nullopt;
}

// Makes an option. `get` reads its value from a method; a method has the option if it can be passed to `get`. `set` writes the
// value. `read` parses a text and returns nothing if the text is wrong.
template <class Get, class Set, class Read, class Print>
MethodOption option(Kind kind, std::string name, std::string type, std::string help, Get get, Set set, Read read, Print print,
                    std::string expected) {
    MethodOption o;
    o.kind = kind;
    o.name = std::move(name);
    o.type = std::move(type);
    o.help = std::move(help);
    o.wrong = [=](const std::string& text) { return read(text) ? "" : fmt::format("'{}' is not {}", text, expected); };
    o.belongs_to = [](const Method& method) {
        return std::visit([]<class M>(const M&) { return std::is_invocable_v<Get, const M&>; }, method);
    };
    o.read = [=](Method& method, const std::string& text) {
        std::visit(
            [&]<class M>(M& m) {
                if constexpr (std::is_invocable_v<Get, const M&>) set(m, *read(text));
            },
            method);
    };
    o.text = [=](const Method& method) {
        return std::visit(
            [&]<class M>(const M& m) -> std::string {
                if constexpr (std::is_invocable_v<Get, const M&>)
                    return print(get(m));
                else
                    return "";
            },
            method);
    };
    return o;
}

template <class Value, class Get, class Set>
MethodOption choice(std::string option_name, std::string type, std::string help, const Named<Value>& all, Get get, Set set) {
    MethodOption o = option(
        Kind::text, std::move(option_name), std::move(type), std::move(help), get, set,
        [&all](const std::string& text) { return value(all, text); },
        [&all](const std::optional<Value>& v) { return v ? name(all, *v) : ""; }, "");
    o.wrong = [&all](const std::string& text) { return value(all, text) ? "" : not_in(text, names(all)); };
    o.words = names(all);
    return o;
}

template <class Get, class Set>
MethodOption flag(std::string name, std::string help, Get get, Set set) {
    return option(
        Kind::flag, std::move(name), "", std::move(help), get, set,
        [](const std::string& text) { return text == "true" || text == "false" ? std::optional(text == "true") : std::nullopt; },
        [](bool on) { return on ? "true" : ""; }, "true or false");
}

template <class Number, class Get, class Set>
MethodOption whole(std::string name, std::string type, std::string help, std::uint64_t low, std::uint64_t high, Get get, Set set) {
    return option(
        Kind::number, std::move(name), std::move(type), std::move(help), get, set,
        [=](const std::string& text) -> std::optional<Number> {
            const auto n = number<std::uint64_t>(text);
            return n && *n >= low && *n <= high ? std::optional(static_cast<Number>(*n)) : std::nullopt;
        },
        [](const std::optional<Number>& n) { return n ? fmt::format("{}", *n) : std::string(); },
        fmt::format("a whole number from {} to {}", low, high));
}

std::vector<MethodOption> make_options() {
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
            "(radiance times solid angle), tree (about the same, for many lights), all (each in turn)",
            light_choices, [](const auto& m) requires requires { m.direct; } {
                return asks_lights(m.direct) ? std::optional(m.direct.lights) : std::nullopt;
            },
            [](auto& m, LightChoice c) { m.direct.lights = c; }),
        option(
            Kind::text, "roulette", "HOW",
            "How Russian roulette ends walks: none (not before the last picture, the default), albedo (by what the last reflection "
            "left of the weight), throughput (by what all reflections left), or a probability of going on, such as 0.9",
            [](const auto& m) requires requires { m.roulette; } { return m.roulette; },
            [](auto& m, const Roulette& r) { m.roulette = r; }, read_roulette, print_roulette,
            "none, albedo, throughput or a number above 0 and at most 1"),
        option(
            Kind::text, "split", "L,C",
            "At the first surface point of each camera ray, take L light samples and let C walks go on; default 1,1",
            [](const auto& m) requires requires { m.split; } { return m.split; }, [](auto& m, const Split& s) { m.split = s; },
            read_split, [](const Split& s) { return fmt::format("{},{}", s.lights, s.walks); },
            "two whole numbers from 1 to 4096 with a comma between, such as 8,8"),
        choice(
            "sampler", "NAME",
            "For the methods that make paths, the random numbers: sobol (scrambled Sobol' points) or independent; default the "
            "scene's",
            samplers, [](const auto& m) requires requires { m.sampler; } { return m.sampler; },
            [](auto& m, SamplerKind s) { m.sampler = s; }),
        option(
            Kind::text, "tree", "WHAT",
            "For walk: split walks, and end them by Russian roulette, by the numbers of samples at each depth that a pilot finds "
            "best for the sum of all bounces (sum) or for one bounce (its number)",
            [](const auto& m) requires requires { m.tree; } { return m.tree; }, [](auto& m, const TreeGoal& t) { m.tree = t; },
            read_tree, print_tree, fmt::format("sum or a bounce from 1 to {}", most_depths_of_tree)),
        flag(
            "reuse",
            "For walk: let the walks of eight pixels in a row use each other's tails, from the second surface on where both are "
            "diffuse",
            [](const auto& m) requires requires { m.reuse; } { return m.reuse; }, [](auto& m, bool on) { m.reuse = on; }),
        choice(
            "adaptive", "WHAT",
            "For auto, walk, guided, corrected, bidirectional and mixed: more samples for the pixels that need them, by a pilot, "
            "so "
            "that the largest relative error of a bounce (bounces), that of the sum (sum), or both at once (all) is least",
            least_errors, [](const auto& m) requires requires { m.adaptive; } { return m.adaptive; },
            [](auto& m, LeastError least) { m.adaptive = least; }),
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
        whole<std::uint32_t>(
            "photons", "N", "For photon: the number of paths from the lights in a pass (a replicate)", 1, 1u << 28,
            [](const auto& m) requires requires { m.photons; } { return m.photons; },
            [](auto& m, std::uint32_t n) { m.photons = n; }),
        option(
            Kind::text, "radius", "R",
            "For photon: the radius within which photons are read in the first pass, in the scene's units; smaller in later ones; "
            "default by "
            "a pilot",
            [](const auto& m) requires requires { m.radius; } { return m.radius; }, [](auto& m, double r) { m.radius = r; },
            read_length, [](const std::optional<double>& r) { return r ? fmt::format("{}", *r) : ""; }, "a length above 0"),
        flag(
            "gather", "For photon: sample one more reflection before the map is read (final gathering)",
            [](const auto& m) requires requires { m.gather; } { return m.gather; }, [](auto& m, bool on) { m.gather = on; }),
        choice(
            "records", "HOW",
            "For cache: what says how far apart records stand: hessian (the second derivatives of their irradiance, the default) "
            "or "
            "split-sphere (the distances of what they see)",
            spacings, [](const auto& m) requires requires { m.records; } { return m.records; },
            [](auto& m, Spacing s) { m.records = s; }),
        option(
            Kind::text, "accuracy", "A",
            "For cache: the error allowed to records; with hessian relative, on average within the usual distance of records "
            "(default 0.05); with split-sphere their reach as a part of the distance of what they see (default 0.25). A larger one "
            "makes fewer records",
            [](const auto& m) requires requires { m.accuracy; } { return m.accuracy; }, [](auto& m, double a) { m.accuracy = a; },
            read_length, [](const std::optional<double>& a) { return a ? fmt::format("{}", *a) : ""; }, "a number above 0"),
        whole<std::uint32_t>(
            "chain", "N", "For metropolis: the states of each chain in a replicate (default 512, fewer in small pictures)", 1,
            1u << 20, [](const auto& m) requires requires { m.chain; } { return m.chain; },
            [](auto& m, std::uint32_t n) { m.chain = n; }),
        whole<int>(
            "ways", "BOUNCE",
            "For bidirectional: write pictures of every way (s, t) to make this bounce, s vertices from the light and t from the "
            "camera, with and without its weight",
            1, 1000, [](const auto& m) requires requires { m.ways; } { return m.ways; }, [](auto& m, int n) { m.ways = n; }),
        flag(
            "importance",
            "For patches: show the importance K*^i We in place of K^i Le: by how much the mean of the picture of bounce i grows "
            "with "
            "the radiance given off at each point, per area and projected solid angle (m⁻²·sr⁻¹), as a mean over directions",
            [](const auto& m) requires requires { m.importance; } { return m.importance; },
            [](auto& m, bool on) { m.importance = on; })};
}

void expect_sense(const method::Walk& walk, bool lights) {
    if (lights && !asks_lights(walk.direct))
        throw InputError(fmt::format("--lights chooses among lights, and --direct {} asks none; take light, solid-angle or mis",
                                     name(strategies, strategy(walk.direct))));
    if (walk.tree && (walk.split != Split{} || walk.roulette != Roulette{}))
        throw InputError("--tree chooses what --split and --roulette say; take it alone");
    if (walk.reuse && (walk.tree || walk.adaptive || walk.split != Split{}))
        throw InputError("--reuse needs one walk of each pixel; take it without --tree, --adaptive and --split");
}
void expect_sense(const method::Bidirectional& both, bool) {
    if (both.direct.direct != DirectLight::mis || both.direct.place == LightPlace::projected)
        throw InputError(
            fmt::format("--method bidirectional both asks for lights and hits them; take --direct mis, mis-balance or "
                        "mis-solid-angle, not {}",
                        name(strategies, strategy(both.direct))));
    if (both.direct.lights == LightChoice::all)
        throw InputError("--method bidirectional asks one light at a time; --lights all belongs to --method walk");
}
void expect_sense(const auto&, bool) {}

}  // namespace

std::span<const MethodOption> method_options() {
    static const std::vector<MethodOption> all = make_options();
    return all;
}

std::string name_of(const DirectLightSettings& direct) { return name(strategies, strategy(direct)); }

void expect_sense(const Method& method, bool lights) {
    std::visit([&](const auto& m) { expect_sense(m, lights); }, method);
}

}  // namespace neumann
