#include "core/reader/plugins/integrator.h"

#include "core/reader/xml/properties.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

// Reads and ignores parameters of Mitsuba's scheduling and time limit, which the command line controls here.
void read_course_of_work(Properties& p) {
    p.integer("block_size");
    p.integer("samples_per_pass");
    p.number("timeout");
}

// Integrators that estimate the light of all paths up to a length. Some start at the lights (`ptracer`) or handle media, which do
// not exist here; the expected picture is the same.
const std::vector<std::string> path_types = {"path", "ptracer", "volpath", "volpathmis"};

Integrator read_path(Properties& p) {
    const std::int64_t depth = p.integer("max_depth").value_or(-1);
    if (depth == 0 || depth < -1 || depth > std::numeric_limits<int>::max())
        p.complain("max_depth", fmt::format("max_depth is {}, expected -1 or at least 1", depth));
    // Here roulette begins only after the last bounce of the file.
    const std::int64_t roulette = p.integer("rr_depth").value_or(5);
    if (roulette < 1) p.complain("rr_depth", fmt::format("rr_depth is {}, expected at least 1", roulette));
    Integrator result;
    if (depth != -1) result.bounces = static_cast<int>(depth) - 1;  // Mitsuba counts the vertices after the camera's
    result.hide_emitters = p.boolean("hide_emitters").value_or(false);
    return result;
}

// The numbers of samples that Mitsuba takes at a vertex do not change the expected picture.
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
    std::vector<std::string> allowed = {"aov", "direct", "moment"};
    allowed.insert(allowed.end(), path_types.begin(), path_types.end());
    const std::string type = type_of(e, allowed, "path", context.problems());
    const bool is_path = std::find(path_types.begin(), path_types.end(), type) != path_types.end();
    const bool is_around_another = type == "moment" || type == "aov";
    Properties p(e, context.objects);
    Integrator result;
    const Element* nested = nullptr;
    if (is_around_another) {
        const std::vector<const Element*> integrators = p.nested("integrator");
        if (integrators.empty()) p.fail_empty(fmt::format("{} has no <integrator> inside, expected one", p.title()));
        nested = integrators.front();
        const std::string& inner = nested->attribute("type").value;
        if (inner == type) throw InputError(e.place, fmt::format("{} stands inside another one", p.title()));
        // This keeps them from being nested without end.
        if (inner == "aov") throw InputError(e.place, "integrator 'aov' stands inside a 'moment', expected it around that");
        if (type == "aov" && p.text("aovs"))
            context.warnings.add("integrator 'aov': its channels are not written, only the picture of the integrator inside it");
    } else {
        result = is_path ? read_path(p) : read_direct(p);
    }
    read_course_of_work(p);
    p.finish();
    // `moment` only adds the squares of the samples, which the standard errors contain, and `aov` only what is no light.
    return nested ? read_integrator(*nested, context) : result;
}

}  // namespace neumann::reader
