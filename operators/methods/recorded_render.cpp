#include "operators/methods/recorded_render.h"

#include "core/base/memory.h"
#include "operators/methods/method_plan.h"
#include "operators/methods/sampling.h"

namespace neumann {

std::string why_no_replay(const Method& method) {
    if (has_fields(method)) return "its bounces are read from fields on patches";
    if (std::holds_alternative<method::Pointwise>(method)) return "each of its bounces is asked for anew";
    return "";
}

Replay replay(const Scene& scene, const RecordedRender& render, const SampleName& name) {
    const Plan plan = plan_for(render.method, scene);
    const std::optional<Scene> reduced = without_unlit_materials(plan, scene);
    const Scene& rendered = reduced ? *reduced : scene;
    SamplingSettings settings = sampling_settings(render.method, rendered, plan, render.seed);
    settings.walk.bounces = render.bounces;
    settings.walk.rest_probability = render.rest_probability;
    settings.replicate_size = render.replicate_size;
    set_up(render.method, rendered, render.bounces, render.seed, default_memory(), settings);
    return replay(PictureSampler(rendered, settings), name);
}

}  // namespace neumann
