#include "operators/statistics/series_moments.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace neumann {

namespace {

// Offsets within the nine doubles of a quantity.
constexpr std::size_t mean_at = 0, term_m2_at = 3, sum_m2_at = 6, stride = PixelMoments::doubles_per_quantity;

void merge_pictures(std::vector<double>& a, double na, const std::vector<double>& b, double nb, std::size_t doubles_per_pixel) {
    const std::size_t pixels = a.size() / doubles_per_pixel;
    oneapi::tbb::parallel_for(std::size_t{0}, pixels, [&](std::size_t pixel) {
        const std::size_t at = pixel * doubles_per_pixel;
        PixelMoments::merge({a.data() + at, doubles_per_pixel}, na, {b.data() + at, doubles_per_pixel}, nb);
    });
}

}  // namespace

void PixelMoments::set(std::span<double> node, std::span<const Rgb> means) {
    for (std::size_t q = 0; q < means.size(); ++q)
        for (int c = 0; c < 3; ++c) {
            const std::size_t at = q * stride + static_cast<std::size_t>(c);
            node[at + mean_at] = means[q][c];
            node[at + term_m2_at] = node[at + sum_m2_at] = 0.0;
        }
}

void PixelMoments::merge(std::span<double> a, double na, std::span<const double> b, double nb) {
    const double share = nb / (na + nb), spread = na * share;
    double sum_difference[3] = {0.0, 0.0, 0.0};
    for (std::size_t q = 0; q < a.size(); q += stride)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = q + c;
            const double difference = b[at + mean_at] - a[at + mean_at];
            sum_difference[c] += difference;
            a[at + mean_at] += difference * share;
            a[at + term_m2_at] += b[at + term_m2_at] + difference * difference * spread;
            a[at + sum_m2_at] += b[at + sum_m2_at] + sum_difference[c] * sum_difference[c] * spread;
        }
}

std::uint64_t SeriesMoments::replicates() const {
    std::uint64_t count = 0;
    for (const Node& node : nodes_) count += node.count;
    return count;
}

std::vector<double> SeriesMoments::add(MomentsNode node) {
    join(node.ranges);
    return join({node.first, node.count, std::make_shared<std::vector<double>>(std::move(node.data))});
}

void SeriesMoments::add(const SeriesMoments& next) {
    if (next.nodes_.empty()) return;
    join(next.ranges_);
    for (const Node& node : next.nodes_) join(node);
}

void SeriesMoments::unite(const SeriesMoments& other) {
    const auto data = std::make_shared<std::vector<double>>(*result().data_);
    const std::uint64_t count = replicates(), more = other.replicates();
    merge_pictures(*data, static_cast<double>(count), *other.result().data_, static_cast<double>(more), doubles_per_pixel());
    join(other.ranges_);
    nodes_ = {{0, count + more, data}};
}

void SeriesMoments::set(std::vector<Node> nodes, SampleRanges ranges) {
    nodes_ = std::move(nodes);
    ranges_ = std::move(ranges);
}

void SeriesMoments::join(const SampleRanges& ranges) {
    if (nodes_.empty())
        ranges_ = ranges;
    else
        ranges_.merge(ranges);
}

std::vector<double> SeriesMoments::join(Node node) {
    if (!nodes_.empty() && node.first != nodes_.back().first + nodes_.back().count)
        throw std::logic_error("SeriesMoments: replicates are not consecutive");
    nodes_.push_back(std::move(node));
    std::vector<double> free;
    while (nodes_.size() >= 2) {
        Node &left = nodes_[nodes_.size() - 2], &right = nodes_.back();
        if (left.count != right.count || left.first % (2 * left.count) != 0) break;
        if (left.data.use_count() > 1) left.data = std::make_shared<std::vector<double>>(*left.data);
        merge_pictures(*left.data, static_cast<double>(left.count), *right.data, static_cast<double>(right.count),
                       doubles_per_pixel());
        left.count *= 2;
        if (right.data.use_count() == 1) free = std::move(*right.data);
        nodes_.pop_back();
    }
    return free;
}

SeriesMoments::Result SeriesMoments::result() const {
    Result result;
    result.width_ = width_;
    result.height_ = height_;
    result.quantities_ = pictures_;
    result.all_ = quantities_;
    if (nodes_.empty()) {
        result.data_ = std::make_shared<std::vector<double>>(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
                                                             doubles_per_pixel());
        return result;
    }
    result.count_ = static_cast<double>(replicates());
    if (nodes_.size() == 1) {
        result.data_ = nodes_.front().data;
        return result;
    }
    const std::size_t stride_of_pixel = doubles_per_pixel();
    const auto merged = std::make_shared<std::vector<double>>(nodes_.front().data->size());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, merged->size() / stride_of_pixel, 256),
                              [&](const auto& range) {
                                  std::vector<double> left(stride_of_pixel);
                                  for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel) {
                                      const auto moments_of = [&](const Node& node) {
                                          return std::span(*node.data).subspan(pixel * stride_of_pixel, stride_of_pixel);
                                      };
                                      const auto sum = std::span(*merged).subspan(pixel * stride_of_pixel, stride_of_pixel);
                                      // Nodes are merged from the right, where the smallest ones are.
                                      std::ranges::copy(moments_of(nodes_.back()), sum.begin());
                                      double count = static_cast<double>(nodes_.back().count);
                                      for (std::size_t i = nodes_.size() - 1; i-- > 0;) {
                                          const auto n = static_cast<double>(nodes_[i].count);
                                          std::ranges::copy(moments_of(nodes_[i]), left.begin());
                                          PixelMoments::merge(left, n, sum, count);
                                          std::ranges::copy(left, sum.begin());
                                          count += n;
                                      }
                                  }
                              });
    result.data_ = merged;
    return result;
}

std::pair<Rgb, Rgb> SeriesMoments::Result::at(std::size_t pixel, std::size_t quantity, bool sum) const {
    const double* data = data_->data() + pixel * all_ * stride;
    const std::size_t m2_at = sum ? sum_m2_at : term_m2_at;
    std::pair<Rgb, Rgb> result;
    for (int c = 0; c < 3; ++c) {
        double mean = 0.0;
        for (std::size_t q = sum ? 0 : quantity; q <= quantity; ++q)
            mean += data[q * stride + mean_at + static_cast<std::size_t>(c)];
        const double m2 = data[quantity * stride + m2_at + static_cast<std::size_t>(c)];
        result.first[c] = mean;
        result.second[c] = count_ > 1.0 ? std::sqrt(m2 / (count_ * (count_ - 1.0))) : std::numeric_limits<double>::infinity();
    }
    return result;
}

double SeriesMoments::Result::noise_of_difference(std::size_t i) const {
    double squares = 0.0;
    for (std::size_t pixel = 0; pixel < pixels(); ++pixel) {
        const Rgb error = at(pixel, quantities_ + i, false).second;
        squares += glm::dot(error, error);
    }
    return std::sqrt(squares);
}

Image SeriesMoments::Result::differences(std::size_t first, std::size_t last) const {
    Image difference(width_, height_);
    for (std::size_t pixel = 0; pixel < difference.pixels.size(); ++pixel)
        for (std::size_t i = first; i <= last; ++i) difference.pixels[pixel] += at(pixel, quantities_ + i, false).first;
    return difference;
}

Estimate SeriesMoments::Result::estimate(std::size_t quantity, bool sum) const {
    Estimate estimate{Image(width_, height_), Image(width_, height_), degrees_of_freedom()};
    estimate.pixels_are_independent = pixels_are_independent();
    for (std::size_t pixel = 0; pixel < estimate.mean.pixels.size(); ++pixel)
        std::tie(estimate.mean.pixels[pixel], estimate.standard_error.pixels[pixel]) = at(pixel, quantity, sum);
    return estimate;
}

MeanWithError SeriesMoments::Result::mean(std::size_t quantity, bool sum) const {
    if (pixels_are_independent()) return picture_mean(estimate(quantity, sum));
    const auto [mean, error] = at(pixels(), quantity, sum);
    return {mean_component(mean), mean_component(error), degrees_of_freedom()};
}

PictureMeans SeriesMoments::Result::means(std::size_t quantity, bool sum) const {
    if (pixels_are_independent()) return picture_means(estimate(quantity, sum));
    PictureMeans means;
    const auto [value, error] = at(pixels(), quantity, sum);
    for (int c = 0; c < 3; ++c) means.channel[c] = {value[c], error[c], degrees_of_freedom()};
    means.all = mean(quantity, sum);
    return means;
}

}  // namespace neumann
