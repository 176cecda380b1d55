#include "operators/experiments/blame/likelihood.h"

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

// −2 log of the likelihood of single pixels.
class Misfits {
public:
    Misfits(const PictureNoise& a, const PictureNoise& b, const Image& usual) : a_(a), b_(b), usual_(usual) {
        for (int c = 0; c < 3; ++c)
            least_[c] = rounding_of_pictures * std::max({std::abs(mean_of(a.mean, c)), std::abs(mean_of(b.mean, c)), 1e-30});
    }
    double at(std::size_t i) const {
        constexpr double freedom = 4.0;
        double sum = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double d = a_.mean.pixels[i][c] - b_.mean.pixels[i][c], known = a_.variance.pixels[i][c] + least_[c] * least_[c],
                         v = known + b_.variance.pixels[i][c];
            sum += (freedom + 1.0) * std::log1p(d * d / (freedom * v)) + std::log(known + usual_.pixels[i][c]);
        }
        return sum;
    }

private:
    const PictureNoise &a_, &b_;
    const Image& usual_;
    Rgb least_{0.0};
};

}  // namespace

double misfit(const PictureNoise& a, const PictureNoise& b, const Image& usual) {
    const Misfits misfits(a, b, usual);
    double sum = 0.0;
    for (std::size_t i = 0; i < a.mean.pixels.size(); ++i) sum += misfits.at(i);
    return sum;
}

}  // namespace neumann
