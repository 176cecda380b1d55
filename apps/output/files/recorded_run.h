// A render as described by its run.json, and its samples, which can be traced again.
#pragma once

#include "apps/requests/scene_file.h"
#include "operators/render/from_paths/rendered_series.h"
#include "operators/render/methods/bounce_series.h"
#include "operators/render/methods/recorded_render.h"
#include "operators/render/report/pixel_history.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace neumann {

struct RecordedRun {
    std::string folder, hash, version;
    SceneFile scene;
    RecordedRender render;
    std::uint64_t first = 0, samples = 0;  // in a part of a render, `first` is above 0
    std::vector<SeedRange> merged;         // set if the samples are of several seeds
    struct Named {
        Pixel pixel;  // the pixel of its path
        std::uint64_t sample;
        std::string why;  // "bounce 3: the largest sample of …"
    };
    std::vector<Named> named;  // the samples that the health report names
};

// Throws InputError if there is no such folder or run.json, and if the method has no paths.
RecordedRun read_recorded_run(const std::string& folder);
// The same for a render whose run.json is not on disk yet; `folder`: for messages.
RecordedRun recorded_run(const BounceSeries& series, const SceneFile& file, const Scene& scene, const std::string& folder);

// Reads its scene. Warns on stderr if that has changed since, or if another version rendered it.
Scene read_scene_of(const RecordedRun& run);

// The number of a pixel. Throws InputError, which begins with the option, if it is not in the picture.
std::uint32_t pixel_number(const Film& film, int x, int y, const char* option);

struct ReportedSample {
    SampleName name;
    std::string why;  // "bounce 3: the largest sample of …"
};
std::vector<ReportedSample> reported_samples(const RecordedRun& run, const Film& film);

// The samplers of a run, made when they are needed.
class RecordedSamplers {
public:
    // The scene and the run must outlive this object.
    RecordedSamplers(const Scene& scene, const RecordedRun& run) : scene_(scene), run_(run) {}

    // The sampler that has a sample, and its name there; for a merged render, the sampler of the seed that has it.
    // Throws InputError if the run has no such sample.
    struct FoundSample {
        const RecordedSamples& samples;
        SampleName name;
    };
    FoundSample find(SampleName name);
    std::vector<ReplicatesOf> replicates();

private:
    // The samples of seed number i; 0 if there is only one.
    const RecordedSamples& of_seed(std::size_t i);

    const Scene& scene_;
    const RecordedRun& run_;
    std::map<std::size_t, std::unique_ptr<const RecordedSamples>> made_;
};

}  // namespace neumann
