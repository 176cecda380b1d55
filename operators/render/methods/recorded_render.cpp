#include "operators/render/methods/recorded_render.h"

#include "core/base/memory.h"
#include "operators/render/methods/method_plan.h"
#include "operators/render/methods/sampling.h"

namespace neumann {

std::string why_no_replay(const Method& method) {
    return std::visit(
        []<class M>(const M&) {
            if constexpr (MakesPaths<M>) return M::why_no_replay;
            return "its bounces are read from fields on patches";
        },
        method);
}

RecordedSamples::RecordedSamples(const Scene& scene, const RecordedRender& render, const std::optional<glm::dmat3>& colors) {
    const Plan plan = plan_for(render.method, scene);
    if (std::optional<Scene> reduced = without_unlit_materials(plan, scene))
        reduced_ = std::make_unique<const Scene>(std::move(*reduced));
    const Scene& rendered = reduced_ ? *reduced_ : scene;
    SamplingSettings settings = sampling_settings(render.method, rendered, plan, render.seed);
    settings.walk.bounces = render.bounces;
    settings.walk.rest_probability = render.rest_probability;
    settings.replicate_size = render.replicate_size;
    settings.colors = colors;
    Prepared prepared(render.seed);
    set_up(render.method, rendered, render.bounces, default_memory(), settings, prepared);
    sampler_ = std::make_unique<const PictureSampler>(rendered, settings);
}

Replay replay(const Scene& scene, const RecordedRender& render, const SampleName& name) {
    return RecordedSamples(scene, render).replay(name);
}

}  // namespace neumann
