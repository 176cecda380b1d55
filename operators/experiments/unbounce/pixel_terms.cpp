#include "operators/experiments/unbounce/pixel_terms.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace neumann {

namespace {

using Eigen::MatrixXd;

// The weights of a channel for the pixels, for all lights.
struct ChannelWeights {
    MatrixXd y;           // T⁻¹ Cⁿ⁻¹ L, a column for each term
    MatrixXd share;       // (T⁻¹)_jr / (T⁻¹)_rr, lights × regions
    MatrixXd term_error;  // of the regions' terms

    ChannelWeights(const UnbouncedChannel& channel, Eigen::Index lights, Eigen::Index bounces)
        : y(MatrixXd::Zero(lights, bounces)), share(MatrixXd::Zero(lights, lights)), term_error(y) {
        const MatrixXd& inverse = channel.operators.inverse;
        for (std::size_t i = 0; i < channel.lights.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            y.row(channel.lights[i]) = channel.weights.row(row);
            term_error.row(channel.lights[i]) = channel.terms.error.row(row);
            for (std::size_t k = 0; k < channel.lights.size(); ++k) {
                const auto r = static_cast<Eigen::Index>(k);
                share(channel.lights[i], channel.lights[k]) = inverse(row, r) / inverse(r, r);
            }
        }
    }
};

// Sums over lights, to which pictures are added one by one.
class PixelSums {
public:
    PixelSums(const Unbounced& found, bool with_direct) : found_(found), with_direct_(with_direct) {
        const Regions& regions = found.regions;
        const Image black(regions.width, regions.height);
        terms_.assign(found.means.size(), black);
        variances_ = terms_;
        for (const UnbouncedChannel& channel : found.channels)
            channels_.emplace_back(channel, static_cast<Eigen::Index>(found.lights()), bounces());
    }

    // Adds `estimate`, the picture of a light or, with `is_direct`, the direct light in it.
    void add(std::size_t light, const Estimate& estimate, bool is_direct) {
        const auto j = static_cast<Eigen::Index>(light);
        const bool has_errors = found_.knows_errors && !estimate.standard_error.pixels.empty();
        for (std::size_t p = 0; p < found_.regions.of_pixel.size(); ++p) {
            const int r = found_.regions.of_pixel[p];
            if (r == Regions::none) continue;
            for (int c = 0; c < 3; ++c) {
                const ChannelWeights& weights = channels_[static_cast<std::size_t>(c)];
                const double value = estimate.mean.pixels[p][c];
                const double error = has_errors ? estimate.standard_error.pixels[p][c] : 0.0;
                for (Eigen::Index n = 0; n < bounces(); ++n) {
                    const auto term = static_cast<std::size_t>(n);
                    const double weight = is_direct ? of_direct(n) * weights.y(j, n) : of_picture(weights, j, r, n);
                    terms_[term].pixels[p][c] += weight * value;
                    variances_[term].pixels[p][c] += weight * weight * error * error;
                }
            }
        }
    }

    PixelEstimate term(int n, const std::array<MatrixXd, 3>& differences) const {
        const auto index = static_cast<std::size_t>(n);
        PixelEstimate result;
        result.mean = terms_[index];
        result.pixels_are_independent = false;
        result.degrees_of_freedom = found_.degrees_of_freedom;
        const Image black(result.mean.width, result.mean.height);
        if (found_.knows_errors) result.standard_error = black;
        if (!found_.discretisation.empty()) result.discretisation = black;
        for (std::size_t p = 0; p < result.mean.pixels.size(); ++p) {
            const int r = found_.regions.of_pixel[p];
            if (r == Regions::none) continue;
            for (int c = 0; c < 3; ++c) {
                const auto channel = static_cast<std::size_t>(c);
                const double of_region = channels_[channel].term_error(r, n);
                if (found_.knows_errors)
                    result.standard_error.pixels[p][c] = std::sqrt(variances_[index].pixels[p][c] + of_region * of_region);
                if (differences[channel].size() > 0) result.discretisation.pixels[p][c] = differences[channel](r, n);
            }
        }
        return result;
    }

private:
    Eigen::Index bounces() const { return static_cast<Eigen::Index>(found_.means.size()); }

    // The sign of T¹ y in a term: it is bounce 1, and is subtracted from later ones, where it would count twice.
    static double of_direct(Eigen::Index n) { return n == 0 ? 1.0 : -1.0; }
    // The weight of a pixel's value T_pj in term n.
    double of_picture(const ChannelWeights& weights, Eigen::Index j, Eigen::Index r, Eigen::Index n) const {
        return (n == 0 ? 0.0 : weights.y(j, n)) + (with_direct_ ? 0.0 : of_direct(n) * weights.share(j, r) * weights.y(r, n));
    }

    const Unbounced& found_;
    bool with_direct_;
    std::vector<ChannelWeights> channels_;
    std::vector<Image> terms_, variances_;
};

void add(Image& sum, const Image& picture, double factor) {
    for (std::size_t p = 0; p < sum.pixels.size(); ++p) sum.pixels[p] += factor * picture.pixels[p];
}

}  // namespace

void add_pixel_terms(const LightPictures& pictures, const Estimate* picture, bool with_direct,
                     const std::array<MatrixXd, 3>& differences, const Watch& watch, Unbounced& result) {
    const auto [width, height] = std::pair(result.regions.width, result.regions.height);
    PixelSums sums(result, with_direct);
    result.picture = picture != nullptr ? picture->mean : Image(width, height);
    for (std::size_t j = 0; j < pictures.lights(); ++j) {
        if (watch.stop()) throw Stopped();
        const Estimate of_light = checked_picture(pictures, j, width, height);
        sums.add(j, of_light, false);
        if (with_direct) sums.add(j, checked_direct(pictures, j, width, height), true);
        if (picture == nullptr) add(result.picture, of_light.mean, 1.0);
    }
    result.rest = result.picture;
    for (int n = 0; n < static_cast<int>(result.means.size()); ++n) {
        result.terms.push_back(sums.term(n, differences));
        add(result.rest, result.terms.back().mean, -1.0);
    }
}

}  // namespace neumann
