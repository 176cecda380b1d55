// Traces samples of an earlier render again.
#pragma once

#include "operators/render/methods/method.h"
#include "operators/render/report/replay.h"

#include <glm/glm.hpp>

#include <memory>
#include <optional>
#include <string>

namespace neumann {

// The settings that determine the samples of a render in its scene: as in the BounceSeries that it returned.
struct RecordedRender {
    Method method;
    std::uint64_t seed = 0;
    int bounces = 0;
    double rest_probability = 0.0;
    std::uint32_t replicate_size = 1;
};

// Explains why this method has no paths to replay, in words; empty if it has.
std::string why_no_replay(const Method& method);

// Many samples of one render, with the same bits as in the render if the scene is the same.
class RecordedSamples {
public:
    // The scene must outlive this object. Throws InputError if the method cannot render it.
    RecordedSamples(const Scene& scene, const RecordedRender& render, const std::optional<glm::dmat3>& colors = {});

    const PictureSampler& sampler() const { return *sampler_; }
    Replay replay(const SampleName& name) const { return neumann::replay(*sampler_, name); }

private:
    std::unique_ptr<const Scene> reduced_;
    std::unique_ptr<const PictureSampler> sampler_;
};

Replay replay(const Scene& scene, const RecordedRender& render, const SampleName& name);

}  // namespace neumann
