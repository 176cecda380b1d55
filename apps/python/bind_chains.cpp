// The walk of a chain as arrays.
#include "apps/python/arrays.h"
#include "apps/python/module.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "operators/paths/metropolis/chain_walk.h"

#include <fmt/format.h>

namespace neumann {

namespace {

py::dict as_dict(const std::vector<ChainState>& states) {
    py::dict d;
    d["position"] = rows(states, 2, [](const ChainState& state) { return state.position; });
    d["size"] = column<double>(states, [](const ChainState& state) { return state.size; });
    d["s"] = column<int>(states, [](const ChainState& state) { return state.s; });
    d["accepted"] = column<bool>(states, [](const ChainState& state) { return state.is_new; });
    d["large"] = column<bool>(states, [](const ChainState& state) { return state.by_large; });
    return d;
}

std::unique_ptr<Job> start_chain(const std::shared_ptr<LoadedScene>& loaded, int bounce, std::int64_t states, std::uint64_t seed) {
    constexpr std::int64_t most = std::int64_t{1} << 24;
    if (bounce < 1) throw InputError(fmt::format("bounce {}: expected at least 1", bounce));
    if (states < 1 || states > most) throw InputError(fmt::format("states {}: expected 1 to {}", states, most));
    return std::make_unique<Job>(0, [=](Job& job) -> Job::Finish {
        job.tell("walking");
        const auto walked = std::make_shared<const std::vector<ChainState>>(
            chain_walk(*loaded->scene, bounce, static_cast<std::uint32_t>(states), seed, {.stop = interrupted}));
        return [walked] { return as_dict(*walked); };
    });
}

}  // namespace

void bind_chains(py::module_& m) {
    m.def("chain", &start_chain, py::arg("scene"), py::arg("bounce"), py::arg("states"), py::arg("seed"));
}

}  // namespace neumann
