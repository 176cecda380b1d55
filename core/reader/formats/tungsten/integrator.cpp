#include "core/reader/formats/tungsten/integrator.h"

#include "core/reader/formats/make_elements.h"

#include <limits>

#include <fmt/format.h>

namespace neumann::reader::tungsten {

namespace {

constexpr std::int64_t usual_bounces = 64;

// These say how paths are drawn, in any of the integrators.
void ignore_settings(JsonObject& integrator) {
    integrator.ignore({"alpha",
                       "bidirectional",
                       "enable_light_sampling",
                       "enable_volume_light_sampling",
                       "fixed_volume_radius",
                       "gather_photon_count",
                       "gather_radius",
                       "gaussian_mutation",
                       "grid_memory",
                       "image_pyramid",
                       "include_surfaces",
                       "initial_sample_pool",
                       "iterations",
                       "iterations_per_batch",
                       "large_step_probability",
                       "low_order_scattering",
                       "photon_count",
                       "use_frustum_grid",
                       "use_grid",
                       "volume_gather_radius",
                       "volume_photon_count",
                       "volume_photon_type"});
}

}  // namespace

void read_integrator(JsonObject& root, Importing& importing) {
    std::int64_t most = usual_bounces;
    Location place = root.place();
    if (auto integrator = root.object("integrator")) {
        place = integrator->place_of("max_bounces");
        importing.notes.problems.attempt(integrator->place(), [&] {
            static const std::vector<std::string> types = {"bidirectional_path_tracer", "kelemen_mlt",        "light_tracer",
                                                           "multiplexed_mlt",           "path_tracer",        "photon_map",
                                                           "progressive_photon_map",    "reversible_jump_mlt"};
            read_type(*integrator, "integrator", types, "taken as 'path_tracer'", importing);
            constexpr auto largest = std::numeric_limits<std::int32_t>::max();
            most = integrator->integer("max_bounces", 1, largest).value_or(usual_bounces);
            if (const auto least = integrator->integer("min_bounces", 0, largest); least.value_or(0) > 0)
                importing.notes.warnings.add(
                    fmt::format("min_bounces of the integrator is {}: the bounces before that are computed as well", *least));
            if (integrator->boolean("enable_consistency_checks", false))
                importing.notes.warnings.add("enable_consistency_checks of the integrator is left out");
            importing.two_sided = integrator->boolean("enable_two_sided_shading", true);
            // Without surfaces only what has passed through a medium is seen.
            if (!integrator->boolean("include_surfaces", true))
                importing.refuse(integrator->place_of("include_surfaces"), "include_surfaces is false", ", expected true",
                                 "taken as true");
            ignore_settings(*integrator);
            integrator->finish();
        });
    }
    Element integrator = make_object("integrator", "path", place);
    add_integer(integrator, "max_depth", most, place);  // both programs count the vertices after the camera's
    add(importing.scene.root, std::move(integrator));
}

}  // namespace neumann::reader::tungsten
