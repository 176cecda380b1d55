#include "operators/experiments/unbounce/unbounce.h"

#include "core/base/error.h"
#include "operators/experiments/unbounce/pixel_terms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A picture without errors counts as exact.
ChannelPictures channel_pictures(const RegionMeans& pictures, const RegionMeans* direct, const RegionMeans* picture, int c) {
    ChannelPictures channel{pictures.mean[c], pictures.variance[c], {}, {}, {}, {}};
    if (direct != nullptr) {
        channel.direct = direct->mean[c];
        channel.direct_variance = direct->variance[c];
    }
    if (picture != nullptr) {
        channel.picture = picture->mean[c];
        channel.picture_variance = picture->variance[c];
    }
    return channel;
}

// The parts, with means over regions that may have lost pixels that are black under all lights.
std::vector<ChannelPictures::Part> parts_of(const RegionParts& all, const VectorXd& sizes, std::size_t c) {
    const VectorXd scale = all.regions.sizes(static_cast<std::size_t>(sizes.size())).cwiseQuotient(sizes.cwiseMax(1.0));
    std::vector<ChannelPictures::Part> parts;
    for (const RegionParts::Part& part : all.parts)
        parts.push_back({scale.asDiagonal() * part.T[c], scale.cwiseProduct(part.direct[c])});
    return parts;
}

// Values for merged lights: sums over lights, and means over their regions.
MatrixXd merged(const MatrixXd& T, const std::vector<int>& groups, const VectorXd& shares, bool sum_lights) {
    const int count = *std::max_element(groups.begin(), groups.end()) + 1;
    MatrixXd result = MatrixXd::Zero(count, sum_lights ? count : T.cols());
    VectorXd covered = VectorXd::Zero(count);
    for (std::size_t r = 0; r < groups.size(); ++r) {
        const auto row = static_cast<Eigen::Index>(r);
        covered[groups[r]] += shares[row];
        for (Eigen::Index j = 0; j < T.cols(); ++j)
            result(groups[r], sum_lights ? groups[static_cast<std::size_t>(j)] : j) += shares[row] * T(row, j);
    }
    for (int r = 0; r < count; ++r) result.row(r) /= std::max(covered[r], std::numeric_limits<double>::min());
    return result;
}

// The terms of merged regions, with a row for each of the original regions.
MatrixXd coarse_terms(const ChannelPictures& fine, const std::vector<int>& groups, const VectorXd& shares, int bounces,
                      double alpha) {
    ChannelPictures coarse{merged(fine.T, groups, shares, true), {}, {}, {}, {}, {}};
    if (fine.direct.size() > 0) coarse.direct = merged(fine.direct, groups, shares, true);
    if (fine.picture.size() > 0) coarse.picture = merged(fine.picture, groups, shares, false);
    const VectorXd covered = merged(VectorXd::Ones(shares.size()), groups, shares, false);
    VectorXd sums = VectorXd::Zero(covered.size());
    for (std::size_t r = 0; r < groups.size(); ++r) sums[groups[r]] += shares[static_cast<Eigen::Index>(r)];
    const UnbouncedChannel found = unbounce_channel(coarse, sums, bounces, alpha, 0);
    MatrixXd result = MatrixXd::Zero(covered.size(), bounces);
    for (std::size_t i = 0; i < found.lights.size(); ++i)
        result.row(found.lights[i]) = found.terms.value.row(static_cast<Eigen::Index>(i));
    return result(groups, Eigen::all);
}

// Values of all regions; those that are not in the matrices get 0.
MatrixXd of_all(const MatrixXd& values, const std::vector<int>& lights, Eigen::Index size) {
    MatrixXd result = MatrixXd::Zero(size, values.cols());
    for (std::size_t i = 0; i < lights.size(); ++i) result.row(lights[i]) = values.row(static_cast<Eigen::Index>(i));
    return result;
}

void add_discretisation(Unbounced& result, int c, const ChannelPictures& pictures, const VectorXd& shares,
                        const UnbounceSettings& settings, MatrixXd& differences) {
    const UnbouncedChannel& channel = result.channels[static_cast<std::size_t>(c)];
    const MatrixXd coarse = coarse_terms(pictures, settings.merged, shares, settings.bounces, channel.regularisation);
    const MatrixXd fine = of_all(channel.terms.value, channel.lights, shares.size());
    // Regions within a merged one also differ from each other; only the mean of the merged one is compared.
    const MatrixXd means = merged(fine, settings.merged, shares, false)(settings.merged, Eigen::all);
    differences = (means - coarse).cwiseAbs();
    for (int n = 0; n < settings.bounces; ++n)
        result.discretisation[static_cast<std::size_t>(n)] += std::abs(shares.dot(fine.col(n) - coarse.col(n))) / 3.0;
}

PictureMeans means_of(const std::array<UnbouncedChannel, 3>& channels, const VectorXd& shares, int n, double degrees_of_freedom) {
    PictureMeans means;
    means.all.degrees_of_freedom = degrees_of_freedom;
    for (int c = 0; c < 3; ++c) {
        const UnbouncedChannel& channel = channels[static_cast<std::size_t>(c)];
        MeanWithError& mean = means.channel[c];
        mean.degrees_of_freedom = degrees_of_freedom;
        if (!channel.lights.empty()) {
            mean.mean = shares(channel.lights).dot(channel.terms.value.col(n));
            mean.standard_error = channel.mean_errors[n];
        }
        means.all.mean += mean.mean / 3.0;
        // The channels of one picture are correlated.
        means.all.standard_error += mean.standard_error / 3.0;
    }
    return means;
}

void expect_regions(const Regions& regions, const LightPictures& pictures) {
    for (const int light : regions.of_pixel)
        if (light != Regions::none && (light < 0 || static_cast<std::size_t>(light) >= pictures.lights()))
            throw InputError(fmt::format("a pixel is in region {}, expected 1 to {}, as many as there are pictures", light + 1,
                                         pictures.lights()));
}

// The regions without pixels that are black under all lights, such as those that show nothing, which would change the
// means arbitrarily.
Regions lit_part(Regions regions, const LightPictures& pictures) {
    const Regions lit = brightest_regions(pictures);
    if (lit.width != regions.width || lit.height != regions.height)
        throw InputError(fmt::format("the regions are {}×{} pixels, expected {}×{} as the pictures", regions.width, regions.height,
                                     lit.width, lit.height));
    for (std::size_t p = 0; p < lit.of_pixel.size(); ++p)
        if (lit.of_pixel[p] == Regions::none) regions.of_pixel[p] = Regions::none;
    return regions;
}

void expect_light(const RegionMeans& pictures) {
    for (const MatrixXd& T : pictures.mean)
        if ((T.diagonal().array() > 0.0).any()) return;
    throw InputError("all pictures are black where their lights shine; expected pictures of a scene under separate lights");
}

}  // namespace

Unbounced unbounce(const LightPictures& pictures, const Regions& given_regions, const Estimate* picture,
                   const UnbounceSettings& settings, const Watch& watch) {
    if (pictures.lights() < 2)
        throw InputError(
            fmt::format("{} is the only picture; expected one for each of at least two lights", pictures.names.front()));
    expect_regions(given_regions, pictures);
    const Regions regions = lit_part(given_regions, pictures);
    const VectorXd shares = regions.sizes(pictures.lights()) / static_cast<double>(regions.of_pixel.size());
    Unbounced result;
    result.regions = regions;
    result.pictures = region_means(pictures, regions);
    expect_light(result.pictures);
    if (pictures.direct) result.direct = direct_means(pictures, regions);
    std::optional<RegionMeans> given;
    if (picture != nullptr) given = region_means(*picture, regions, pictures.lights());
    result.knows_errors = result.pictures.variance[0].size() > 0;
    // The parts of other regions are of no use.
    const bool has_parts = result.knows_errors && pictures.parts && pictures.parts->regions.of_pixel == given_regions.of_pixel;
    const RegionParts* const parts = has_parts ? pictures.parts : nullptr;
    result.degrees_of_freedom = unbounce_degrees_of_freedom(parts ? parts->parts.size() : 0);

    if (!settings.merged.empty()) result.discretisation.assign(static_cast<std::size_t>(settings.bounces), 0.0);
    std::array<MatrixXd, 3> differences;
    for (int c = 0; c < 3; ++c) {
        if (watch.stop()) throw Stopped();
        ChannelPictures channel =
            channel_pictures(result.pictures, settings.with_direct ? &*result.direct : nullptr, given ? &*given : nullptr, c);
        if (parts) channel.parts = parts_of(*parts, regions.sizes(pictures.lights()), static_cast<std::size_t>(c));
        UnbouncedChannel& found = result.channels[static_cast<std::size_t>(c)];
        found = unbounce_channel(channel, shares, settings.bounces, settings.regularisation, settings.seed);
        if (!found.terms.value.allFinite())
            throw InputError("the matrix of pictures is singular; expected a regularisation above 0");
        if (!settings.merged.empty() && !found.lights.empty())
            add_discretisation(result, c, channel, shares, settings, differences[static_cast<std::size_t>(c)]);
    }
    for (int n = 0; n < settings.bounces; ++n)
        result.means.push_back(means_of(result.channels, shares, n, result.degrees_of_freedom));
    add_pixel_terms(pictures, picture, settings.with_direct, differences, watch, result);
    return result;
}

}  // namespace neumann
