#include "operators/matrix/power_balance.h"

#include <algorithm>
#include <map>

namespace neumann {

template <int C>
PowerBalance<C>::PowerBalance(const RayTable& table, const ReflectionMatrix<C>& R) {
    const PatchSpace& space = table.space();
    const auto size = static_cast<Eigen::Index>(space.size()) + 1;
    emitted_ = left_ = caught_ = ExitantVector<1>::Values::Zero(1, size);
    absorbed_ = ExitantVector<C>::Values::Zero(C, size);
    // Row sums of a block: directional albedos for ρ = 1.
    std::map<const ReflectionBlock::Matrix*, Eigen::VectorXd> sums;
    const auto row_sums = [&](const ReflectionBlock::Matrix* block) -> const Eigen::VectorXd& {
        auto [place, is_new] = sums.try_emplace(block);
        if (is_new) place->second = *block * Eigen::VectorXd::Ones(block->cols());
        return place->second;
    };
    for (std::uint32_t f = 0; f < space.facets().size(); ++f) {
        const Facet& facet = space.facets()[f];
        typename ExitantVector<C>::Values albedo(C, facet.cells.size());
        albedo.colwise() = R.reflectance().col(f);
        for (int c = 0; c < std::min(C, 3); ++c)
            if (const auto* block = R.block(f, c))
                albedo.row(c) *= row_sums(block).segment(facet.first - R.first_of_block(f), facet.cells.size()).transpose().array();
        for (std::uint32_t u = facet.first; u < facet.first + facet.cells.size(); ++u) emitted_(0, u) = space.measure(facet);
        const double each = table.measure(f);
        for (std::size_t ray = table.first_ray(f); ray < table.first_ray(f + 1); ++ray) {
            const std::uint32_t seen = table.seen()[ray], at = table.arrives_in(f, ray);
            if (seen == space.nothing()) {
                left_(0, at) += each;
            } else {
                caught_(0, seen) += each;
                absorbed_.col(seen) += (1.0 - albedo.col(at - facet.first)) * each;
            }
        }
    }
}

template <int C>
PowerOfTerm PowerBalance<C>::of(const ExitantVector<C>& term) const {
    constexpr int channels = C == 1 ? 1 : 3;
    PowerOfTerm power;
    for (int c = 0; c < channels; ++c) {
        power.emitted += (emitted_.row(0) * term.row(c)).sum() / channels;
        power.left += (left_.row(0) * term.row(c)).sum() / channels;
        power.caught += (caught_.row(0) * term.row(c)).sum() / channels;
        power.absorbed += (absorbed_.row(c) * term.row(c)).sum() / channels;
    }
    return power;
}

template class PowerBalance<1>;
template class PowerBalance<4>;

}  // namespace neumann
