// Assigns pixels to lights: the regions of what is seen, as many as there are lights.
#pragma once

#include "operators/experiments/unbounce/light_pictures.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace neumann {

struct Regions {
    static constexpr int none = -1;

    int width = 0, height = 0;
    std::vector<int> of_pixel;  // number of a light, or none

    Eigen::VectorXd sizes(std::size_t lights) const;  // in pixels
};

// Each pixel belongs to the light under which its mean over channels is largest; to none if it is black under all of
// them. Throws InputError as checked_picture() does.
Regions brightest_regions(const LightPictures& pictures);

// columns × rows blocks of a picture, from the upper left corner row by row, with at least one pixel each: the block of
// a pixel, and all blocks as regions.
inline int block_of_pixel(int x, int y, int width, int height, int columns, int rows) {
    return y * rows / height * columns + x * columns / width;
}
Regions block_regions(int width, int height, int columns, int rows);

// For each light of columns × rows, the number of its block of 2×2 lights; blocks at the edges may be smaller.
std::vector<int> merged_by_four(int columns, int rows);

// The colours of regions in each of several independent parts of the samples, all of the same size, for pictures of all
// lights that share samples: T is the mean of the parts, whose spread shows the correlation of errors.
struct RegionParts {
    struct Part {
        std::array<Eigen::MatrixXd, 3> T;       // regions × lights
        std::array<Eigen::VectorXd, 3> direct;  // light of each region's own light in it
    };
    Regions regions;
    std::vector<Part> parts;
};

// Means over regions, a column for each light. Their variance takes errors of pixels as the picture says.
struct RegionMeans {
    Eigen::MatrixXd mean[3], variance[3];  // variance: empty if the errors of any picture are not known
};
RegionMeans region_means(const LightPictures& pictures, const Regions& regions);
RegionMeans direct_means(const LightPictures& pictures, const Regions& regions);
// The same for a single picture: one column.
RegionMeans region_means(const Estimate& picture, const Regions& regions, std::size_t lights);

}  // namespace neumann
