#include "operators/render/methods/bounces.h"

#include "core/base/error.h"
#include "operators/render/methods/render_job.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann {

namespace {

// The least number is 16 because the strip of doubling sums shows sums up to bounce 16.
constexpr int default_least_bounces = 16, default_most_bounces = 64;

int bounces_for(double tail, const Pilot& pilot) {
    if (!pilot.converges())
        throw RunError(fmt::format(
            "tail {}: the series does not converge: {} of {} walks had not ended after {} bounces; give the number of bounces",
            tail, pilot.given_up(), pilot.walks(), pilot.bounces() + Pilot::give_up));
    const int n = pilot.bounces_for_tail(tail);
    if (n < 0)
        throw RunError(
            fmt::format("tail {}: more than {} bounces would be needed; give the number of bounces", tail, pilot.bounces()));
    return n;
}

}  // namespace

int default_bounces(const Pilot& pilot) {
    const int n = pilot.converges() ? pilot.bounces_for_tail(Pilot::default_tail) : -1;
    const int enough = n < 0 ? default_least_bounces : std::clamp(n, default_least_bounces, default_most_bounces);
    const int end = pilot.bounces_for_tail(0.0);
    return end < 0 ? enough : std::min(enough, end);
}

int choose_bounces(const Goal& goal, const Scene& scene, const PilotOnDemand& pilot) {
    return goal.bounces    ? *goal.bounces
           : goal.tail     ? bounces_for(*goal.tail, pilot())
           : scene.bounces ? *scene.bounces
                           : default_bounces(pilot());
}

int choose_bounces(const RenderJob& job) {
    const int bounces = job.saving.from ? job.saving.from->render.bounces : choose_bounces(job.goal, job.scene, job.pilot);
    job.watch.chosen(bounces);
    return bounces;
}

}  // namespace neumann
