#include "operators/paths/metropolis/chain_walk.h"

#include "core/base/error.h"
#include "operators/paths/metropolis/chain_batch.h"
#include "operators/paths/metropolis/starts_of_group.h"

#include <fmt/format.h>

#include <oneapi/tbb/parallel_for.h>

namespace neumann {

std::vector<ChainState> chain_walk(const Scene& scene, int bounce, std::uint32_t states, std::uint64_t seed, const Watch& watch) {
    constexpr std::uint32_t paths = 65536;
    const WalkSettings walk{.bounces = bounce, .rest_probability = 0.0};
    const IndependentPaths independent(scene, walk, SamplerKind::sobol, seed, paths);
    const auto k = static_cast<std::size_t>(bounce);
    BrightnessSums sums(independent.groups(), k + 1);
    oneapi::tbb::parallel_for(std::uint32_t{0}, independent.groups(), [&](std::uint32_t group) {
        if (watch.stop()) return;
        IndependentPaths::Workspace work;
        std::vector<std::uint64_t> rays(k + 2);
        (void)independent.trace_group(
            0, group, work,
            [&](std::uint32_t, const WayFound& found) {
                if (found.bounce == bounce && std::isfinite(size_of(found.value))) sums.of_group(group)[k] += size_of(found.value);
            },
            std::span(rays));
    });
    if (watch.stop()) throw Stopped();
    Sampler random(seed, 0);
    random.start(0);
    std::vector<double> u(k + 1);
    for (double& x : u) x = random.next();
    const std::vector<WantedStart> wanted = choose_starts(sums, 1, u);
    if (wanted.empty()) throw InputError(fmt::format("none of {} paths from both ends brings light in bounce {}", paths, bounce));

    ChainStart start;
    IndependentPaths::Workspace work;
    std::vector<std::uint64_t> rays(k + 2);
    find_starts_of_group(independent, 0, wanted, work, std::span(rays),
                         [&](const WantedStart&, const ChainStart& found) { start = found; });

    const Bidirectional bidirectional(scene, walk, independent.area().pixels());
    ChainBatch chain(scene, bidirectional, independent.area(), bounce);
    chain.start(independent, 0, std::span(&start, 1), {Sampler(seed, 1)}, std::span(rays));
    std::vector<ChainState> all;
    const auto note = [&] { all.push_back({chain.position(0), chain.way(0), chain.size(0), chain.is_new(0), chain.by_large(0)}); };
    note();
    all.back().by_large = true;
    for (std::uint32_t t = 1; t < states; ++t) {
        if (t % 1024 == 0 && watch.stop()) throw Stopped();
        chain.step(
            t, [](const LeftState&) {}, std::span(rays));
        note();
    }
    return all;
}

}  // namespace neumann
