// Which pixels belong to which light: the regions of what is seen, as many as there are lights.
#pragma once

#include "operators/experiments/unbounce/light_pictures.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace neumann {

struct Regions {
    static constexpr int none = -1;

    int width = 0, height = 0;
    std::vector<int> of_pixel;  // a light, or none

    Eigen::VectorXd sizes(std::size_t lights) const;  // in pixels
};

// A pixel belongs to the light under which its mean over channels is largest; to none if it is black under all of them. Throws
// InputError as checked_picture().
Regions brightest_regions(const LightPictures& pictures);

// columns × rows blocks of a picture, from the upper left corner row by row, at most a block a pixel: that of a pixel, and all.
inline int block_of_pixel(int x, int y, int width, int height, int columns, int rows) {
    return y * rows / height * columns + x * columns / width;
}
Regions block_regions(int width, int height, int columns, int rows);

// For each light of columns × rows, its number among blocks of 2×2 of them; those at the edges may be smaller.
std::vector<int> merged_by_four(int columns, int rows);

// The red, green and blue of regions in each of several independent parts of the samples, as large as each other, where the
// pictures of all lights are made of the same samples: T is the mean of the parts, and errors go together as they do there.
struct RegionParts {
    struct Part {
        std::array<Eigen::MatrixXd, 3> T;       // regions × lights
        std::array<Eigen::VectorXd, 3> direct;  // of the regions in their own light
    };
    Regions regions;
    std::vector<Part> parts;
};

// Means over regions, a column a light. In the variance, errors of pixels are independent, or go together as the picture says.
struct RegionMeans {
    Eigen::MatrixXd mean[3], variance[3];  // variance: empty where the errors of any picture are not known
};
RegionMeans region_means(const LightPictures& pictures, const Regions& regions);
RegionMeans direct_means(const LightPictures& pictures, const Regions& regions);
// Of a single picture: one column.
RegionMeans region_means(const Estimate& picture, const Regions& regions, std::size_t lights);

}  // namespace neumann
