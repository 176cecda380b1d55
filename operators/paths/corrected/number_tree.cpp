#include "operators/paths/corrected/number_tree.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

constexpr std::size_t quarters = 4;
// A box is halved if what was found there is unevenly spread in some dimension: a χ² of three degrees of freedom that chance
// exceeds once in a thousand times.
constexpr double chance = 16.3;

}  // namespace

NumberTree::NumberTree(std::vector<Found> found) : nodes_(1) {
    Numbers lower, upper;
    lower.fill(0.0);
    upper.fill(1.0);
    halve(0, found.begin(), found.end(), lower, upper);
}

double NumberTree::halve(std::uint32_t node, std::vector<Found>::iterator begin, std::vector<Found>::iterator end, Numbers lower,
                         Numbers upper) {
    double all = 0.0, squares = 0.0, square = 0.0, volume = 1.0;
    for (auto f = begin; f != end; ++f) {
        all += f->amount;
        squares += f->amount * f->amount;
        square += f->amount * f->value;
    }
    if (!(all > 0.0)) return 0.0;
    for (std::size_t d = 0; d < dimensions; ++d) volume *= upper[d] - lower[d];
    const double count = all * all / squares;  // of as many equal amounts that would be as uncertain

    // Quarters, because halves would hide what lies in the middle.
    std::size_t dimension = 0;
    double most = chance;
    for (std::size_t d = 0; d < dimensions; ++d) {
        std::array<double, quarters> in{};
        for (auto f = begin; f != end; ++f)
            in[std::min(static_cast<std::size_t>(quarters * (f->at[d] - lower[d]) / (upper[d] - lower[d])), quarters - 1)] +=
                f->amount / all;
        double uneven = 0.0;
        for (const double part : in) uneven += count * quarters * (part - 1.0 / quarters) * (part - 1.0 / quarters);
        if (uneven <= most) continue;
        most = uneven;
        dimension = d;
    }
    if (!(most > chance)) return std::sqrt(volume * square);

    const double middle = 0.5 * (lower[dimension] + upper[dimension]);
    const auto upper_half = std::partition(begin, end, [&](const Found& f) { return f.at[dimension] < middle; });
    const auto halves = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    Numbers to = upper, from = lower;
    to[dimension] = from[dimension] = middle;
    const double below = halve(halves, begin, upper_half, lower, to), above = halve(halves + 1, upper_half, end, from, upper);
    // Laplace's rule: as if each half had one amount more. Where nothing was found there may be something.
    nodes_[node] = {halves, static_cast<std::uint32_t>(dimension), (count * below / (below + above) + 1.0) / (count + 2.0)};
    return below + above;
}

NumberTree::Numbers NumberTree::draw(Numbers uniform) const {
    Numbers lower, size;
    lower.fill(0.0);
    size.fill(1.0);
    for (std::uint32_t i = 0; nodes_[i].halves > 0;) {
        const Node& node = nodes_[i];
        double &u = uniform[node.dimension], &part = size[node.dimension];
        const bool is_lower = u < node.in_lower;
        part *= 0.5;
        if (!is_lower) lower[node.dimension] += part;
        u = is_lower ? u / node.in_lower : (u - node.in_lower) / (1.0 - node.in_lower);
        u = std::clamp(u, 0.0, 0x1.fffffffffffffp-1);
        i = node.halves + (is_lower ? 0 : 1);
    }
    for (std::size_t d = 0; d < dimensions; ++d) uniform[d] = lower[d] + size[d] * uniform[d];
    return uniform;
}

double NumberTree::density(const Numbers& at) const {
    Numbers lower, size;
    lower.fill(0.0);
    size.fill(1.0);
    double density = 1.0;
    for (std::uint32_t i = 0; nodes_[i].halves > 0;) {
        const Node& node = nodes_[i];
        double &from = lower[node.dimension], &part = size[node.dimension];
        part *= 0.5;
        const bool is_lower = at[node.dimension] < from + part;
        if (!is_lower) from += part;
        density *= 2.0 * (is_lower ? node.in_lower : 1.0 - node.in_lower);
        i = node.halves + (is_lower ? 0 : 1);
    }
    return density;
}

}  // namespace neumann
