#include "operators/render/from_fields/field_errors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace neumann {

namespace {

double square(double x) { return x * x; }

std::uint32_t grow(std::uint32_t n, double factor, std::uint32_t most, double most_growth) {
    const auto times = std::bit_ceil(static_cast<std::uint32_t>(std::ceil(std::clamp(factor, 1.0, most_growth))));
    return std::max(n, static_cast<std::uint32_t>(std::min(std::uint64_t{most}, std::uint64_t{n} * times)));
}

}  // namespace

void FieldErrors::add(const FieldSettings& settings, std::uint32_t finest, std::vector<PictureError> errors) {
    const double times = static_cast<double>(settings.samples) / last_.samples;
    if (renders_ == 1)
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const bool at_pixel = i < 2 && !shows_patches(settings.reading);
            const double before = square(errors_[i].sampling),
                         fallen = (before - square(errors[i].sampling)) * times / (times - 1.0);
            by_samples_.push_back(at_pixel      ? std::numeric_limits<double>::infinity()
                                  : times > 1.0 ? std::clamp(fallen, 0.0, before) * last_.samples
                                                : 0.0);
        }
    if (renders_ > 1 && settings.rays > last_.rays && finest > last_.rays) {
        const double rays = static_cast<double>(last_.rays) / settings.rays,
                     cells = static_cast<double>(finest) / std::max(settings.rays, finest);
        by_cells_.resize(errors.size());
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const auto rest = [&](const PictureError& e, std::uint32_t samples) {
                return std::max(square(e.sampling) - by_samples_[i] / samples, 0.0);
            };
            const double before = rest(errors_[i], last_.samples),
                         fall = before > 0.0 ? rest(errors[i], settings.samples) / before : rays;
            const double part_before = std::clamp((fall - rays) / (cells - rays), 0.0, 1.0);
            by_cells_[i] = fall > 0.0 ? std::min(part_before * cells / fall, 1.0) : 0.0;
        }
    }
    if (renders_ > 0 && settings.patching.patches != last_.patching.patches) {
        errors_before_ = std::move(errors_);
        patches_before_ = last_.patching.patches;
    }
    errors_ = std::move(errors);
    last_ = settings;
    finest_ = finest;
    ++renders_;
}

WorstError FieldErrors::worst_of(const std::vector<PictureError>& errors) {
    WorstError worst;
    for (std::size_t i = 0; i < errors.size(); ++i)
        if (errors[i].all() > worst.error) worst = {errors[i].all(), i};
    return worst;
}

// The order of the discretisation error in the number of patches, from the last two numbers of patches: 1 for linear interpolation,
// 1/2 beside edges. It is taken as 1/2 before it is known, and as at least 1/4 if all surfaces are diffuse.
double FieldErrors::order_of(std::size_t i) const {
    if (errors_before_.empty() || errors_[i].discretisation == 0.0) return 0.5;
    const double seen = std::log(errors_before_[i].discretisation / errors_[i].discretisation) /
                        std::log(static_cast<double>(last_.patching.patches) / static_cast<double>(patches_before_));
    return std::clamp(seen, finest_ > 1 ? 0.0 : 0.25, 1.0);
}

WorstError FieldErrors::predict(const FieldSettings& settings) const {
    const auto fall = [](double from, double to) { return from / to; };
    const double samples = fall(last_.samples, settings.samples), rays = fall(last_.rays, settings.rays),
                 cells = fall(std::max(last_.rays, finest_), std::max(settings.rays, finest_)),
                 patches = fall(static_cast<double>(last_.patching.patches), static_cast<double>(settings.patching.patches));
    std::vector<PictureError> predicted;
    for (std::size_t i = 0; i < errors_.size(); ++i) {
        const double all = square(errors_[i].sampling), by_samples = by_samples_.empty() ? 0.0 : by_samples_[i] / last_.samples,
                     own = std::min(all, by_samples), part = part_of_cells(i);
        predicted.push_back({std::sqrt(own * samples + (all - own) * ((1.0 - part) * rays + part * cells)),
                             errors_[i].discretisation * std::pow(patches, order_of(i))});
    }
    return worst_of(predicted);
}

FieldSettings FieldErrors::grow(double target, double most_growth) const {
    FieldSettings settings = last_;
    const double part = 0.5 * square(target);  // half of the squared error for sampling, half for discretisation
    double samples = 1.0, rays = 1.0, patches = 1.0;
    const auto own_error = [&](std::size_t i) { return by_samples_.empty() ? 0.0 : by_samples_[i] / last_.samples; };
    for (std::size_t i = 0; i < errors_.size(); ++i) {
        const double all = square(errors_[i].sampling), own = std::min(all, own_error(i));
        const bool only_samples = own == all;
        samples = std::max(samples, own / (only_samples ? part : 0.5 * part));
    }
    settings.samples = neumann::grow(last_.samples, samples, most_.samples, most_growth);
    for (std::size_t i = 0; i < errors_.size(); ++i) {
        const double all = square(errors_[i].sampling), own = std::min(all, own_error(i));
        const double left = part - own_error(i) * last_.samples / settings.samples;
        rays = std::max(rays, (all - own) / std::max(left, 0.5 * part));
        if (!stands(i))
            patches = std::max(patches, std::pow(square(errors_[i].discretisation) / part, 0.5 / std::max(order_of(i), 0.5)));
    }
    settings.patching.patches =
        std::min(most_.patching.patches,
                 static_cast<std::size_t>(static_cast<double>(last_.patching.patches) * std::min(patches, most_growth)));
    settings.rays = neumann::grow(last_.rays, rays, most_.rays, most_growth);
    settings.light_samples = std::min(settings.rays, most_.light_samples);
    return settings;
}

}  // namespace neumann
