// The walk of a chain as arrays.
#include "apps/commands/interrupt.h"
#include "apps/python/module.h"
#include "core/base/error.h"
#include "operators/metropolis/chain_walk.h"

#include <fmt/format.h>

namespace neumann {

namespace {

py::dict as_dict(const std::vector<ChainState>& states) {
    const auto n = static_cast<py::ssize_t>(states.size());
    py::array_t<double> position({n, py::ssize_t{2}}), size(n);
    py::array_t<int> s(n);
    py::array_t<bool> accepted(n), large(n);
    for (py::ssize_t i = 0; i < n; ++i) {
        const ChainState& state = states[static_cast<std::size_t>(i)];
        position.mutable_at(i, 0) = state.position.x;
        position.mutable_at(i, 1) = state.position.y;
        size.mutable_at(i) = state.size;
        s.mutable_at(i) = state.s;
        accepted.mutable_at(i) = state.is_new;
        large.mutable_at(i) = state.by_large;
    }
    py::dict d;
    d["position"] = position;
    d["size"] = size;
    d["s"] = s;
    d["accepted"] = accepted;
    d["large"] = large;
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
