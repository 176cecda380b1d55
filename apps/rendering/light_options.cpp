#include "apps/rendering/light_options.h"

#include "core/base/error.h"
#include "operators/walk/direct_light.h"

#include <fmt/format.h>

#include <charconv>
#include <map>

namespace neumann {

namespace {

using Settings = DirectLightSettings;

const std::map<std::string, Settings>& strategies() {
    static const std::map<std::string, Settings> all = {
        {"hemisphere", {.direct = DirectLight::hemisphere}},
        {"cosine", {.direct = DirectLight::cosine}},
        {"bsdf", {.direct = DirectLight::bsdf}},
        {"surfaces", {.direct = DirectLight::surfaces}},
        {"light", {.direct = DirectLight::light}},
        {"solid-angle", {.direct = DirectLight::light, .place = LightPlace::solid_angle}},
        {"mis", {}},
        {"mis-balance", {.heuristic = Heuristic::balance}},
        {"mis-solid-angle", {.place = LightPlace::solid_angle}}};
    return all;
}

const std::map<std::string, LightChoice>& choices() {
    static const std::map<std::string, LightChoice> all = {{"mixed", LightChoice::mixed},
                                                           {"uniform", LightChoice::uniform},
                                                           {"power", LightChoice::power},
                                                           {"contribution", LightChoice::contribution},
                                                           {"all", LightChoice::all}};
    return all;
}

std::optional<Roulette> ending(const std::string& text) {
    if (text == "none") return Roulette{};
    if (text == "albedo") return Roulette{Roulette::Kind::albedo};
    if (text == "throughput") return Roulette{Roulette::Kind::throughput};
    double survival = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), survival);
    if (error != std::errc() || end != text.data() + text.size() || !(survival > 0.0 && survival <= 1.0)) return std::nullopt;
    return Roulette{Roulette::Kind::fixed, survival};
}

std::optional<Split> branches(const std::string& text) {
    constexpr int most = 4096;
    Split split;
    const char* const end = text.data() + text.size();
    const auto lights = std::from_chars(text.data(), end, split.lights);
    if (lights.ec != std::errc() || lights.ptr == end || *lights.ptr != ',') return std::nullopt;
    const auto walks = std::from_chars(lights.ptr + 1, end, split.walks);
    if (walks.ec != std::errc() || walks.ptr != end) return std::nullopt;
    const auto in_range = [](int n) { return n >= 1 && n <= most; };
    return in_range(split.lights) && in_range(split.walks) ? std::optional(split) : std::nullopt;
}

bool asks_lights(const Settings& settings) { return settings.direct == DirectLight::light || settings.direct == DirectLight::mis; }

template <class Value>
std::vector<std::string> names(const std::map<std::string, Value>& all) {
    std::vector<std::string> found;
    for (const auto& [name, value] : all) found.push_back(name);
    return found;
}

}  // namespace

std::vector<std::string> names_of_direct() { return names(strategies()); }
std::vector<std::string> names_of_lights() { return names(choices()); }
bool is_roulette(const std::string& text) { return ending(text).has_value(); }
bool is_split(const std::string& text) { return branches(text).has_value(); }

void check_light_options(const LightOptions& options, const std::string& method) {
    if (method == "bidirectional") {
        if (!options.direct.empty() && strategies().at(options.direct).direct != DirectLight::mis)
            throw InputError(
                fmt::format("--method bidirectional both asks for lights and hits them; take --direct mis, mis-balance or "
                            "mis-solid-angle, not {}",
                            options.direct));
        if (options.lights == "all")
            throw InputError("--method bidirectional asks one light at a time; --lights all belongs to --method walk");
        return;
    }
    if (method == "light") {
        if (options.direct.empty() && options.lights.empty() && options.split.empty()) return;
        throw InputError("--direct, --lights and --split belong to --method walk and bidirectional, not to light");
    }
    if (options.given() && method != "walk")
        throw InputError("--direct, --lights, --roulette and --split belong to --method walk and bidirectional, not to " + method);
}

Roulette roulette(const LightOptions& options) { return options.roulette.empty() ? Roulette{} : *ending(options.roulette); }

Split split(const LightOptions& options) { return options.split.empty() ? Split{} : *branches(options.split); }

DirectLightSettings direct_light(const LightOptions& options, const Emitters& emitters) {
    Settings settings = options.direct.empty() ? Settings{} : strategies().at(options.direct);
    if (!options.lights.empty()) {
        if (!asks_lights(settings))
            throw InputError(fmt::format("--lights chooses among lights, and --direct {} asks none; take light, solid-angle or mis",
                                         options.direct));
        settings.lights = choices().at(options.lights);
    }
    if (misses_light(settings.direct, emitters))
        throw InputError(fmt::format("--direct {} cannot find {}, of which the scene has some; take --direct mis or light",
                                     options.direct,
                                     emitters.has_delta_lights() ? "lights without extent (directional, point, projector, spot)"
                                                                 : "light from infinitely far away (constant, envmap)"));
    return settings;
}

nlohmann::ordered_json as_json(const LightOptions& options) {
    nlohmann::ordered_json json;
    json["direct"] = options.direct.empty() ? "mis" : options.direct;
    if (asks_lights(strategies().at(json["direct"]))) json["lights"] = options.lights.empty() ? "mixed" : options.lights;
    json["roulette"] = options.roulette.empty() ? "none" : options.roulette;
    json["split"] = options.split.empty() ? "1,1" : options.split;
    return json;
}

}  // namespace neumann
