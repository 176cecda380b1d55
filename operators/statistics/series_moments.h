// Means and variances of all pictures of a series over replicates: for every pixel the mean of each term, and the
// second central moments of each term and of each partial sum.
//
// Replicates are the leaves of one fixed binary tree (pairwise summation), whose nodes are the ranges [a·2^k, (a+1)·2^k). The
// rounding therefore does not depend on how a run was divided: any ranges that cover the same replicates merge to the same bits.
// Two sets are joined by the formula of Chan, Golub and LeVeque (1983), under which equal means leave the variance exactly zero.
#pragma once

#include "core/image/image.h"
#include "operators/statistics/picture_statistics.h"
#include "operators/statistics/sample_ranges.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace neumann {

// The layout of one pixel: `quantities` terms (the last may be the rest), each with its mean, M2 of the term, and M2 of
// the sum up to it; RGB.
class PixelMoments {
public:
    static constexpr std::size_t doubles_per_quantity = 9;

    // Sets the node of one replicate: its means are given, its moments are zero.
    static void set(std::span<double> node, std::span<const Rgb> means);
    // a ← a ∪ b, where a and b have na and nb replicates.
    static void merge(std::span<double> a, double na, std::span<const double> b, double nb);
};

// A node of the tree: 2^k consecutive replicates of a whole picture.
struct MomentsNode {
    std::uint64_t first = 0, count = 0;
    std::vector<double> data;  // pixel by pixel; if pixels are not independent, their mean follows as one more pixel
    SampleRanges ranges = {};  // ranges of the samples; may be empty
};

// Consecutive replicates, stored as the smallest number of nodes.
class SeriesMoments {
public:
    struct Node {
        std::uint64_t first, count;
        std::shared_ptr<std::vector<double>> data;  // shared with results
    };

    SeriesMoments(int width, int height, std::size_t quantities) : SeriesMoments(width, height, quantities, quantities) {}
    // Only the first `pictures` quantities are terms. The others, if any, are the differences of these between two ways
    // to make them, in the same order (Result::difference_of_term()).
    SeriesMoments(int width, int height, std::size_t quantities, std::size_t pictures)
        : width_(width), height_(height), quantities_(quantities), pictures_(pictures) {}

    // `node` must start where the present replicates end. Returns memory that has become free, if any, for the next node.
    std::vector<double> add(MomentsNode node);
    // `next` must start where these replicates end.
    void add(const SeriesMoments& next);
    // `other` must hold independent replicates of the same pictures, with another seed. Both become one node, in which
    // replicates no longer have numbers.
    void unite(const SeriesMoments& other);
    // Sets the nodes and ranges, as nodes() and ranges() of other moments return them.
    void set(std::vector<Node> nodes, SampleRanges ranges);

    std::uint64_t first() const { return nodes_.empty() ? 0 : nodes_.front().first; }
    std::uint64_t replicates() const;
    std::size_t quantities() const { return quantities_; }
    std::size_t pictures() const { return pictures_; }
    std::size_t doubles_per_pixel() const { return quantities_ * PixelMoments::doubles_per_quantity; }
    int width() const { return width_; }
    int height() const { return height_; }
    const std::vector<Node>& nodes() const { return nodes_; }
    // Ranges of all samples; empty if they were not kept.
    const SampleRanges& ranges() const { return ranges_; }

    // All nodes merged, for reading term() and sum(). A single node is not copied.
    class Result;
    Result result() const;

private:
    void join(const SampleRanges& ranges);
    std::vector<double> join(Node node);

    int width_, height_;
    std::size_t quantities_, pictures_;
    std::vector<Node> nodes_;
    SampleRanges ranges_;  // of all nodes together
};

class SeriesMoments::Result {
public:
    // The mean over n replicates, and its standard error √(M2 / (n (n−1))), of quantity i and of the sum of quantities 0 … i.
    Estimate term(std::size_t i) const { return estimate(i, false); }
    Estimate sum(std::size_t i) const { return estimate(i, true); }

    // Means over pixels and channels. If pixels are not independent, the standard error comes from the spread of whole replicates.
    MeanWithError mean_of_term(std::size_t i) const { return mean(i, false); }
    MeanWithError mean_of_sum(std::size_t i) const { return mean(i, true); }
    PictureMeans means_of_term(std::size_t i) const { return means(i, false); }
    PictureMeans means_of_sum(std::size_t i) const { return means(i, true); }

    // The means of the differences that belong to term i, or to the sum up to it, if the moments have differences.
    bool has_differences() const { return all_ > quantities_; }
    Image difference_of_term(std::size_t i) const { return differences(i, i); }
    // √(Σ SE²) of difference_of_term(i), over pixels and channels.
    double noise_of_difference(std::size_t i) const;
    Image difference_of_sum(std::size_t i) const { return differences(0, i); }

    // The mean at one pixel.
    Rgb term_at(std::size_t pixel, std::size_t i) const { return at(pixel, i, false).first; }
    Rgb sum_at(std::size_t pixel, std::size_t i) const { return at(pixel, i, true).first; }

    double degrees_of_freedom() const { return count_ > 0.0 ? count_ - 1.0 : 0.0; }
    std::size_t quantities() const { return quantities_; }
    int width() const { return width_; }
    int height() const { return height_; }
    std::size_t pixels() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

private:
    friend class SeriesMoments;
    Estimate estimate(std::size_t i, bool sum) const;
    MeanWithError mean(std::size_t i, bool sum) const;
    PictureMeans means(std::size_t i, bool sum) const;
    // Mean and standard error at one pixel.
    std::pair<Rgb, Rgb> at(std::size_t pixel, std::size_t i, bool sum) const;
    Image differences(std::size_t first, std::size_t last) const;
    bool pixels_are_independent() const { return data_->size() <= pixels() * all_ * PixelMoments::doubles_per_quantity; }

    int width_ = 0, height_ = 0;
    std::size_t quantities_ = 0, all_ = 0;  // pictures, and all quantities of a pixel
    double count_ = 0.0;
    std::shared_ptr<const std::vector<double>> data_;
};

}  // namespace neumann
