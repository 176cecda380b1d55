#include "operators/experiments/unbounce/regions.h"

#include <cmath>

namespace neumann {

Eigen::VectorXd Regions::sizes(std::size_t lights) const {
    Eigen::VectorXd sizes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(lights));
    for (const int light : of_pixel)
        if (light != none) sizes[light] += 1.0;
    return sizes;
}

Regions brightest_regions(const LightPictures& pictures) {
    Regions regions;
    std::vector<double> brightest;
    for (std::size_t j = 0; j < pictures.lights(); ++j) {
        if (j == 0) {
            const Image first = pictures.picture(0).mean;
            regions = {first.width, first.height, std::vector<int>(first.pixels.size(), Regions::none)};
            brightest.assign(first.pixels.size(), 0.0);
        }
        const Image picture = checked_picture(pictures, j, regions.width, regions.height).mean;
        for (std::size_t p = 0; p < brightest.size(); ++p)
            if (const double value = mean_component(picture.pixels[p]); value > brightest[p]) {
                brightest[p] = value;
                regions.of_pixel[p] = static_cast<int>(j);
            }
    }
    return regions;
}

Regions block_regions(int width, int height, int columns, int rows) {
    Regions regions{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) regions.of_pixel.push_back(block_of_pixel(x, y, width, height, columns, rows));
    return regions;
}

std::vector<int> merged_by_four(int columns, int rows) {
    std::vector<int> merged;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) merged.push_back(y / 2 * ((columns + 1) / 2) + x / 2);
    return merged;
}

namespace {

void add_column(RegionMeans& means, Eigen::Index column, const Estimate& picture, const Regions& regions,
                const Eigen::VectorXd& sizes) {
    const bool knows_errors = !picture.standard_error.pixels.empty();
    for (int c = 0; c < 3; ++c) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(sizes.size()), errors = sum;
        for (std::size_t p = 0; p < regions.of_pixel.size(); ++p) {
            const int r = regions.of_pixel[p];
            if (r == Regions::none) continue;
            sum[r] += picture.mean.pixels[p][c];
            if (!knows_errors) continue;
            const double error = picture.standard_error.pixels[p][c];
            errors[r] += picture.pixels_are_independent ? error * error : error;
        }
        const Eigen::VectorXd size = sizes.cwiseMax(1.0);
        means.mean[c].col(column) = sum.cwiseQuotient(size);
        if (!knows_errors) means.variance[c].resize(0, 0);
        if (means.variance[c].size() == 0) continue;
        if (!picture.pixels_are_independent) errors = errors.cwiseAbs2();
        means.variance[c].col(column) = errors.cwiseQuotient(size.cwiseAbs2());
    }
}

template <class Picture>
RegionMeans means_of(std::size_t columns, std::size_t lights, const Regions& regions, const Picture& picture) {
    RegionMeans means;
    const Eigen::VectorXd sizes = regions.sizes(lights);
    for (int c = 0; c < 3; ++c)
        means.mean[c] = means.variance[c] = Eigen::MatrixXd::Zero(sizes.size(), static_cast<Eigen::Index>(columns));
    for (std::size_t j = 0; j < columns; ++j) add_column(means, static_cast<Eigen::Index>(j), picture(j), regions, sizes);
    return means;
}

}  // namespace

RegionMeans region_means(const LightPictures& pictures, const Regions& regions) {
    return means_of(pictures.lights(), pictures.lights(), regions,
                    [&](std::size_t j) { return checked_picture(pictures, j, regions.width, regions.height); });
}

RegionMeans direct_means(const LightPictures& pictures, const Regions& regions) {
    return means_of(pictures.lights(), pictures.lights(), regions,
                    [&](std::size_t j) { return checked_direct(pictures, j, regions.width, regions.height); });
}

RegionMeans region_means(const Estimate& picture, const Regions& regions, std::size_t lights) {
    return means_of(1, lights, regions, [&](std::size_t) -> const Estimate& { return picture; });
}

}  // namespace neumann
