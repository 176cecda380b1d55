#include "operators/render/from_paths/metropolis_sampler.h"

#include "operators/in_order.h"
#include "operators/paths/metropolis/starts_of_group.h"
#include "operators/render/from_paths/film_shares.h"
#include "operators/render/from_paths/metropolis_group.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace neumann {

namespace {

// A replicate has one independent path for this many states of a bounce's chains.
constexpr std::uint64_t states_for_a_path = 2;
constexpr std::uint32_t groups_at_once = 8;
// The streams of random numbers of the starts and of the chains.
constexpr std::uint64_t start_stream = 0x5354415254535f4dULL, chain_stream = 0x434841494e535f4dULL;

std::uint32_t independent_paths(std::uint64_t states, std::uint32_t pixels) {
    return static_cast<std::uint32_t>(std::max<std::uint64_t>(states / states_for_a_path, std::min<std::uint64_t>(pixels, states)));
}

WalkSettings without_rest(WalkSettings walk) {
    walk.rest_probability = 0.0;
    return walk;
}

}  // namespace

ChainNumbers chain_numbers(std::uint64_t states, std::uint32_t length) {
    if (states < chains_at_once) return {static_cast<std::uint32_t>(states), 1};
    length = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(length, 1, states / chains_at_once));
    return {static_cast<std::uint32_t>(states / length / chains_at_once * chains_at_once), length};
}

// The contributions of one batch of chains, or of some independent paths.
struct MetropolisSampler::Piece {
    std::vector<PixelShare> shares;
    ChainStatistics statistics;
};

std::shared_ptr<const PathSampler> MetropolisPaths::sampler(const Scene& scene, const SamplingSettings& settings) const {
    return std::make_shared<const MetropolisSampler>(scene, settings, length_);
}

MetropolisSampler::MetropolisSampler(const Scene& scene, const SamplingSettings& settings, std::uint32_t length)
    : PathSampler(scene, settings),
      pixels_(static_cast<std::uint32_t>(scene.film.crop_width) * static_cast<std::uint32_t>(scene.film.crop_height)),
      numbers_(chain_numbers(std::uint64_t{pixels_} * settings.replicate_size, length)),
      independent_(scene, settings.walk, settings.sampler, settings.seed,
                   independent_paths(std::uint64_t{pixels_} * settings.replicate_size, pixels_)),
      of_chains_(scene, without_rest(settings.walk), independent_.area().pixels()) {}

SampleName MetropolisSampler::name(std::uint64_t replicate, std::uint32_t number) const { return layout_.name(replicate, number); }

void MetropolisSampler::sample_emission(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges,
                                        Tally& tally) const {
    const std::size_t Q = settings_.quantities();
    const std::uint32_t size = settings_.replicate_size, pixels_at_once = std::max(paths_at_once / size, 1u);
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces([&] { return Workspace(Q); });
    // Each task takes whole pixels, so that a pixel is added up by one thread and in order.
    oneapi::tbb::parallel_for(std::uint32_t{0}, (pixels_ + pixels_at_once - 1) / pixels_at_once, [&](std::uint32_t group) {
        Workspace& work = workspaces.local();
        const std::uint32_t begin = group * pixels_at_once * size, end = std::min((group + 1) * pixels_at_once, pixels_) * size;
        for (std::uint32_t first = begin; first < end; first += paths_at_once) {
            const std::uint32_t n = std::min(paths_at_once, end - first);
            trace_camera_rays(replicate, first, n, work.camera);
            work.tally.rays[0] += n;
            for (std::uint32_t i = 0; i < n; ++i) {
                Rgb x = work.camera.emitted[i];
                const std::uint32_t pixel = (first + i) / size;
                if (!is_finite(x)) [[unlikely]] {
                    work.tally.keep({0, {pixel, name(replicate, first + i)}});
                    x = Rgb(0.0);
                }
                if (settings_.colors) x = *settings_.colors * x;
                picture[pixel * Q] += x / static_cast<double>(size);
                ranges.of[pixel * Q].add(x);
            }
        }
    });
    for (const Workspace& work : workspaces) tally.merge(work.tally);
}

std::optional<BrightnessSums> MetropolisSampler::sample_brightness(std::uint64_t replicate, std::vector<Rgb>& splatted,
                                                                   Tally& tally, const Watch& watch) const {
    const std::size_t Q = settings_.quantities(), N = Q - 2;
    BrightnessSums sums(independent_.groups(), N + 1);
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces([&] {
        Workspace work(Q);
        work.tally = without_smaller_samples(tally);
        return work;
    });
    const double each = 1.0 / independent_.paths();
    const bool done = add_in_order<Piece>(
        (independent_.groups() + groups_at_once - 1) / groups_at_once,
        [&](std::size_t k, Piece& piece) {
            Workspace& work = workspaces.local();
            piece.shares.clear();
            const auto begin = static_cast<std::uint32_t>(k) * groups_at_once;
            for (std::uint32_t group = begin; group < std::min(begin + groups_at_once, independent_.groups()); ++group) {
                const auto sum = sums.of_group(group);
                work.tally.given_up += independent_.trace_group(
                    replicate, group, work.independent,
                    [&](std::uint32_t i, const WayFound& found) {
                        const SampleName of_path = name(replicate, group * chains_at_once + i);
                        const double size = size_of(found.value);
                        const auto bounce = static_cast<std::size_t>(found.bounce);
                        if (bounce > N)
                            spread(scene_->film, found.position, N + 1, found.value * each, of_path, piece.shares, work.tally);
                        else if (!std::isfinite(size))
                            work.tally.keep({found.bounce, {pixel_at(scene_->film, found.position), of_path}});
                        else
                            sum[bounce] += size;
                    },
                    std::span(work.tally.rays));
            }
        },
        [&](std::size_t, const Piece& piece) {
            for (const PixelShare& s : piece.shares) splatted[s.pixel * Q + s.quantity] += s.value;
            return !watch.stop();
        });
    if (!done) return std::nullopt;
    for (const Workspace& work : workspaces) tally.merge(work.tally);
    tally.largest[N + 1].add_count(independent_.paths());
    return sums;
}

MetropolisSampler::Starts MetropolisSampler::find_starts(std::uint64_t replicate, const BrightnessSums& sums,
                                                         std::uint32_t first_chain, std::uint32_t end_chain,
                                                         std::vector<std::uint64_t>& rays) const {
    Sampler random(settings_.seed ^ start_stream, 0);
    random.start(replicate);
    std::vector<double> u(sums.bounces());
    for (double& x : u) x = random.next();
    std::vector<WantedStart> wanted = choose_starts(sums, numbers_.chains, u);
    std::erase_if(wanted, [&](const WantedStart& w) { return w.chain < first_chain || w.chain >= end_chain; });
    std::vector<std::size_t> begins;  // where the entries of each group begin
    for (std::size_t k = 0; k < wanted.size(); ++k)
        if (k == 0 || wanted[k].group != wanted[k - 1].group) begins.push_back(k);

    Starts starts(sums.bounces(), std::vector<ChainStart>(end_chain - first_chain));
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces([&] { return Workspace(settings_.quantities()); });
    oneapi::tbb::parallel_for(std::size_t{0}, begins.size(), [&](std::size_t part) {
        const std::size_t end = part + 1 < begins.size() ? begins[part + 1] : wanted.size();
        const auto of_group = std::span(wanted).subspan(begins[part], end - begins[part]);
        Workspace& work = workspaces.local();
        find_starts_of_group(independent_, replicate, of_group, work.independent, std::span(work.tally.rays),
                             [&](const WantedStart& w, const ChainStart& start) {
                                 starts[static_cast<std::size_t>(w.bounce)][w.chain - first_chain] = start;
                             });
    });
    for (const Workspace& work : workspaces)
        for (std::size_t q = 0; q < rays.size(); ++q) rays[q] += work.tally.rays[q];
    return starts;
}

std::vector<Sampler> MetropolisSampler::random_of(int bounce, std::uint32_t batch) const {
    std::vector<Sampler> random;
    for (std::uint32_t i = 0; i < chains_of_batch(batch); ++i)
        random.emplace_back(settings_.seed ^ chain_stream,
                            static_cast<std::uint32_t>(bounce) * numbers_.chains + batch * chains_at_once + i);
    return random;
}

bool MetropolisSampler::sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                                       const Watch& watch) const {
    const std::size_t Q = settings_.quantities(), N = Q - 2;
    sample_emission(replicate, picture, ranges, tally);
    std::vector<Rgb> splatted(picture.size(), Rgb(0.0));
    const auto sums = sample_brightness(replicate, splatted, tally, watch);
    if (!sums) return false;
    const Starts starts = find_starts(replicate, *sums, 0, numbers_.chains, tally.rays);

    std::vector<int> lit;
    for (std::size_t bounce = 1; bounce <= N; ++bounce)
        if (sums->total(bounce) > 0.0) lit.push_back(static_cast<int>(bounce));
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces([&] {
        Workspace work(Q);
        work.tally = without_smaller_samples(tally);
        return work;
    });
    tally.chains.resize(Q - 1);
    const std::size_t pieces = lit.size() * batches();
    const bool done = add_in_order<Piece>(
        pieces,
        [&](std::size_t k, Piece& piece) {
            Workspace& work = workspaces.local();
            const int bounce = lit[k / batches()];
            const auto q = static_cast<std::size_t>(bounce);
            const auto batch = static_cast<std::uint32_t>(k % batches());
            piece.shares.clear();
            piece.statistics = {};
            const double each = sums->total(q) / (independent_.paths() * static_cast<double>(numbers_.states()));
            const auto left = [&](const LeftState& state) {
                const auto number = (batch * numbers_.length + state.step) * chains_at_once + state.chain;
                spread(scene_->film, state.position, q, state.value * each, name(replicate, number), piece.shares, work.tally);
            };
            std::vector<std::uint64_t> rays(Q);
            ChainBatch chains(*scene_, of_chains_, independent_.area(), bounce);
            const auto count_non_finite = [&](std::uint32_t step) {
                for (const std::uint32_t i : chains.non_finite())
                    work.tally.keep({bounce, {0, name(replicate, (batch * numbers_.length + step) * chains_at_once + i)}});
            };
            chains.start(independent_, replicate, std::span(starts[q]).subspan(batch * chains_at_once, chains_of_batch(batch)),
                         random_of(bounce, batch), rays);
            for (std::uint32_t step = 1; step < numbers_.length; ++step) {
                chains.step(step, left, rays);
                count_non_finite(step);
            }
            chains.end(left, piece.statistics);
            for (const std::uint64_t n : rays) work.tally.rays[q] += n;
        },
        [&](std::size_t k, const Piece& piece) {
            for (const PixelShare& s : piece.shares) splatted[s.pixel * Q + s.quantity] += s.value;
            tally.chains[static_cast<std::size_t>(lit[k / batches()])].merge(piece.statistics);
            watch.progress({.fraction = static_cast<double>(k + 1) / static_cast<double>(pieces)});
            return !watch.stop();
        });
    if (!done) return false;
    for (const Workspace& work : workspaces) tally.merge(work.tally);
    for (const int bounce : lit) tally.largest[static_cast<std::size_t>(bounce)].add_count(numbers_.states());
    for (std::size_t i = 0; i < picture.size(); ++i) {
        if (settings_.colors) splatted[i] = *settings_.colors * splatted[i];
        picture[i] += splatted[i];
        if (i % Q != 0) ranges.of[i].add(picture[i]);
    }
    return true;
}

}  // namespace neumann
