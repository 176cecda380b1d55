#include "operators/experiments/blame/worst_places.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

double largest_z(const BlockDifference& block) {
    double largest = 0.0;
    for (int c = 0; c < 3; ++c) {
        if (!(block.variance[c] > 0.0)) continue;
        const double z = block.mean[c] / std::sqrt(block.variance[c]);
        if (std::abs(z) > std::abs(largest)) largest = z;
    }
    return largest;
}

bool touch(const WorstPlace& a, const WorstPlace& b) {
    return a.x <= b.x + b.width && b.x <= a.x + a.width && a.y <= b.y + b.height && b.y <= a.y + a.height;
}

void look_into(WorstPlace& place, const Image& theirs, const Image& ours) {
    double most = -1.0;
    for (int y = place.y; y < place.y + place.height; ++y)
        for (int x = place.x; x < place.x + place.width; ++x) {
            const Rgb d = theirs.at(x, y) - ours.at(x, y);
            place.theirs += theirs.at(x, y);
            place.ours += ours.at(x, y);
            if (glm::dot(d, d) <= most) continue;
            most = glm::dot(d, d);
            place.pixel_x = x;
            place.pixel_y = y;
        }
    const double pixels = static_cast<double>(place.width) * place.height;
    place.theirs /= pixels;
    place.ours /= pixels;
}

}  // namespace

std::vector<WorstPlace> worst_places(const PictureNoise& theirs, const PictureNoise& ours, std::size_t most) {
    std::vector<WorstPlace> all, chosen;
    for (const BlockDifference& b : block_differences(theirs, ours).blocks) {
        all.push_back({});
        WorstPlace& place = all.back();
        place.x = b.x;
        place.y = b.y;
        place.width = b.width;
        place.height = b.height;
        place.z = largest_z(b);
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return std::abs(a.z) > std::abs(b.z); });
    for (WorstPlace& place : all) {
        if (chosen.size() == most || place.z == 0.0) break;
        if (std::any_of(chosen.begin(), chosen.end(), [&](const WorstPlace& c) { return touch(c, place); })) continue;
        look_into(place, theirs.mean, ours.mean);
        chosen.push_back(std::move(place));
    }
    return chosen;
}

}  // namespace neumann
