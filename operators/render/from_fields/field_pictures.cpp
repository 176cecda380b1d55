#include "operators/render/from_fields/field_pictures.h"

#include "operators/paths/walk/path_group.h"
#include "operators/statistics/one_sample_more.h"
#include "operators/statistics/student_t.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace neumann {

FieldPictures::FieldPictures(const Film& film, const FieldSettings& settings)
    : importance(settings.reading == FieldReading::importance),
      width_(film.crop_width),
      height_(film.crop_height),
      replicates_(settings.replicates),
      quantities_(static_cast<std::size_t>(settings.bounces) + 2),
      stride_(3 * quantities_ * (replicates_ + 1)),
      values_(make_large_array<float>(stride_ * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_))),
      means_(make_large_array<float>(3 * quantities_ * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_))) {}

Estimate FieldPictures::picture(std::size_t first, std::size_t last) const {
    const auto black = [&] { return Image(width_, height_); };
    Estimate result{black(), black(), replicates_ - 1.0, black(), false};
    const std::size_t pixels = result.mean.pixels.size();
    const auto n = static_cast<double>(replicates_);
    const auto value = [&](std::size_t pixel, std::size_t replicate) {
        const float* v = values_.get() + pixel * stride_ + 3 * quantities_ * replicate;
        Rgb sum(0.0);
        for (std::size_t q = first; q <= last; ++q) sum += Rgb(v[3 * q], v[3 * q + 1], v[3 * q + 2]);
        return sum;
    };
    std::vector<SampleRange> ranges(pixels);  // the ranges of the replicates' values
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, pixels, 1024), [&](const auto& range) {
        std::vector<Rgb> found(replicates_);
        for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel) {
            Rgb sum(0.0), squares(0.0);
            for (std::uint32_t r = 0; r < replicates_; ++r) {
                sum += found[r] = value(pixel, r);
                ranges[pixel].add(found[r]);
            }
            const Rgb mean = sum / n;
            for (const Rgb& x : found) squares += (x - mean) * (x - mean);
            Rgb least(0.0);
            for (std::size_t q = first; q <= last; ++q) {
                const float* const m = means_.get() + 3 * (q * pixels + pixel);
                least += resolution_.in_pixel(q) * glm::abs(Rgb(m[0], m[1], m[2]));
            }
            result.mean.pixels[pixel] = mean;
            result.standard_error.pixels[pixel] = replicates_ > 1 ? glm::max(glm::sqrt(squares / (n * (n - 1.0))), least)
                                                                  : Rgb(std::numeric_limits<double>::infinity());
            result.discretisation.pixels[pixel] = glm::abs(value(pixel, replicates_));
        }
    });
    if (replicates_ > 1) raise_errors(ranges, result);
    return result;
}

// At the edges of visible shapes replicates agree by chance, as equally many of their samples meet the shape. The
// neighbouring pixels show how much one sample more or less changes.
void FieldPictures::raise_errors(const std::vector<SampleRange>& ranges, Estimate& picture) const {
    const double t = student_t_quantile(0.95, replicates_ - 1.0);
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, ranges.size(), 1024), [&](const auto& range) {
        for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel) {
            SampleRange around;
            for_neighbourhood(width_, height_, pixel, [&](std::size_t other) { around.merge(ranges[other]); });
            for (int c = 0; c < 3; ++c) {
                const double d = difference(around, c);
                if (d == 0.0) continue;
                double& error = picture.standard_error.pixels[pixel][c];
                const bool agree = difference(ranges[pixel], c) == 0.0;
                error = std::max(error, least_half_width(d, static_cast<double>(samples), agree) / t);
            }
        }
    });
}

void FieldPictures::set_replicate(std::uint32_t replicate, std::span<const Rgb> picture) {
    for (std::size_t i = 0; i < picture.size(); ++i) {
        float* const to = values(i / quantities_) + 3 * (quantities_ * replicate + i % quantities_);
        for (int c = 0; c < 3; ++c) to[c] = static_cast<float>(picture[i][c]);
    }
}

double FieldPictures::relative_noise(std::size_t quantity) const {
    const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    const double n = replicates_;
    double errors = 0.0, means = 0.0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0.0, squares = 0.0;
            for (std::size_t r = 0; r < replicates_; ++r) {
                const double x = values_[pixel * stride_ + 3 * (quantities_ * r + quantity) + c];
                sum += x;
                squares += x * x;
            }
            errors += (squares - sum * sum / n) / (n * (n - 1.0));
            means += sum * sum / (n * n);
        }
    return means > 0.0 && n > 1.0 ? std::sqrt(errors / means) : std::numeric_limits<double>::infinity();
}

void FieldPictures::set_to_zero(std::size_t quantity) {
    const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        for (std::size_t r = 0; r < replicates_; ++r) std::fill_n(values(pixel) + 3 * (quantities_ * r + quantity), 3, 0.0f);
}

void FieldPictures::add_by_groups(std::uint32_t pixels) {
    group_ = pixels;
    const std::size_t all = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    sums_of_groups_.assign((all + pixels - 1) / pixels * sums_of_quantity * quantities_ * replicates_, 0.0);
}

void FieldPictures::group_is_complete(std::size_t group) {
    const std::size_t begin = group * group_,
                      end = std::min(begin + group_, static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)),
                      each = sums_of_quantity, quantities = quantities_ * replicates_;
    double* const of_group = sums_of_groups_.data() + group * each * quantities;
    std::fill_n(of_group, each * quantities, 0.0);
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
        const float* const v = values(pixel);
        for (std::size_t q = 0; q < quantities; ++q) {
            for (std::size_t c = 0; c < 3; ++c) of_group[each * q + c] += double{v[3 * q + c]};
            of_group[each * q + 3] += (double{v[3 * q]} + v[3 * q + 1] + v[3 * q + 2]) / 3.0;
        }
    }
    find_means(begin, end);
}

void FieldPictures::add_groups() {
    find_differences();
    // The order is fixed, so that the result does not depend on threads.
    sums_.assign(sums_of_quantity * quantities_ * replicates_, 0.0);
    for (std::size_t k = 0; k < sums_of_groups_.size(); ++k) sums_[k % sums_.size()] += sums_of_groups_[k];
    sums_of_groups_ = {};
}

void FieldPictures::find_differences() {
    std::vector<SampleRange> ranges(quantities_);
    const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        for (std::uint32_t r = 0; r < replicates_; ++r)
            for (std::size_t q = 0; q < quantities_; ++q) {
                const float* const v = values(pixel) + 3 * (quantities_ * r + q);
                ranges[q].add(Rgb(v[0], v[1], v[2]));
            }
    for (std::size_t q = 0; q < quantities_; ++q)
        for (int c = 0; c < 3; ++c) differences_.push_back(difference(ranges[q], c));
}

void FieldPictures::find_means(std::size_t begin, std::size_t end) {
    const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    const float part = 1.0f / static_cast<float>(replicates_);
    for (std::size_t q = 0; q < quantities_; ++q)
        for (std::size_t pixel = begin; pixel < end; ++pixel) {
            float* const mean = means_.get() + 3 * (q * pixels + pixel);
            const float* const v = values(pixel) + 3 * q;
            for (std::size_t c = 0; c < 3; ++c) {
                float sum = 0.0f;
                for (std::size_t r = 0; r < replicates_; ++r) sum += v[3 * quantities_ * r + c];
                mean[c] = sum * part;
            }
        }
}

Image FieldPictures::term_mean(std::size_t i) const {
    Image result(width_, height_);
    const float* const mean = means_.get() + 3 * i * result.pixels.size();
    oneapi::tbb::parallel_for(std::size_t{0}, result.pixels.size(), [&](std::size_t pixel) {
        result.pixels[pixel] = Rgb(mean[3 * pixel], mean[3 * pixel + 1], mean[3 * pixel + 2]);
    });
    return result;
}

MeanWithError FieldPictures::mean(std::size_t first, std::size_t last, std::size_t which) const {
    const auto n = static_cast<double>(replicates_);
    double sum = 0.0, squares = 0.0;
    std::vector<double> of_replicate(replicates_);
    for (std::uint32_t r = 0; r < replicates_; ++r) {
        for (std::size_t q = first; q <= last; ++q) of_replicate[r] += replicate_mean(r, q, which);
        sum += of_replicate[r];
    }
    for (const double x : of_replicate) squares += (x - sum / n) * (x - sum / n);
    double least = 0.0;
    for (std::size_t q = first; q <= last; ++q)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::uint32_t r = 0; r < replicates_; ++r)
                if (which == c || which == 3)
                    least += std::abs(replicate_mean(r, q, c)) * resolution_.of_mean(q)[static_cast<int>(c)] /
                             (n * (which == 3 ? 3.0 : 1.0));
    if (n == 1.0) return {sum / n, std::numeric_limits<double>::infinity(), 0.0};
    const double spread = std::sqrt(squares / (n * (n - 1.0)));
    // This is the effect of one sample more or less in the whole picture.
    double d = 0.0;
    for (std::size_t q = first; q <= last; ++q)
        for (std::size_t c = 0; c < 3; ++c)
            if (which == c || which == 3) d += differences_[3 * q + c] / (which == 3 ? 3.0 : 1.0);
    const bool agree = spread <= rounding_of_ranges * std::abs(sum / n);
    const double all_samples = static_cast<double>(samples) * width_ * height_;
    least = std::max(least, least_half_width(d, all_samples, agree) / student_t_quantile(0.95, n - 1.0));
    return {sum / n, std::max(spread, least), n - 1.0};
}

PictureMeans FieldPictures::means(std::size_t first, std::size_t last) const {
    PictureMeans means;
    for (std::size_t c = 0; c < 3; ++c) means.channel[c] = mean(first, last, c);
    means.all = mean(first, last);
    return means;
}

PictureError picture_error(const Estimate& picture) {
    const double sampling = relative_standard_error(picture), difference = relative_discretisation(picture);
    return {sampling, std::sqrt(std::max(difference * difference - sampling * sampling, 0.0))};
}

DiscretisationReport report_discretisation(const Film& film, const Estimate& picture, const PictureError& of_picture) {
    DiscretisationReport report;
    report.worst_x = film.crop_x;
    report.worst_y = film.crop_y;
    const Image& error = picture.discretisation;
    for (std::size_t i = 0; i < error.pixels.size(); ++i) {
        report.mean += mean_component(error.pixels[i]) / static_cast<double>(error.pixels.size());
        if (max_component(error.pixels[i]) <= report.worst) continue;
        report.worst = max_component(error.pixels[i]);
        const Pixel pixel = pixel_of(film, static_cast<std::uint32_t>(i));
        report.worst_x = pixel.x;
        report.worst_y = pixel.y;
    }
    report.relative = of_picture.discretisation;
    return report;
}

}  // namespace neumann
