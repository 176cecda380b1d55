#include "apps/output/files/health_json.h"
#include "apps/output/files/json_number.h"

#include "operators/paths/walk/path_group.h"

#include <fmt/format.h>
#include <cmath>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

Json mean_json(const MeanWithError& mean) {
    return {{"mean", json_number(mean.mean)},
            {"stderr", json_number(mean.standard_error)},
            {"degrees_of_freedom", mean.degrees_of_freedom},
            {"interval95", json_number(mean.interval())}};
}

// The samples that a report names, numbered from 1 as `neumann replay` counts them.
struct NamedSample {
    const char* why;
    std::size_t bounce;
    SamplePlace place;
};
struct NamedSamples {
    std::vector<NamedSample> all;
    std::size_t first_self_hit = 0;
    std::vector<std::size_t> largest;  // for each bounce and the rest; 0 if there is none

    explicit NamedSamples(const Health& health) {
        for (const NonFiniteSample& s : health.first_non_finite)
            all.push_back({"not a finite number", static_cast<std::size_t>(s.bounce), s.place});
        first_self_hit = all.size() + 1;
        if (health.checkup)
            for (const SelfHit& s : health.checkup->first_self_hits)
                all.push_back({"hits the surface it leaves", static_cast<std::size_t>(s.bounce), {s.name.pixel, s.name}});
        for (std::size_t q = 0; q < health.bounces.size(); ++q) {
            const auto& found = health.bounces[q].largest;
            if (found) all.push_back({"largest share of its pixel", q, found->sample.place});
            largest.push_back(found ? all.size() : 0);
        }
    }
};

Json pixel_json(const Film& film, std::uint32_t number) {
    const Pixel pixel = pixel_of(film, number);
    return {pixel.x, pixel.y};
}
std::string pixel_text(const Film& film, std::uint32_t number) {
    const Pixel pixel = pixel_of(film, number);
    return fmt::format("pixel {},{}", pixel.x, pixel.y);
}

const char* option(Remedy remedy) {
    switch (remedy) {
        case Remedy::sample_lights:
            return "--method walk --direct mis";
        case Remedy::bidirectional:
            return "--method bidirectional";
        case Remedy::more_bounces:
            return "a larger -n";
    }
    return "";
}

std::string remedy_text(const std::vector<Remedy>& remedies) {
    if (remedies.empty()) return "no method finds such a path but by chance";
    std::string text = "such a path is found with less luck by ";
    for (std::size_t i = 0; i < remedies.size(); ++i) text += (i > 0 ? " with " : "") + std::string(option(remedies[i]));
    return text;
}

std::string bounce_text(const Health& health, std::size_t q) {
    return q + 1 == health.bounces.size() ? "the rest" : fmt::format("bounce {}", q);
}

// `counted`: the name of the things that `count` counts.
Json balance_json(const EnergyBalance& balance, const char* unit, const char* counted, std::uint64_t count) {
    Json bounces = Json::array();
    for (std::size_t i = 0; i < balance.bounces.size(); ++i) {
        const BalanceOfBounce& b = balance.bounces[i];
        bounces.push_back({{"bounce", i + 1},
                           {"arrived", mean_json(b.arrived)},
                           {"absorbed", mean_json(b.absorbed)},
                           {"left_the_scene", mean_json(b.left)},
                           {"went_on", mean_json(b.went_on)},
                           {"imbalance", mean_json(b.imbalance)},
                           {"sick", balance.is_sick(i + 1)}});
    }
    return {{"unit", unit},
            {counted, count},
            {"confidence_of_all_bounces", EnergyBalance::confidence},
            {"begun", mean_json(balance.begun)},
            {"left_the_scene_at_once", mean_json(balance.left)},
            {"bounces", bounces}};
}

void complain_of(const EnergyBalance& balance, const char* what, std::vector<std::string>& lines) {
    for (std::size_t bounce = 1; bounce <= balance.bounces.size(); ++bounce) {
        if (!balance.is_sick(bounce)) continue;
        const BalanceOfBounce& b = balance.bounces[bounce - 1];
        lines.push_back(fmt::format(
            "bounce {}: of {:.6g} {} that arrive, {:.6g} are absorbed, {:.6g} leave the scene and {:.6g} go on: {:.3g} ± {:.2g} {}",
            bounce, b.arrived.mean, what, b.absorbed.mean, b.left.mean, b.went_on.mean, std::abs(b.imbalance.mean),
            b.imbalance.interval(), b.imbalance.mean > 0.0 ? "are missing" : "are too much"));
        return;  // later bounces inherit the error, so only the first is reported
    }
}

}  // namespace

std::string name_of_shape(const Scene& scene, std::uint32_t shape) {
    if (shape >= scene.origins.size()) return fmt::format("shape {}", shape);
    const Origin& origin = scene.origins[shape];
    return fmt::format("{}{}, {}", origin.shape, origin.bsdf.empty() ? "" : " of " + origin.bsdf, to_string(origin.place));
}

std::vector<std::string> complaints(const Health& health, const Scene& scene, const std::string& folder) {
    std::vector<std::string> lines;
    const NamedSamples named(health);
    const auto replay = [&](std::size_t number) { return fmt::format("neumann replay {} {}", folder, number); };
    if (health.non_finite() > 0) {
        const NonFiniteSample& first = health.first_non_finite.front();
        lines.push_back(fmt::format("{} samples are no finite numbers and were left out, the first in {}, {}: {}",
                                    health.non_finite(), bounce_text(health, static_cast<std::size_t>(first.bounce)),
                                    pixel_text(scene.film, first.place.pixel), replay(1)));
    }
    for (std::size_t q = 0; q < health.bounces.size(); ++q) {
        const SampleHealth& b = health.bounces[q];
        if (b.overflowed > 0)
            lines.push_back(fmt::format("{}: the means of {} pixels are too large for a number, the first is {}",
                                        bounce_text(health, q), b.overflowed, pixel_text(scene.film, b.first_overflowed)));
    }
    for (std::size_t q = 0; q < health.bounces.size(); ++q) {
        const SampleHealth& b = health.bounces[q];
        if (b.fireflies == 0) continue;
        const std::string makers = b.fireflies == 1
                                       ? "one sample makes more than half of its pixel"
                                       : fmt::format("{} samples each make more than half of their pixel", b.fireflies);
        lines.push_back(fmt::format("{}: {}; {:.3g}% of {} is a single one: {}; {}", bounce_text(health, q), makers,
                                    100.0 * b.largest->of_sum, pixel_text(scene.film, b.largest->sample.place.pixel),
                                    replay(named.largest[q]), remedy_text(b.remedies)));
    }
    if (!health.checkup) return lines;
    const Checkup& checkup = *health.checkup;
    if (checkup.self_hits > 0) {
        const SelfHit& first = checkup.first_self_hits.front();
        lines.push_back(
            fmt::format("{} of {} rays hit the surface that they leave, or one as near as rounding can tell; the first after {} "
                        "reflections of {}, "
                        "{:.2g} away, on {}: {}",
                        checkup.self_hits, checkup.rays, first.bounce, pixel_text(scene.film, first.name.pixel), first.distance,
                        name_of_shape(scene, first.shape), replay(named.first_self_hit)));
    }
    if (checkup.camera) complain_of(*checkup.camera, "path weight", lines);
    if (checkup.light) complain_of(*checkup.light, "power", lines);
    return lines;
}

Json as_json(const Health& health, const Scene& scene, const std::string& folder) {
    const NamedSamples named(health);
    Json json;
    json["sick"] = health.is_sick();
    json["complaints"] = complaints(health, scene, folder);
    json["samples"] = Json::array();
    for (std::size_t i = 0; i < named.all.size(); ++i) {
        const auto& [why, bounce, place] = named.all[i];
        Json sample = {{"number", i + 1}, {"why", why}, {"bounce", bounce}, {"pixel", pixel_json(scene.film, place.pixel)}};
        if (place.name.pixel != place.pixel) sample["pixel_of_path"] = pixel_json(scene.film, place.name.pixel);
        sample["sample"] = place.name.sample;
        json["samples"].push_back(std::move(sample));
    }
    Json by_bounce = Json::array(), overflowed = Json::array(), largest = Json::array();
    for (std::size_t q = 0; q < health.bounces.size(); ++q) {
        const SampleHealth& b = health.bounces[q];
        by_bounce.push_back(b.non_finite);
        overflowed.push_back(b.overflowed);
        if (!b.largest) continue;
        largest.push_back({{"bounce", q},
                           {"number", named.largest[q]},
                           {"value", b.largest->sample.value},
                           {"share_of_pixel", b.largest->of_bounce},
                           {"share_of_pixel_in_sum", b.largest->of_sum},
                           {"fireflies", b.fireflies}});
        if (b.fireflies == 0) continue;
        largest.back()["try"] = Json::array();
        for (const Remedy remedy : b.remedies) largest.back()["try"].push_back(option(remedy));
    }
    json["non_finite_samples"] = {{"count", health.non_finite()}, {"by_bounce", by_bounce}, {"pixels_overflowed", overflowed}};
    json["largest_samples"] = largest;
    if (!health.checkup) {
        json["checkup"] = "none: " + health.why_no_checkup;
        return json;
    }
    const Checkup& checkup = *health.checkup;
    json["self_hits"] = {{"paths", checkup.paths},
                         {"rays", checkup.rays},
                         {"count", checkup.self_hits},
                         {"part_of_rays_at_most_95", checkup.self_hits_at_most()}};
    if (checkup.camera)
        json["energy_balance"]["from_the_camera"] = balance_json(*checkup.camera, "path weight", "paths", checkup.paths);
    if (checkup.light) json["energy_balance"]["from_the_lights"] = balance_json(*checkup.light, "W", "paths", checkup.paths);
    if (!checkup.camera && !checkup.light) json["energy_balance"] = "none: " + health.why_no_balance;
    return json;
}

std::vector<std::string> complaints(const EnergyBalance& power) {
    std::vector<std::string> lines;
    complain_of(power, "power", lines);
    return lines;
}

Json as_json(const EnergyBalance& power) {
    const auto replicates = static_cast<std::uint64_t>(power.begun.degrees_of_freedom) + 1;
    return {{"sick", power.is_sick()},
            {"complaints", complaints(power)},
            {"samples", Json::array()},
            {"energy_balance", {{"on_patches", balance_json(power, "W", "replicates", replicates)}}}};
}

std::vector<std::pair<SampleName, std::string>> named_samples(const Health& health) {
    std::vector<std::pair<SampleName, std::string>> all;
    for (const auto& [why, bounce, place] : NamedSamples(health).all)
        all.emplace_back(place.name, fmt::format("bounce {}: {}", bounce, why));
    return all;
}

std::vector<std::string> complaints(const BounceSeries& series, const Scene& scene, const std::string& folder) {
    if (const auto* fields = std::get_if<FieldRecord>(&series.record)) return complaints(fields->power);
    const auto& health = std::get<PathRecord>(series.record).health;
    return health ? complaints(*health, scene, folder) : std::vector<std::string>();
}

Json health_json(const BounceSeries& series, const Scene& scene, const std::string& folder) {
    if (const auto* fields = std::get_if<FieldRecord>(&series.record)) return as_json(fields->power);
    const auto& health = std::get<PathRecord>(series.record).health;
    return health ? as_json(*health, scene, folder) : Json(nullptr);
}

}  // namespace neumann
