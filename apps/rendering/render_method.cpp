#include "apps/rendering/render_method.h"

#include "apps/files/series_files.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <fstream>

namespace neumann {

namespace {

// Bounces without any request: until the rest is below this part of the sum.
constexpr double default_tail = 0.01;
// At least the last of the sums that strip-doubling shows.
constexpr int default_least_bounces = 16, default_most_bounces = 64;

// Those of the plan that the method takes.
std::vector<bool LeftOut::*> decisions(const RenderRequest& request) {
    const std::string &method = request.method, &direct = request.light.direct;
    if (is_field_method(method)) return {};
    std::vector<bool LeftOut::*> taken{&LeftOut::rays_from_surfaces, &LeftOut::rays_for_light};
    if (direct != "hemisphere" && direct != "cosine") taken.push_back(&LeftOut::shadow_rays_in_room);
    if ((method == "walk" || method == "guided") && (direct.empty() || direct.starts_with("mis")))
        taken.push_back(&LeftOut::questions);
    return taken;
}

}  // namespace

Plan plan_of(const RenderRequest& request, const Scene& scene) {
    if (request.plan == "full" && is_field_method(request.method))
        throw InputError(
            fmt::format("--plan full belongs to the methods that make paths; fields of {} have one channel where the scene is grey",
                        request.method));
    const bool takes_none = request.method == "light" || request.method == "bidirectional" || request.method == "pointwise";
    if (request.plan == "full" || takes_none) return {};
    const auto taken = decisions(request);
    Plan plan = make_plan(scene);
    std::erase_if(plan.parts, [&](const PlanPart& p) {
        if (!p.decision || std::find(taken.begin(), taken.end(), p.decision) != taken.end()) return false;
        plan.walk.*p.decision = false;
        return true;
    });
    if (!request.light.roulette.empty() && request.light.roulette != "none")
        for (PlanPart& p : plan.parts)
            if (p.part == roulette_part) p = {roulette_part, true, "--roulette asks for it", ""};
    return plan;
}

namespace {

int find_bounces(const RenderJob& job) {
    const auto& [request, scene, pilot, plan, progress, chosen] = job;
    if (request.bounces) return *request.bounces;
    if (request.tail) {
        if (!pilot.converges())
            throw RunError(fmt::format(
                "--tail {}: the series does not converge: {} of {} walks had not ended after {} bounces; give the bounces with -n",
                *request.tail, pilot.given_up(), pilot.walks(), Pilot::bounces + Pilot::give_up));
        const int n = pilot.bounces_for_tail(*request.tail);
        if (n < 0)
            throw RunError(fmt::format("--tail {}: more than {} bounces would be needed; give the bounces with -n", *request.tail,
                                       Pilot::bounces));
        return n;
    }
    return scene.bounces ? *scene.bounces : default_bounces(pilot);
}

}  // namespace

int choose_bounces(const RenderJob& job) {
    const int bounces = find_bounces(job);
    job.chosen(bounces);
    return bounces;
}

int default_bounces(const Pilot& pilot) {
    const int n = pilot.converges() ? pilot.bounces_for_tail(default_tail) : -1;
    const int enough = n < 0 ? default_least_bounces : std::clamp(n, default_least_bounces, default_most_bounces);
    const int end = pilot.bounces_for_tail(0.0);
    return end < 0 ? enough : std::min(enough, end);
}

namespace {

// By what its run.json says, where it has one.
void warn_of_reference(const RenderRequest& request, Warnings& warnings) {
    std::ifstream file(std::filesystem::path(request.reference) / "run.json");
    const auto run = nlohmann::json::parse(file, nullptr, false);
    if (run.is_discarded()) return;
    const auto is = [&](const char* part, const nlohmann::json& value) {
        const nlohmann::json::json_pointer at(part);
        return run.contains(at) && run.at(at) == value;
    };
    if (is("/options/seed", request.seed) && is("/options/method", request.method))
        warnings.add("the reference has the same seed and method, so that samples are shared: errors against it are too small");
    if (run.contains("paths") && !is("/paths", "all")) warnings.add("the reference has a subset of all paths");
    if (run.contains("quantity") && is("/quantity/unit", "m^-2 sr^-1") != request.importance)
        warnings.add("the reference is of another quantity: radiance against importance");
}

}  // namespace

RenderResult render_by_method(const RenderJob& job) {
    if (job.request.importance && job.request.method != "patches")
        throw InputError("--importance belongs to --method patches, not to " + job.request.method);
    if (job.request.importance && job.request.tail)
        throw InputError("--tail counts bounces by what is left of the light, not of importance: --importance takes -n");
    RenderResult result = is_field_method(job.request.method) ? render_by_fields(job) : render_by_walk(job);
    if (!job.request.reference.empty()) warn_of_reference(job.request, result.warnings);
    return result;
}

RenderedPicture read_reference(const std::string& folder, const std::string& file, const Film& film) {
    const std::string path = (std::filesystem::path(folder) / file).string();
    RenderedPicture rendered = read_rendered_picture(path);
    const Image& image = rendered.picture.mean;
    if (image.width != film.crop_width || image.height != film.crop_height)
        throw InputError(fmt::format("{}: is {}×{} pixels, expected {}×{} as the scene's film", path, image.width, image.height,
                                     film.crop_width, film.crop_height));
    return rendered;
}

Reference::Reference(const std::string& folder, int bounces, const Film& film) {
    if (!std::filesystem::is_directory(folder))
        throw InputError(folder + ": is not a folder; --reference takes the folder of an earlier render");
    for (int i = 0; i <= bounces; ++i)
        terms_.push_back(read_reference(folder, bounce_file(static_cast<std::size_t>(i)), film).picture.mean);
    sum_ = read_reference(folder, sum_file(static_cast<std::size_t>(bounces)), film).picture.mean;
}

void Reference::judge(const std::function<Image(std::size_t)>& term, const Image& sum, Checkpoint& checkpoint) const {
    for (std::size_t i = 0; i < terms_.size(); ++i) checkpoint.true_term_error.push_back(relative_error(term(i), terms_[i]));
    checkpoint.true_sum_error = relative_error(sum, sum_);
}

}  // namespace neumann
