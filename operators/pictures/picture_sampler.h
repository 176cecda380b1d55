// Samples the terms over a whole picture, replicate by replicate, and keeps the moments of every term and sum.
#pragma once

#include "core/sampling/independent_sampler.h"
#include "core/sampling/sobol_sampler.h"
#include "core/scene/scene.h"
#include "operators/pictures/term_estimators.h"
#include "operators/statistics/series_moments.h"
#include "operators/statistics/tail_index.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace neumann {

// A sample that is not a finite number: left out of the pictures, counted, and kept so that it can be traced again.
struct NonFiniteSample {
    int x, y, bounce;  // bounce N + 1 stands for the rest
    std::uint64_t sample;
    auto operator<=>(const NonFiniteSample&) const = default;
};

// What is counted beside the pictures; independent of the order of the work. Entries 0 … N and the rest.
struct Tally {
    explicit Tally(std::size_t quantities) : rays(quantities), largest(quantities) {}
    void merge(const Tally& other);

    std::vector<std::uint64_t> rays;
    std::vector<LargestSamples> largest;  // of the samples' largest channel
    std::uint64_t given_up = 0;
    std::uint64_t non_finite_count = 0;
    std::vector<NonFiniteSample> non_finite;  // the first ones in order of pixel and sample
};

// How the terms are sampled: by the walk, with the continuation of the material, of tables, of surfaces, or of mirrors alone; or
// one by one.
enum class Method { walk, guided, surface, classic, pointwise };

class PictureSampler {
public:
    struct Settings {
        Method method = Method::walk;
        std::shared_ptr<const DirectionTables> tables = {};  // of `guided`
        WalkSettings walk;
        SamplerKind sampler = SamplerKind::sobol;
        std::uint64_t seed = 0;
        std::uint32_t replicate_size = 8;  // samples a pixel; a power of two
        // What the pictures and their errors are of: this matrix times the samples' RGB. RGB itself without it.
        std::optional<glm::dmat3> colors = {};
    };

    PictureSampler(const Scene& scene, const Settings& settings);

    int width() const { return scene_.film.crop_width; }
    int height() const { return scene_.film.crop_height; }
    std::size_t quantities() const { return static_cast<std::size_t>(settings_.walk.bounces) + 2; }
    const Settings& settings() const { return settings_; }

    // Replicates first … first + count − 1 of every pixel; count is a power of two that divides first. What is counted is added to
    // `tally`, which has the replicates before, unless the work is dropped. `watch` is told the pixels that are done as work goes
    // on, from any thread, and drops the work by answering true. `memory` is used for the node: fresh pages for every block would
    // cost as much as the moments themselves.
    using Watch = std::function<bool(std::uint64_t pixels_done)>;
    std::optional<MomentsNode> run(std::uint64_t first, std::uint64_t count, Tally& tally, const Watch& watch = {},
                                   std::vector<double> memory = {}) const;

private:
    const Scene& scene_;
    Settings settings_;
    TermEstimator estimator_;
    SobolPoints sobol_;
};

}  // namespace neumann
