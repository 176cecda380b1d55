#include "operators/pictures/replay.h"

#include "operators/pictures/path_group.h"

namespace neumann {

Replay replay(const PictureSampler& sampler, const SampleName& name) {
    struct Recorder : PathObserver {
        std::uint32_t chosen;
        std::vector<ReplayedStep> steps;

        bool watches(std::uint32_t path) const override { return path == chosen; }
        void step(std::uint32_t, const PathStep& step) override { steps.push_back({step, {}}); }
        void found(std::uint32_t, std::size_t quantity, const Rgb& value, const Vec2* pixel) override {
            steps.back().found.push_back({quantity, value, pixel ? std::optional(*pixel) : std::nullopt});
        }
    } recorder;
    const PlaceInGroup place = place_in_group(name, sampler.settings().replicate_size);
    recorder.chosen = place.path;
    const std::vector<Rgb> samples = sampler.retrace(place.replicate, place.first, recorder);
    Replay result{std::move(recorder.steps), std::vector<Rgb>(sampler.quantities(), Rgb(0.0))};
    if (!samples.empty())
        std::copy_n(samples.begin() + static_cast<std::ptrdiff_t>(place.path * sampler.quantities()), sampler.quantities(),
                    result.terms.begin());
    return result;
}

}  // namespace neumann
