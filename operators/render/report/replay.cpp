#include "operators/render/report/replay.h"

#include "operators/paths/walk/path_group.h"

#include <algorithm>
#include <cmath>

namespace neumann {

bool is_finite(const ReplayedStep& replayed) {
    const PathStep& step = replayed.step;
    if (!is_finite(step.w) || !is_finite(step.beta) || !(std::isfinite(step.pdf) || step.pdf == delta_pdf)) return false;
    if (step.found && !step.to.is_infinite() && !is_finite(step.to.position)) return false;
    for (const auto& found : replayed.found)
        if (!is_finite(found.value)) return false;
    return true;
}

Replay replay(const PictureSampler& sampler, const SampleName& name) {
    const PathSampler& paths = sampler.path_sampler();
    if (paths.parts() > 0) {
        const auto& [of_part, name_there, part, method] = paths.part_of(name);
        Replay replayed = replay(of_part, name_there);
        for (std::size_t q = 0; q < replayed.terms.size(); ++q) replayed.terms[q] *= paths.scale(part, q, name.pixel);
        for (ReplayedStep& step : replayed.steps)
            for (auto& [quantity, value, position] : step.found)
                value *= position ? paths.scale(part, quantity, *position) : paths.scale(part, quantity, name.pixel);
        return replayed;
    }
    struct Recorder : PathObserver {
        std::uint32_t chosen;
        std::vector<ReplayedStep> steps;
        std::optional<std::uint32_t> read_path;
        std::uint32_t read_vertex = 0;
        double most = 0.0;

        bool watches(std::uint32_t path) const override { return path == chosen; }
        void step(std::uint32_t, const PathStep& step) override { steps.push_back({step, {}}); }
        void found(std::uint32_t, std::size_t quantity, const Rgb& value, const Vec2* pixel) override {
            steps.back().found.push_back({quantity, value, pixel ? std::optional(*pixel) : std::nullopt});
        }
        void read(std::uint32_t, std::uint32_t path, std::uint32_t vertex, const Rgb& value) override {
            if (read_path && max_component(value) <= most) return;
            read_path = path;
            read_vertex = vertex;
            most = max_component(value);
        }
    } recorder;
    const PlaceInGroup place = sampler.layout().place(name);
    recorder.chosen = place.path;
    const std::vector<Rgb> samples = paths.retrace(place.replicate, place.first, recorder);
    if (recorder.read_path) {
        const std::uint32_t path = *recorder.read_path;
        recorder.chosen = paths.of_read(path);
        const std::size_t own = recorder.steps.size();
        paths.retrace_read(place.replicate, path, recorder);
        recorder.steps.resize(std::min(recorder.steps.size(), own + recorder.read_vertex));
    }
    const std::size_t terms = sampler.settings().pictures();
    Replay result{std::move(recorder.steps), std::vector<Rgb>(terms, Rgb(0.0))};
    if (!samples.empty())
        std::copy_n(samples.begin() + static_cast<std::ptrdiff_t>(place.path * sampler.quantities()), terms, result.terms.begin());
    return result;
}

}  // namespace neumann
