#include "operators/render/from_paths/sample_layout.h"

#include "operators/paths/walk/path_group.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace neumann {

SampleLayout::SampleLayout(std::uint32_t pixels, std::uint32_t size, std::shared_ptr<const Allocation> allocation,
                           std::uint32_t together)
    : pixels_(pixels), size_(size), pixels_of_group_(std::max(paths_at_once / size, together)), allocation_(std::move(allocation)) {
    if (!allocation_) {
        nets_.emplace_back(size);
        return;
    }
    std::uint32_t paths = 0, largest = 1;
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        const std::uint32_t here = this->size(pixel);
        largest = std::max(largest, here);
        first_path_.push_back(paths);
        paths += here;
        if (here == 0) continue;
        const bool goes_on = !groups_.empty() && groups_.back().end == pixel && groups_.back().size == here &&
                             (pixel + 1 - groups_.back().begin) * here <= paths_at_once;
        if (!goes_on) groups_.push_back({pixel, pixel, here});
        ++groups_.back().end;
    }
    first_path_.push_back(paths);
    for (std::uint32_t points = 1; points <= largest; points *= 2) nets_.emplace_back(points);
}

std::uint32_t SampleLayout::size(std::uint32_t pixel) const {
    return allocation_ ? Allocation::size_of(size_, allocation_->exponents[pixel]) : size_;
}

std::vector<std::uint32_t> SampleLayout::sizes() const {
    std::vector<std::uint32_t> all;
    for (std::uint32_t pixel = 0; allocation_ && pixel < pixels_; ++pixel) all.push_back(size(pixel));
    return all;
}

std::uint32_t SampleLayout::paths() const { return allocation_ ? first_path_.back() : pixels_ * size_; }

std::uint32_t SampleLayout::first_path(std::uint32_t pixel) const { return allocation_ ? first_path_[pixel] : pixel * size_; }

std::uint32_t SampleLayout::pixel_of(std::uint32_t path) const {
    if (!allocation_) return path / size_;
    return static_cast<std::uint32_t>(std::ranges::upper_bound(first_path_, path) - first_path_.begin()) - 1;
}

std::uint32_t SampleLayout::groups() const {
    if (allocation_) return static_cast<std::uint32_t>(groups_.size());
    return (pixels_ + pixels_of_group_ - 1) / pixels_of_group_;
}

PixelGroup SampleLayout::group(std::uint32_t number) const {
    if (allocation_) return groups_[number];
    return {number * pixels_of_group_, std::min((number + 1) * pixels_of_group_, pixels_), size_};
}

std::uint32_t SampleLayout::group_of(std::uint32_t pixel) const {
    if (!allocation_) return pixel / pixels_of_group_;
    return static_cast<std::uint32_t>(std::ranges::upper_bound(groups_, pixel, {}, &PixelGroup::begin) - groups_.begin()) - 1;
}

SampleName SampleLayout::name(std::uint64_t replicate, std::uint32_t path) const {
    const std::uint32_t pixel = pixel_of(path);
    return {pixel, replicate * size(pixel) + (path - first_path(pixel))};
}

PlaceInGroup SampleLayout::place(const SampleName& name) const {
    const std::uint32_t here = size(name.pixel), first = first_path(group(group_of(name.pixel)).begin);
    return {name.sample / here, first, first_path(name.pixel) + static_cast<std::uint32_t>(name.sample % here) - first};
}

const SobolPoints& SampleLayout::net(std::uint32_t size) const {
    return allocation_ ? nets_[static_cast<std::size_t>(std::countr_zero(size))] : nets_.front();
}

}  // namespace neumann
