#include "apps/output/files/replay_json.h"

#include "apps/output/files/health_json.h"

#include <fmt/format.h>

#include <cmath>

namespace neumann {

using Json = nlohmann::ordered_json;

std::string heading(const PathStep& step) {
    const char* half = step.from_light ? "light" : "camera";
    switch (step.kind) {
        case PathStep::Kind::first:
            return fmt::format("from the {}", half);
        case PathStep::Kind::goes_on:
            return fmt::format("reflection {}{}", step.bounce, step.from_light ? " of the light's path" : "");
        case PathStep::Kind::record:
            return "from the record of the cache that brings most, its brightest ray";
        case PathStep::Kind::shadow_ray:
            if (step.is_shared) return "joins a point that pixels share";
            return fmt::format("{} for bounce {}", step.from_light ? "looks at the camera" : "looks for light", step.bounce);
    }
    return "";
}

Json as_json(const Vec3& x) {
    Json json = Json::array();
    for (int c = 0; c < 3; ++c) json.push_back(std::isfinite(x[c]) ? Json(x[c]) : Json(fmt::format("{}", x[c])));
    return json;
}

Json as_json(const ReplayedStep& s, const Scene& scene) {
    const PathStep& step = s.step;
    Json json = {
        {"ray", heading(step)}, {"bounce", step.bounce}, {"from", as_json(step.from.position)}, {"along", as_json(step.w)}};
    if (step.kind == PathStep::Kind::goes_on && !step.from_light)
        json["pdf"] = step.pdf == delta_pdf ? Json("delta") : Json(step.pdf);
    if (step.kind != PathStep::Kind::shadow_ray) json[step.from_light ? "power" : "throughput"] = as_json(step.beta);
    json["found"] = step.found;
    if (step.found && step.kind != PathStep::Kind::shadow_ray)
        json["meets"] = {{"shape", name_of_shape(scene, step.to.shape)},
                         {"triangle", step.to.primitive},
                         {"at", as_json(step.to.position)},
                         {"normal", as_json(step.to.normal)}};
    for (const auto& found : s.found) {
        Json brought = {{"bounce", found.quantity}, {"value", as_json(found.value)}};
        if (found.pixel) brought["film"] = {found.pixel->x, found.pixel->y};
        json["brings"].push_back(brought);
    }
    json["finite"] = is_finite(s);
    return json;
}

}  // namespace neumann
