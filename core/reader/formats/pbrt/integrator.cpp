#include "core/base/did_you_mean.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/pbrt/sensor.h"
#include "core/reader/meshes/mesh_text.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

namespace {

// The integrators that estimate all light of paths with at most `maxdepth` reflections.
const std::vector<std::string> integrator_types = {"bdpt",       "lightpath",     "mlt",  "path",   "randomwalk",
                                                   "simplepath", "simplevolpath", "sppm", "volpath"};

}  // namespace

Element make_integrator(PbrtScene& from, Importer& importer) {
    if (!from.integrator) from.integrator = missing_entity("integrator", "volpath", from, importer);
    Entity& e = *from.integrator;
    Parameters& p = e.parameters;
    if (std::find(integrator_types.begin(), integrator_types.end(), e.type) == integrator_types.end())
        importer.problems.replace(Unknown(e.place(), fmt::format("integrator type '{}' is not supported", printable(e.type)),
                                          "; " + allowed_instead(e.type, integrator_types), "taken as 'path'"),
                                  e.place());
    const std::int64_t depth = p.integer("maxdepth").value_or(5);
    if (depth < 0) p.complain("maxdepth", fmt::format("maxdepth of {} is {}, expected at least 0", p.title(), depth));
    if (p.boolean("regularize").value_or(false))
        importer.warnings.add("regularize of the integrator is left out: no material becomes rougher along a path");
    // These say how paths are drawn.
    p.ignore({"bootstrapsamples", "chains", "largestepprobability", "lightsampler", "mutationsperpixel", "photonsperiteration",
              "radius", "samplebsdf", "samplelights", "seed", "sigma", "visualizestrategies", "visualizeweights"});
    p.finish();
    if (p.is_wrong()) throw AlreadyReported();
    Element integrator = make_object("integrator", "path", e.place());
    add_integer(integrator, "max_depth", depth + 1, p.place("maxdepth"));  // Mitsuba counts the vertex that emits, too
    return integrator;
}

}  // namespace neumann::reader::pbrt
