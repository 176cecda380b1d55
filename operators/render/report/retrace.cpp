// Traces paths again for an observer: the same walks, compiled for size.
#include "core/sampling/sampler.h"
#include "operators/paths/cache/record_rays.h"
#include "operators/paths/photons/photon_paths.h"
#include "operators/paths/reuse/reusing_walk.h"
#include "operators/paths/walk/guided_continuation.h"
#include "operators/paths/walk/hemisphere_continuation.h"
#include "operators/paths/walk/path_group.h"
#include "operators/paths/walk/tree_walk.h"
#include "operators/paths/walk/walk.h"
#include "operators/render/from_paths/cache_group.h"
#include "operators/render/from_paths/corrected_group.h"
#include "operators/render/from_paths/metropolis_group.h"
#include "operators/render/from_paths/photon_group.h"
#include "operators/render/from_paths/pixel_samples.h"
#include "operators/render/from_paths/splat_group.h"
#include "operators/render/from_paths/walk_estimators.h"
#include "operators/render/report/watched_paths.h"

#include <algorithm>

namespace neumann {

template <class Continuation>
void WalkEstimator<Continuation>::trace(PathObserver& observer, std::span<const CameraRay> rays, std::span<Sampler> samplers,
                                        Walkers& walkers, TermSamples& result) const {
    WalkSettings settings = settings_;
    settings.left_out = {};
    walk(*scene_, scene_->geometry, direct_, settings, rays, samplers, walkers, result, continuation_, WatchedPaths(observer));
}

namespace {

// Reports the walks into which a path was split as steps of the path. path_of(walker) is the path of a walker.
template <class PathOf>
class SplitPaths : public PathObserver {
public:
    SplitPaths(PathObserver& observer, const PathOf& path_of) : observer_(observer), path_of_(path_of) {}
    bool watches(std::uint32_t walker) const override { return observer_.watches(path_of_(walker)); }
    void step(std::uint32_t walker, const PathStep& step) override { observer_.step(path_of_(walker), step); }
    void found(std::uint32_t walker, std::size_t quantity, const Rgb& value, const Vec2* pixel) override {
        observer_.found(path_of_(walker), quantity, value, pixel);
    }

private:
    PathObserver& observer_;
    PathOf path_of_;
};

}  // namespace

void TreeEstimator::trace(PathObserver& observer, std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&,
                          TermSamples& result) const {
    TreeWalkers tree;
    SplitPaths split(observer, [&](std::uint32_t walker) { return tree.path[walker]; });
    walk_tree(*scene_, direct_, settings_, *ratios_, rays, samplers, tree, result, WatchedPaths(split));
}

void ReusingEstimator::trace(PathObserver& observer, std::span<const CameraRay> rays, std::span<Sampler> samplers, Walkers&,
                             TermSamples& result) const {
    walk_reusing(
        *scene_, direct_, diffuse_, settings_, size_, sharing_, rays, samplers, result,
        [&](const WalkSettings& settings, std::span<Sampler> random, Walkers& tails, TermSamples& found, const auto& watched) {
            walk_on(*scene_, scene_->geometry, direct_, settings, random, tails, found, MaterialContinuation(), watched);
        },
        WatchedPaths(observer));
}

template class WalkEstimator<MaterialContinuation>;
template class WalkEstimator<SurfaceContinuation>;
template class WalkEstimator<SpecularContinuation>;
template class WalkEstimator<GuidedContinuation>;
template class WalkEstimator<HemisphereContinuation>;

std::vector<Rgb> EstimatorSampler::retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const {
    PixelSamples samples;
    samples.begin(scene_->film, settings_, layout_, layout_.group_with(first));
    PathGroup group;
    std::vector<std::uint64_t> rays(settings_.quantities());
    const auto watched = [&](auto camera_rays, auto random, Walkers& walkers, TermSamples& result) {
        estimator_->trace(observer, camera_rays, random, walkers, result);
    };
    trace(*scene_, watched, std::span(samples.samplers), std::span<const Pixel>(samples.pixels), replicate, group, std::span(rays));
    return std::move(group.samples);
}

std::vector<Rgb> SplatSampler::retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const {
    const std::size_t Q = settings_.quantities();
    const std::uint32_t samples = layout_.group_with(first).paths();
    Workspace work(Q);
    PathGroup& group = work.group;
    const auto tell = [&](std::uint32_t i, std::size_t q, const Rgb& value, const Vec2* position) {
        if (observer.watches(i)) observer.found(i, q, value, position);
    };
    trace_group(
        replicate, first, samples,
        [&](std::uint32_t i, std::size_t q, const Rgb& value) {
            group.samples[i * Q + q] += value;
            tell(i, q, value, nullptr);
        },
        [&](std::uint32_t i, const Vec2& position, std::size_t q, const Rgb& value) {
            tell(i, q, value / static_cast<double>(pixels_), &position);
        },
        work, WatchedPaths(observer));
    for (std::size_t k = 0; k < group.samples.size(); ++k) group.samples[k] *= group.weights[k / Q];
    return std::move(group.samples);
}

namespace {

CorrectedSampler::Shared shared_of(const CorrectedSampler& sampler, std::uint64_t replicate, std::size_t quantities) {
    std::vector<std::uint64_t> rays(quantities);
    std::uint64_t given_up = 0;
    return *sampler.shared(replicate, nullptr, rays, given_up, {});
}

}  // namespace

std::vector<Rgb> CorrectedSampler::retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const {
    return retrace(replicate, first, shared_of(*this, replicate, settings_.quantities()).points(), observer);
}

namespace {

class WithPointsOfFirst : public PathsToInspect {
public:
    WithPointsOfFirst(const CorrectedSampler& sampler, const SampleLayout& layout, std::size_t quantities)
        : sampler_(sampler), layout_(layout), shared_(shared_of(sampler, 0, quantities)) {}
    std::uint32_t groups() const override { return layout_.groups(); }
    Group group(std::uint32_t number) const override {
        const PixelGroup pixels = layout_.group(number);
        return {layout_.first_path(pixels.begin), pixels.paths()};
    }
    bool are_of_first_replicate() const override { return true; }
    void retrace(std::uint64_t replicate, const Group& group, PathObserver& observer) const override {
        (void)sampler_.retrace(replicate, group.first, shared_.points(), observer);
    }

private:
    const CorrectedSampler& sampler_;
    const SampleLayout& layout_;
    CorrectedSampler::Shared shared_;
};

}  // namespace

std::unique_ptr<const PathsToInspect> CorrectedSampler::to_inspect() const {
    return std::make_unique<const WithPointsOfFirst>(*this, layout_, settings_.quantities());
}

std::vector<Rgb> CorrectedSampler::retrace(std::uint64_t replicate, std::uint32_t first, const JoinedPoints& points,
                                           PathObserver& observer) const {
    Workspace work(settings_.quantities());
    SplitPaths split(observer, [&](std::uint32_t walker) { return work.walkers.walker[walker].path; });
    trace_group(replicate, layout_.group_with(first), points, work, WatchedPaths(split));
    return std::move(work.group.samples);
}

std::vector<Rgb> PhotonSampler::retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const {
    std::vector<std::uint64_t> rays;
    std::uint64_t given_up = 0;
    const auto pass = make_pass(replicate, rays, given_up, {});
    Workspace work(settings_.quantities());
    trace_group(replicate, layout_.group_with(first), *pass, work, WatchedPaths(observer));
    return std::move(work.group.samples);
}

void PhotonSampler::retrace_read(std::uint64_t replicate, std::uint32_t path, PathObserver& observer) const {
    PhotonTracer::Workspace work;
    const std::uint32_t first = path / PhotonTracer::at_once * PhotonTracer::at_once;
    photons_.trace_group(
        replicate, first, work, [](auto...) {}, [](int, std::size_t) {}, WatchedPaths(observer));
}

std::vector<Rgb> MetropolisSampler::retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const {
    const std::size_t Q = settings_.quantities(), N = Q - 2;
    const std::uint32_t size = settings_.replicate_size, samples = std::min(paths_at_once, pixels_ * size - first),
                        group = first / chains_at_once;
    const WatchedPaths watched(observer);
    std::vector<Rgb> own(samples * Q, Rgb(0.0));
    CameraWork camera;
    trace_camera_rays(replicate, first, samples, camera, watched);
    for (std::uint32_t i = 0; i < samples; ++i) {
        own[i * Q] = camera.emitted[i];
        if (observer.watches(i) && !is_black(own[i * Q])) observer.found(i, 0, own[i * Q], nullptr);
    }
    std::vector<std::uint64_t> rays(Q);
    if (group < independent_.groups()) {
        IndependentPaths::Workspace work;
        (void)independent_.trace_group(
            replicate, group, work,
            [&](std::uint32_t i, const WayFound& found) {
                if (found.bounce > static_cast<int>(N) && observer.watches(i))
                    observer.found(i, N + 1, found.value * (static_cast<double>(size) / independent_.paths()), &found.position);
            },
            rays, watched);
    }
    const std::uint32_t batch = group / numbers_.length, step = group % numbers_.length;
    if (batch >= batches()) return own;

    std::vector<Rgb> unused(std::size_t{pixels_} * Q, Rgb(0.0));
    Tally tally(Q);
    const auto sums = sample_brightness(replicate, unused, tally, {});
    const Starts starts =
        find_starts(replicate, *sums, batch * chains_at_once, batch * chains_at_once + chains_of_batch(batch), rays);
    for (std::size_t q = 1; q <= N; ++q) {
        const double brightness = sums->total(q) / independent_.paths();
        if (!(brightness > 0.0)) continue;
        // A state counts until the chain leaves it.
        std::vector<LeftState> of_step;
        const auto left = [&](const LeftState& state) {
            if (state.step == step) of_step.push_back(state);
        };
        ChainBatch chains(*scene_, of_chains_, independent_.area(), static_cast<int>(q));
        const auto random = random_of(static_cast<int>(q), batch);
        if (step == 0)
            chains.start(independent_, replicate, starts[q], random, rays, watched);
        else
            chains.start(independent_, replicate, starts[q], random, rays);
        for (std::uint32_t t = 1; t < numbers_.length; ++t) {
            if (t == step)
                chains.step(t, left, rays, watched);
            else
                chains.step(t, left, rays);
        }
        ChainStatistics statistics;
        chains.end(left, statistics);
        const double each = brightness / static_cast<double>(numbers_.states()) * size;
        for (const LeftState& state : of_step)
            if (observer.watches(state.chain)) observer.found(state.chain, q, state.value * each, &state.position);
    }
    return own;
}

namespace {

class IndependentOnes : public PathsToInspect {
public:
    IndependentOnes(const IndependentPaths& paths, std::size_t quantities) : paths_(paths), quantities_(quantities) {}
    std::uint32_t groups() const override { return paths_.groups(); }
    Group group(std::uint32_t number) const override { return {number * chains_at_once, paths_.paths_of_group(number)}; }
    void retrace(std::uint64_t replicate, const Group& group, PathObserver& observer) const override {
        IndependentPaths::Workspace work;
        std::vector<std::uint64_t> rays(quantities_);
        (void)paths_.trace_group(
            replicate, group.first / chains_at_once, work, [](auto...) {}, rays, WatchedPaths(observer));
    }

private:
    const IndependentPaths& paths_;
    std::size_t quantities_;
};

}  // namespace

std::unique_ptr<const PathsToInspect> MetropolisSampler::to_inspect() const {
    return std::make_unique<const IndependentOnes>(independent_, settings_.quantities());
}

std::vector<Rgb> CacheSampler::retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const {
    std::vector<std::uint64_t> rays(settings_.pictures());
    std::uint64_t given_up = 0;
    const auto pass = tracer_->trace(replicate, rays, given_up);
    Workspace work(settings_.quantities());
    trace_group(replicate, layout_.group_with(first), *pass, work, WatchedPaths(observer));
    return std::move(work.group.samples);
}

namespace {

// Reports the ray of a record. The light that it finds is a part of the light that was found where the record was read.
class RecordRay : public PathObserver {
public:
    explicit RecordRay(PathObserver& observer) : observer_(observer) {}
    void step(std::uint32_t path, const PathStep& step) override {
        PathStep ray = step;
        if (ray.kind == PathStep::Kind::first) ray.kind = PathStep::Kind::record;
        observer_.step(path, ray);
    }

private:
    PathObserver& observer_;
};

}  // namespace

void CacheSampler::retrace_read(std::uint64_t replicate, std::uint32_t ray, PathObserver& observer) const {
    RecordRay of_record(observer);
    tracer_->trace_ray(replicate, ray, WatchedPaths(of_record));
}

}  // namespace neumann
