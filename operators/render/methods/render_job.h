// Data and functions that both implementations of render() share.
#pragma once

#include "core/base/stopwatch.h"
#include "operators/render/from_paths/pilot.h"
#include "operators/render/methods/prepared.h"
#include "operators/render/methods/render.h"

#include <optional>

namespace neumann {

// A pilot that runs when it is first asked for: a render whose bounces and samples are given may need none.
class PilotOnDemand {
public:
    PilotOnDemand(const Scene& scene, const DirectLightSettings& direct, const Goal& goal)
        : scene_(&scene),
          direct_(direct),
          seed_(goal.seed),
          bounces_(goal.bounces.value_or(goal.tail ? 0 : scene.bounces.value_or(0))),
          tail_(goal.tail.value_or(Pilot::default_tail)) {}
    explicit PilotOnDemand(const Pilot& given) : given_(&given) {}

    const Pilot& operator()() const {
        if (given_) return *given_;
        if (!made_) made_.emplace(*scene_, direct_, seed_, bounces_, tail_);
        return *made_;
    }

private:
    const Scene* scene_ = nullptr;
    DirectLightSettings direct_;
    std::uint64_t seed_ = 0;
    int bounces_ = 0;
    double tail_ = Pilot::default_tail;
    const Pilot* given_ = nullptr;
    mutable std::optional<Pilot> made_;
};

struct RenderJob {
    const Scene& scene;  // without the materials that the plan leaves out
    const Plan& plan;
    const Goal& goal;
    const Watch& watch;
    const PilotOnDemand& pilot;
    Saving& saving;
    const std::optional<MethodChoice>& choice;
    Prepared& prepared;
    const Stopwatch& clock;  // runs since the render began, including its pilots

    // Seconds before the first sample that count towards goal.seconds; includes the earlier pilots of a continued render.
    double seconds_gone() const { return clock.seconds() + (saving.from && choice ? choice->seconds : 0.0); }
};

// Like render(); uses what was prepared before and keeps what will be used again.
BounceSeries render(const Scene& scene, const Method& method, const Goal& goal, const Watch& watch, Prepared& prepared);

// Sets the parts of a series that are the same for all series of a job.
void describe(BounceSeries& series, const RenderJob& job);

BounceSeries render_by_paths(const Method& method, const RenderJob& job);
BounceSeries render_by_fields(const Method& method, const RenderJob& job);

// N, the last bounce with a picture of its own. Throws RunError if a tail cannot be met.
int choose_bounces(const Goal& goal, const Scene& scene, const PilotOnDemand& pilot);
// The same, or the N of the render that is continued; calls watch.chosen(N).
int choose_bounces(const RenderJob& job);

}  // namespace neumann
