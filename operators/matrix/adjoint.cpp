#include "operators/matrix/adjoint.h"

#include <numeric>

namespace neumann {

Seers::Seers(const RayTable& table) : first_(table.space().size() + 2), rays_(table.seen().size()) {
    for (const std::uint32_t u : table.seen()) ++first_[u + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::uint64_t> next(first_);
    for (std::size_t ray = 0; ray < rays_.size(); ++ray) rays_[next[table.seen()[ray]]++] = ray;
}

}  // namespace neumann
