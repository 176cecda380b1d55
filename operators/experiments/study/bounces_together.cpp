#include "operators/experiments/study/bounces_together.h"

namespace neumann {

Image stacked(const std::vector<Image>& pictures) {
    Image all(pictures.front().width, pictures.front().height * static_cast<int>(pictures.size()));
    all.pixels.clear();
    for (const Image& picture : pictures) all.pixels.insert(all.pixels.end(), picture.pixels.begin(), picture.pixels.end());
    return all;
}

Estimate together(const std::vector<Estimate>& reference, const StackedBounces& bounces) {
    Estimate all = reference[bounces.first];
    std::vector<Image> means, errors;
    for (std::size_t i = bounces.first; i <= bounces.last; ++i) {
        means.push_back(reference[i].mean);
        errors.push_back(reference[i].standard_error);
        if (errors.back().pixels.empty()) errors.back() = Image(means.back().width, means.back().height);
    }
    all.mean = stacked(means);
    all.standard_error = stacked(errors);
    all.discretisation = {};
    return all;
}

}  // namespace neumann
