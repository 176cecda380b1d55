#include "apps/commands/replay_command.h"

#include "apps/output/files/health_json.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/recorded_run.h"
#include "apps/output/files/replay_json.h"
#include "core/base/error.h"
#include "operators/paths/walk/path_group.h"

#include <fmt/format.h>
#include <algorithm>

namespace neumann {

namespace {

using Json = nlohmann::ordered_json;

// The requested sample, and why the report named it.
ReportedSample choose(const ReplayRequest& request, const RecordedRun& run, const Film& film) {
    if (!request.number) return {{pixel_number(film, (*request.pixel)[0], (*request.pixel)[1], "--pixel"), *request.sample}, ""};
    const std::vector<ReportedSample> named = reported_samples(run, film);
    if (*request.number <= named.size()) return named[*request.number - 1];
    throw InputError(
        named.empty()
            ? fmt::format("{}: its health report names no sample; take --pixel X,Y --sample S", request.folder)
            : fmt::format("{}: its health report names samples 1 to {}, not {}", request.folder, named.size(), *request.number));
}

std::string text(const Vec3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }

void print(const ReplayedStep& s, const Scene& scene, bool first_unsound) {
    const PathStep& step = s.step;
    fmt::print("{}{}\n", heading(step), first_unsound ? "    <── here a value is no finite number any more" : "");
    fmt::print("    from      {}\n    along     {}\n", text(step.from.position), text(step.w));
    if (step.kind == PathStep::Kind::goes_on && !step.from_light)
        fmt::print("    pdf       {}\n", step.pdf == delta_pdf ? "the only direction" : fmt::format("{:.6g} per sr", step.pdf));
    if (step.kind != PathStep::Kind::shadow_ray)
        fmt::print("    {} {}\n", step.from_light ? "power     " : "throughput", text(step.beta));
    if (step.kind == PathStep::Kind::shadow_ray)
        fmt::print("    {}\n", step.found ? "nothing is in between" : "hidden, or nothing is there");
    else if (step.to.is_infinite())
        fmt::print("    meets     nothing\n");
    else
        fmt::print("    meets     {}, triangle {}\n    at        {}\n    normal    {}\n", name_of_shape(scene, step.to.shape),
                   step.to.primitive, text(step.to.position), text(step.to.normal));
    for (const auto& found : s.found)
        fmt::print("    brings    {} in bounce {}{}\n", text(found.value), found.quantity,
                   found.pixel ? fmt::format(", at {:.6g}, {:.6g} on the film", found.pixel->x, found.pixel->y) : "");
}

}  // namespace

int replay_command(const ReplayRequest& request) {
    if (!request.number && !request.pixel)
        throw InputError("which sample? Take N, the number of one that the health report names, or --pixel X,Y --sample S");
    const RecordedRun run = read_recorded_run(request.folder);
    const Scene scene = read_scene_of(run);
    const ReportedSample chosen = choose(request, run, scene.film);
    RecordedSamplers samplers(scene, run);
    const auto [samples, name] = samplers.find(chosen.name);
    const Replay found = samples.replay(name);
    const Pixel pixel = pixel_of(scene.film, chosen.name.pixel);
    const PathSampler& paths = samples.sampler().path_sampler();
    const char* const of_render = name_of(run.render.method);
    const std::string method =
        paths.parts() > 0 ? fmt::format("{} ({})", of_render, paths.part_of(name).method) : std::string(of_render);
    const auto unsound = std::find_if(found.steps.begin(), found.steps.end(), [](const ReplayedStep& s) { return !is_finite(s); });

    if (request.json) {
        Json json = {{"pixel", {pixel.x, pixel.y}}, {"sample", chosen.name.sample}, {"method", method}};
        if (!chosen.why.empty()) json["why"] = chosen.why;
        json["terms"] = Json::array();
        for (const Rgb& term : found.terms) json["terms"].push_back(as_json(term));
        json["steps"] = Json::array();
        for (const ReplayedStep& s : found.steps) json["steps"].push_back(as_json(s, scene));
        if (unsound != found.steps.end()) json["first_step_that_is_not_finite"] = unsound - found.steps.begin();
        fmt::print("{}\n", json_text(json, 2));
        return 0;
    }
    fmt::print("Sample {} of pixel {},{} by {}{}\n\n", chosen.name.sample, pixel.x, pixel.y, method,
               chosen.why.empty() ? "" : "; " + chosen.why);
    for (auto s = found.steps.begin(); s != found.steps.end(); ++s) print(*s, scene, s == unsound);
    fmt::print("\nWhat it brings to its own pixel\n");
    for (std::size_t q = 0; q < found.terms.size(); ++q)
        fmt::print("{:>8}  {}\n", q + 1 == found.terms.size() ? "rest" : fmt::format("bounce {}", q),
                   fmt::format("{:.9g} {:.9g} {:.9g}", found.terms[q].r, found.terms[q].g, found.terms[q].b));
    return 0;
}

}  // namespace neumann
