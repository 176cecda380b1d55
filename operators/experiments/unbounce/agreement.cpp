#include "operators/experiments/unbounce/agreement.h"

#include "core/base/error.h"
#include "operators/statistics/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

void add_regions(const Unbounced& backward, const Estimate& forward, std::size_t n, TermAgreement& result) {
    const RegionMeans means = region_means(forward, backward.regions, backward.lights());
    const Eigen::VectorXd sizes = backward.regions.sizes(backward.lights());
    double apart = 0.0, noise = 0.0, all = 0.0;
    for (int c = 0; c < 3; ++c) {
        const UnbouncedChannel& channel = backward.channels[static_cast<std::size_t>(c)];
        const bool knows_forward = means.variance[c].size() > 0;
        for (std::size_t i = 0; i < channel.lights.size(); ++i) {
            const Eigen::Index r = channel.lights[i], row = static_cast<Eigen::Index>(i), term = static_cast<Eigen::Index>(n);
            const double f = means.mean[c](r, 0), b = channel.terms.value(row, term), error = channel.terms.error(row, term);
            apart += sizes[r] * (b - f) * (b - f);
            noise += sizes[r] * (error * error + (knows_forward ? means.variance[c](r, 0) : 0.0));
            all += sizes[r] * f * f;
        }
    }
    if (all == 0.0) return;
    result.relative_difference = std::sqrt(apart / all);
    result.by_noise = std::sqrt(noise / all);
}

}  // namespace

double TermAgreement::deviations() const {
    const double error = std::hypot(difference.standard_error, discretisation);
    return error > 0.0 ? difference.mean / error : difference.mean == 0.0 ? 0.0 : std::copysign(INFINITY, difference.mean);
}

std::vector<TermAgreement> agreement(const Unbounced& backward, const std::vector<Estimate>& forward,
                                     const std::vector<MeanWithError>& by_way_of_unseen) {
    std::vector<TermAgreement> result;
    const std::size_t count = std::min(forward.size(), backward.terms.size());
    for (std::size_t n = 0; n < count; ++n) {
        const Image& picture = forward[n].mean;
        if (picture.width != backward.regions.width || picture.height != backward.regions.height)
            throw InputError(fmt::format("the forward picture of bounce {} is {}×{} pixels, expected {}×{} as of the lights", n + 1,
                                         picture.width, picture.height, backward.regions.width, backward.regions.height));
        TermAgreement term;
        Estimate known = forward[n];
        if (known.standard_error.pixels.empty()) known.standard_error = Image(picture.width, picture.height);
        term.forward = picture_mean(known);
        if (term.forward.standard_error == 0.0) term.forward.degrees_of_freedom = exact_degrees_of_freedom;
        term.difference = difference(backward.means[n].all, term.forward);
        if (!backward.discretisation.empty()) term.discretisation = backward.discretisation[n];
        if (n < by_way_of_unseen.size()) term.by_way_of_unseen = by_way_of_unseen[n];
        add_regions(backward, forward[n], n, term);
        result.push_back(term);
    }
    return result;
}

}  // namespace neumann
