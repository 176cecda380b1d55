#include "operators/statistics/metrics.h"

#include "core/base/error.h"
#include "operators/statistics/student_t.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace neumann {
namespace {

void expect_same_size(const Image& test, const Image& reference) {
    if (test.width == reference.width && test.height == reference.height) return;
    throw InputError(fmt::format("{}×{} pixels against {}×{}", test.width, test.height, reference.width, reference.height));
}

std::vector<std::size_t> finite_in_both(const Image& test, const Image& reference) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < test.pixels.size(); ++i) {
        if (is_finite(test.pixels[i]) && is_finite(reference.pixels[i])) places.push_back(i);
    }
    return places;
}

double ratio(double error, double scale) { return error == 0.0 ? 0.0 : error / scale; }

// Sums of squared standard errors, for Welch and Satterthwaite's degrees of freedom. Pictures may be as bright as 1e±100, so
// squares are relative to the largest.
class ErrorOfSum {
public:
    void add(double standard_error, double degrees_of_freedom) {
        unknown_ = unknown_ || !std::isfinite(standard_error);
        terms_.push_back({standard_error, degrees_of_freedom});
    }

    double standard_error() const {
        if (unknown_) return std::numeric_limits<double>::infinity();
        return largest() == 0.0 ? 0.0 : largest() * std::sqrt(moments().squares);
    }

    double degrees_of_freedom() const {
        if (unknown_) return 0.0;
        if (largest() == 0.0) return exact_degrees_of_freedom;
        const Moments m = moments();
        return m.squares * m.squares / m.fourths;
    }

private:
    struct Term {
        double standard_error, degrees_of_freedom;
    };
    struct Moments {
        double squares = 0.0, fourths = 0.0;
    };

    double largest() const {
        double value = 0.0;
        for (const Term& term : terms_) value = std::max(value, term.standard_error);
        return value;
    }

    Moments moments() const {
        const double unit = largest();
        Moments m;
        for (const Term& term : terms_) {
            const double square = (term.standard_error / unit) * (term.standard_error / unit);
            m.squares += square;
            m.fourths += square * square / term.degrees_of_freedom;
        }
        return m;
    }

    std::vector<Term> terms_;
    bool unknown_ = false;
};

}  // namespace

Metrics compare(const Image& test, const Image& reference) {
    expect_same_size(test, reference);
    const std::vector<std::size_t> places = finite_in_both(test, reference);
    Metrics m;
    m.pixels = places.size();
    m.not_finite = test.pixels.size() - places.size();
    const double n = 3.0 * static_cast<double>(places.size());

    const auto each_value = [&](const auto& visit) {
        for (const std::size_t i : places) {
            for (int c = 0; c < 3; ++c) visit(test.pixels[i][c], reference.pixels[i][c]);
        }
    };
    double test_size = 0.0, reference_size = 0.0;  // mean |x| and |r|
    each_value([&](double x, double r) {
        m.mean += x;
        m.reference_mean += r;
        m.mean_difference += x - r;
        test_size += std::abs(x);
        reference_size += std::abs(r);
        m.max_error = std::max(m.max_error, std::abs(x - r));
    });
    for (double* sum : {&m.mean, &m.reference_mean, &m.mean_difference, &test_size, &reference_size}) *sum /= n;

    const double epsilon = metrics_epsilon;
    double square = 0.0;  // in units of max_error²
    each_value([&](double x, double r) {
        const double error = std::abs(x - r);
        square += ratio(error, m.max_error) * ratio(error, m.max_error);
        m.rel_mse += ratio(error * error, r * r + epsilon * m.reference_mean * m.reference_mean);
        m.mape += ratio(error, std::abs(r) + epsilon * reference_size);
        m.smape += ratio(2.0 * error, std::abs(x) + std::abs(r) + epsilon * (test_size + reference_size));
    });
    for (double* sum : {&square, &m.rel_mse, &m.mape, &m.smape}) *sum /= n;
    m.rmse = m.max_error * std::sqrt(square);
    if (places.empty()) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        m.rmse = m.rel_mse = m.mape = m.smape = m.max_error = m.mean = m.reference_mean = m.mean_difference = nan;
    }
    return m;
}

double expected_rmse(const Estimate& test, const Estimate& reference) {
    expect_same_size(test.mean, reference.mean);
    const std::vector<std::size_t> places = finite_in_both(test.mean, reference.mean);
    ErrorOfSum error;
    for (const Image* errors : {&test.standard_error, &reference.standard_error}) {
        if (errors->pixels.empty()) continue;
        for (const std::size_t i : places) {
            for (int c = 0; c < 3; ++c) error.add(errors->pixels[i][c], exact_degrees_of_freedom);
        }
    }
    return error.standard_error() / std::sqrt(3.0 * static_cast<double>(places.size()));
}

MeanDifferences compare_means(const ComparedPicture& test, const ComparedPicture& reference, double confidence) {
    const Image &test_mean = test.picture.mean, &reference_mean = reference.picture.mean;
    expect_same_size(test_mean, reference_mean);
    const std::vector<std::size_t> places = finite_in_both(test_mean, reference_mean);
    const bool all_pixels = places.size() == test_mean.pixels.size();
    const double n = static_cast<double>(places.size());

    const auto difference_of = [&](const auto& value, const auto& part) {
        MeanDifference d;
        ErrorOfSum error;
        const auto add_errors = [&](const ComparedPicture& compared) {
            const Estimate& picture = compared.picture;
            if (picture.standard_error.pixels.empty()) return;
            if (compared.means && all_pixels) {
                const MeanWithError& mean = part(*compared.means);
                error.add(mean.standard_error, mean.degrees_of_freedom);
                return;
            }
            double all = 0.0;
            for (const std::size_t i : places) {
                const double one = value(picture.standard_error.pixels[i]) / n;
                all += one;
                if (picture.pixels_are_independent) error.add(one, compared.degrees_of_freedom);
            }
            if (!picture.pixels_are_independent) error.add(all, compared.degrees_of_freedom);
        };
        add_errors(test);
        add_errors(reference);
        for (const std::size_t i : places) {
            d.mean += value(test_mean.pixels[i]);
            d.reference_mean += value(reference_mean.pixels[i]);
            d.difference += value(test_mean.pixels[i]) - value(reference_mean.pixels[i]);
        }
        for (double* sum : {&d.mean, &d.reference_mean, &d.difference}) *sum /= n;
        d.standard_error = error.standard_error();
        d.degrees_of_freedom = error.degrees_of_freedom();
        d.half_width = d.standard_error == 0.0 ? 0.0 : d.standard_error * student_t_quantile(confidence, d.degrees_of_freedom);
        return d;
    };
    MeanDifferences all;
    for (int c = 0; c < 3; ++c)
        all.channel[c] = difference_of([c](const Rgb& v) { return v[c]; }, [c](const PictureMeans& m) { return m.channel[c]; });
    all.all = difference_of(mean_component, [](const PictureMeans& m) { return m.all; });
    return all;
}

}  // namespace neumann
