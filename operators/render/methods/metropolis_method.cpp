#include "core/base/error.h"
#include "operators/render/from_paths/metropolis_sampler.h"
#include "operators/render/methods/method.h"
#include "operators/render/methods/option_makers.h"
#include "operators/render/methods/sampling.h"

#include <fmt/format.h>

#include <algorithm>

namespace neumann::method {

void Metropolis::expect(const Scene& scene) const { expect_visible_emitters(name, scene); }

std::vector<MethodOption> Metropolis::own_options() {
    return {whole<std::uint32_t>(
        "chain", "N", "For metropolis: the states of each chain in a replicate (default 512, fewer in small pictures)", 1, 1u << 20,
        [](const Metropolis& m) { return m.chain; }, [](Metropolis& m, std::uint32_t n) { m.chain = n; })};
}

// Refuses chains that are longer than a replicate has room for.
void Metropolis::expect_room(const Film& film, std::uint32_t replicate_size) const {
    const std::uint64_t states =
        std::uint64_t{replicate_size} * static_cast<std::uint64_t>(film.crop_width) * static_cast<std::uint64_t>(film.crop_height);
    if (chain && *chain > 1 && *chain > states / chains_at_once)
        throw OptionError(
            "chain", fmt::format("{}: a replicate of {} samples for each of {}×{} pixels has {} states of a bounce, and its {} "
                                 "chains may be of {} at most",
                                 *chain, replicate_size, film.crop_width, film.crop_height, states, chains_at_once,
                                 std::max<std::uint64_t>(states / chains_at_once, 1)));
}

std::shared_ptr<const PathMethod> Metropolis::prepare(const Preparing&) const {
    return std::make_shared<const MetropolisPaths>(chain.value_or(MetropolisPaths::default_length));
}

void Metropolis::complete(const SamplingSettings& settings, const Film& film) {
    chain = chain_numbers(settings.layout(film).paths(), as<MetropolisPaths>(settings.method)->length()).length;
}

}  // namespace neumann::method
