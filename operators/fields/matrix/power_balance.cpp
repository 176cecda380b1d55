#include "operators/fields/matrix/power_balance.h"

#include <algorithm>
#include <map>

namespace neumann {

namespace {

// The mean of the channels.
template <int C>
double mean_of(const Channels<C>& x) {
    return mean_component(to_rgb<C>(x));
}

}  // namespace

template <int C>
PowerBalance<C>::PowerBalance(const RayTable& table, const ReflectionMatrix<C>& R, const Chains& chains)
    : space_(&table.space()),
      chains_(&chains),
      begin_(space_->first_unknown(table.begin())),
      end_(space_->first_unknown(table.end())) {
    const PatchSpace& space = *space_;
    const auto size = static_cast<Eigen::Index>(space.size()) + 1;
    emitted_ = left_ = caught_ = ExitantVector<1>::Values::Zero(1, size);
    absorbed_ = kept_ = ExitantVector<C>::Values::Zero(C, size);
    // The row sums of a block are the directional albedos for ρ = 1.
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
        kept_.middleCols(facet.first, facet.cells.size()) = 1.0 - albedo;
        if (f < table.begin() || f >= table.end()) continue;
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
    // The power that goes on by a chain has not left the scene.
    for (const Chain& chain : chains.all()) left_(0, chain.from) -= emitted_(0, chain.from) * double{chain.share};
}

template <int C>
void PowerBalance<C>::add(std::size_t k, const ExitantVector<C>& term, std::vector<PowerOfTerm>& power) const {
    constexpr int channels = C == 1 ? 1 : 3;
    PowerOfTerm& own = power[k];
    for (int c = 0; c < channels; ++c) {
        own.emitted += (emitted_.row(0) * term.row(c)).sum() / channels;
        own.left += (left_.row(0) * term.row(c)).sum() / channels;
        own.caught += (caught_.row(0) * term.row(c)).sum() / channels;
        own.absorbed += (absorbed_.row(c) * term.row(c)).sum() / channels;
    }
    for (const Chain& chain : chains_->all()) {
        const Channels<C> begun = term.col(chain.from) * (emitted_(0, chain.from) * double{chain.share});
        if (!(begun > 0.0).any()) continue;
        Channels<C> now = begun;
        std::size_t bounce = k;
        for (const auto& weight : chains_->weights(chain)) {
            const Channels<C> next = begun * to_channels<C>(Rgb(weight[0], weight[1], weight[2]));
            power[bounce].caught += mean_of<C>(now);
            power[bounce].absorbed += mean_of<C>(now) - mean_of<C>(next);
            if (++bounce == power.size()) break;
            power[bounce].emitted += mean_of<C>(next);
            now = next;
        }
        if (bounce == power.size()) continue;
        if (chain.to == space_->nothing()) {
            power[bounce].left += mean_of<C>(now);
        } else {
            power[bounce].caught += mean_of<C>(now);
            power[bounce].absorbed += mean_of<C>(now * kept_.col(chain.to));
        }
    }
}

template <int C>
PowerOfTerm PowerBalance<C>::arriving(const IncidentVector<C>& means) const {
    PowerOfTerm power;
    for (std::uint32_t u = begin_; u < end_; ++u) {
        const Channels<C> of_cell = means.col(u) * emitted_(0, u);
        power.caught += mean_of<C>(of_cell);
        power.absorbed += mean_of<C>(of_cell * kept_.col(u));
    }
    return power;
}

template class PowerBalance<1>;
template class PowerBalance<4>;

}  // namespace neumann
