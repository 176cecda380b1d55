// What the ways to render a series share: how many bounces, and what a result is judged by.
#pragma once

#include "apps/commands/render.h"
#include "apps/commands/ways.h"
#include "apps/files/rendered_picture.h"
#include "core/base/warnings.h"
#include "operators/pictures/bounce_series.h"
#include "operators/pictures/pilot.h"
#include "operators/pictures/sampling_settings.h"
#include "operators/plan/plan.h"

#include <nlohmann/json.hpp>

namespace neumann {

// Without any goal: a good picture, or what a short wait gives.
constexpr double default_seconds = 20.0, default_error = 0.02;
// The most that --error takes without --time, seconds.
constexpr double longest_search = 600.0;

struct RenderJob {
    const RenderRequest& request;
    const Scene& scene;
    const Pilot& pilot;
    const Plan& plan;  // without parts where nothing is left out
    // Told how far it is with bounces 0 … N and the rest, from any thread.
    std::function<void(int bounces, const RenderProgress&)> progress = [](int, const RenderProgress&) {};
    // Told the last bounce as soon as it is known, before anything is sampled; may throw.
    std::function<void(int bounces)> chosen = [](int) {};
};

struct RenderResult {
    BounceSeries series;
    Warnings warnings;
    // Parts of run.json that belong to the method.
    nlohmann::ordered_json options, samples, rest;
    // Likewise; it says how to replay what a folder will hold. Empty where only pictures are wanted.
    std::function<nlohmann::ordered_json(const std::string& folder)> health;
    std::optional<Ways> ways;
};

RenderResult render_by_walk(const RenderJob& job);    // walk, guided, surface, classic and pointwise
RenderResult render_by_fields(const RenderJob& job);  // patches, matrix and gather
inline bool is_field_method(const std::string& method) { return method == "patches" || method == "matrix" || method == "gather"; }
// By request.method.
RenderResult render_by_method(const RenderJob& job);

// How the methods that make paths sample a scene, but for the bounces, the rest, the tables and the replicates. Throws InputError.
SamplingSettings sampling_settings(const RenderRequest& request, const Scene& scene, const Plan& plan);
std::shared_ptr<const DirectionTables> direction_tables(const RenderRequest& request, const Scene& scene, int bounces);

// What the method does not need of the scene, unless nothing is to be left out. Throws InputError.
Plan plan_of(const RenderRequest& request, const Scene& scene);
// The last bounce with a picture of its own. Throws RunError where --tail cannot be met.
int choose_bounces(const RenderJob& job);
// The same where neither the request nor the scene says.
int default_bounces(const Pilot& pilot);

// A picture of an earlier render, of the size of this film. Throws InputError.
RenderedPicture read_reference(const std::string& folder, const std::string& file, const Film& film);

// The pictures of an earlier render, to judge this one by.
class Reference {
public:
    Reference(const std::string& folder, int bounces, const Film& film);
    void judge(const std::function<Image(std::size_t)>& term, const Image& sum, Checkpoint& checkpoint) const;

private:
    std::vector<Image> terms_;
    Image sum_;
};

}  // namespace neumann
