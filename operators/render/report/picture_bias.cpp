#include "operators/render/report/picture_bias.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

constexpr int neighbourhoods_across = 8;

// The mean of `value_at(k)` over max(i − reach, 0) ≤ k ≤ min(i + reach, count − 1), for each i.
template <class ValueAt, class Put>
void running_means(int count, int reach, const ValueAt& value_at, const Put& put) {
    Rgb sum(0.0);
    for (int k = 0; k < std::min(reach, count); ++k) sum += value_at(k);
    int values = std::min(reach, count);
    for (int i = 0; i < count; ++i) {
        if (i + reach < count) sum += value_at(i + reach), ++values;
        if (i > reach) sum -= value_at(i - reach - 1), --values;
        put(i, glm::max(sum, Rgb(0.0)) / static_cast<double>(values));
    }
}

Image root_mean_square_nearby(const Image& image) {
    const int width = image.width, height = image.height,
              reach = std::max(1, std::min(width, height) / (2 * neighbourhoods_across));
    Image rows(width, height), all(width, height);
    for (int y = 0; y < height; ++y)
        running_means(
            width, reach, [&](int x) { return image.at(x, y) * image.at(x, y); },
            [&](int x, const Rgb& mean) { rows.at(x, y) = mean; });
    for (int x = 0; x < width; ++x)
        running_means(
            height, reach, [&](int y) { return rows.at(x, y); }, [&](int y, const Rgb& mean) { all.at(x, y) = glm::sqrt(mean); });
    return all;
}

}  // namespace

Image stated_bias(const TwoRadii& radii, const Image& difference) {
    Image bias = radii.errs_both_ways ? root_mean_square_nearby(difference) : difference;
    for (Rgb& x : bias.pixels) x = glm::abs(x) / radii.part_of_bias;
    return bias;
}

}  // namespace neumann
