// All terms of a series on a patch space, stored unknown by unknown, so that a pixel reads all bounces from one place. The values
// are floats, for pictures only; they are added up in doubles, because a pixel may read them ten million times.
#pragma once

#include "operators/fields/matrix/patch_field.h"
#include "operators/fields/patches/patch_space.h"

#include <algorithm>
#include <span>
#include <vector>

namespace neumann {

class FieldStack {
public:
    // The quantities are bounces 0 … N and, as N + 1, the rest; they are zero until set.
    FieldStack(const PatchSpace& space, int bounces)
        : space_(&space), stride_(3 * (static_cast<std::size_t>(bounces) + 2)), values_(stride_ * (space.size() + 1)) {}

    const PatchSpace& space() const { return *space_; }
    // Three floats for each quantity.
    std::size_t stride() const { return stride_; }
    // The values of all unknowns, and last those of PatchSpace::nothing().
    std::span<const float> values() const { return values_; }
    std::span<float> values() { return values_; }
    const float* operator[](std::uint32_t unknown) const { return values_.data() + unknown * stride_; }

    // Adds `scale` times an unknown's quantities to `to`, from the `first`-th float on.
    void add(std::uint32_t unknown, std::size_t first, double scale, double* __restrict to) const {
        const float* __restrict from = (*this)[unknown];
        for (std::size_t k = first; k < stride_; ++k) to[k] += scale * double{from[k]};
    }
    void add(const PatchSpace::Reading& reading, std::size_t first, double scale, double* __restrict to) const {
        const float *__restrict a = (*this)[reading.unknown[0]], *__restrict b = (*this)[reading.unknown[1]],
                    *__restrict c = (*this)[reading.unknown[2]], *__restrict d = (*this)[reading.unknown[3]];
        const double wa = scale * reading.weight[0], wb = scale * reading.weight[1], wc = scale * reading.weight[2],
                     wd = scale * reading.weight[3];
        for (std::size_t k = first; k < stride_; ++k)
            to[k] += (wa * double{a[k]} + wb * double{b[k]}) + (wc * double{c[k]} + wd * double{d[k]});
    }

    template <int C>
    void set(int quantity, const ExitantVector<C>& term) {
        for (std::uint32_t u = 0; u < space_->size(); ++u) {
            const Rgb value = to_rgb<C>(term.col(u));
            for (int c = 0; c < 3; ++c)
                values_[u * stride_ + 3 * static_cast<std::size_t>(quantity) + static_cast<std::size_t>(c)] =
                    static_cast<float>(value[c]);
        }
    }

    // Subtracts a quantity of another stack on the same space.
    void subtract(std::size_t quantity, const FieldStack& other) {
        for (std::size_t i = 3 * quantity; i < values_.size(); i += stride_)
            for (std::size_t c = 0; c < 3; ++c) values_[i + c] -= other.values_[i + c];
    }

    void set_to_zero(std::size_t quantity) {
        for (std::size_t i = 3 * quantity; i < values_.size(); i += stride_) std::fill_n(values_.data() + i, 3, 0.0f);
    }

    // Replaces the values of a facet's unknowns by their mean.
    void average_over_directions() {
        const auto stride = static_cast<Eigen::Index>(stride_);
        for (const Facet& facet : space_->facets()) {
            Eigen::Map<Eigen::ArrayXXf> of_facet(values_.data() + facet.first * stride_, stride, facet.cells.size());
            of_facet.colwise() = of_facet.rowwise().mean().eval();
        }
    }

private:
    const PatchSpace* space_;
    std::size_t stride_;
    std::vector<float> values_;
};

}  // namespace neumann
