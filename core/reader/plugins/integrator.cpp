#include "core/reader/plugins/integrator.h"

#include "core/reader/xml/properties.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

// How Mitsuba divides its work, and when it gives up: the command line's to decide.
void read_course_of_work(Properties& p) {
    p.integer("block_size");
    p.integer("samples_per_pass");
    p.number("timeout");
}

// Those that estimate the light of all paths up to a length. That some follow them from the lights (`ptracer`) or through media, of
// which there are none here, makes no difference to what is expected.
const std::vector<std::string> path_types = {"path", "ptracer", "volpath", "volpathmis"};

Integrator read_path(Properties& p) {
    const std::int64_t depth = p.integer("max_depth").value_or(-1);
    if (depth == 0 || depth < -1 || depth > std::numeric_limits<int>::max())
        p.complain("max_depth", fmt::format("max_depth is {}, expected -1 or at least 1", depth));
    // Here roulette begins only after the last bounce that is asked for.
    const std::int64_t roulette = p.integer("rr_depth").value_or(5);
    if (roulette < 1) p.complain("rr_depth", fmt::format("rr_depth is {}, expected at least 1", roulette));
    Integrator result;
    if (depth != -1) result.bounces = static_cast<int>(depth) - 1;  // Mitsuba counts the vertices after the camera's
    result.hide_emitters = p.boolean("hide_emitters").value_or(false);
    return result;
}

// How many samples of each kind Mitsuba takes at a vertex makes no difference to what is expected.
Integrator read_direct(Properties& p) {
    const auto count = [&](const std::string& name) {
        const std::optional<std::int64_t> value = p.integer(name);
        if (value && *value < 0) p.complain(name, fmt::format("{} is {}, expected at least 0", name, *value));
        return value;
    };
    const auto both = count("shading_samples"), emitter = count("emitter_samples"), bsdf = count("bsdf_samples");
    if (both && (emitter || bsdf))
        p.complain("shading_samples", fmt::format("both shading_samples and {} are given, expected one of them",
                                                  emitter ? "emitter_samples" : "bsdf_samples"));
    if (emitter.value_or(both.value_or(1)) + bsdf.value_or(both.value_or(1)) == 0)
        p.complain(both ? "shading_samples" : "emitter_samples",
                   "integrator 'direct' takes no samples of emitters nor of bsdfs, expected at least 1",
                   {"emitter_samples", "bsdf_samples"});
    return {1, p.boolean("hide_emitters").value_or(false)};
}

}  // namespace

Integrator read_integrator(const Element& e, const Context& context) {
    const std::string& type = e.attribute("type").value;
    const bool is_path = std::find(path_types.begin(), path_types.end(), type) != path_types.end();
    if (!is_path && type != "direct" && type != "moment") {
        std::vector<std::string> allowed = {"direct", "moment"};
        allowed.insert(allowed.end(), path_types.begin(), path_types.end());
        fail_type(e, allowed);
    }
    Properties p(e, context.objects);
    Integrator result;
    const Element* nested = nullptr;
    if (type == "moment") {
        const std::vector<const Element*> integrators = p.nested("integrator");
        if (integrators.empty()) p.fail_empty("integrator 'moment' has no <integrator> inside, expected one");
        nested = integrators.front();
        if (nested->attribute("type").value == "moment") throw InputError(e.place, "integrator 'moment' stands inside another one");
    } else {
        result = is_path ? read_path(p) : read_direct(p);
    }
    read_course_of_work(p);
    p.finish();
    // The squares of the samples, which are all that `moment` adds, are in the standard errors.
    return nested ? read_integrator(*nested, context) : result;
}

}  // namespace neumann::reader
