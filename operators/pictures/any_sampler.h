// A sampler whose kind is chosen at run time, for code that need not be fast.
#pragma once

#include "core/sampling/independent_sampler.h"
#include "core/sampling/sobol_sampler.h"
#include "core/scene/scene.h"

#include <variant>

namespace neumann {

class AnySampler {
public:
    AnySampler(SamplerKind kind, const SobolPoints& points, std::uint64_t seed, std::uint32_t pixel)
        : sampler_(IndependentSampler(seed, pixel)) {
        if (kind == SamplerKind::sobol) sampler_ = SobolSampler(points, seed, pixel);
    }
    void start(std::uint64_t sample) {
        std::visit([&](auto& s) { s.start(sample); }, sampler_);
    }
    double next() {
        return std::visit([](auto& s) { return s.next(); }, sampler_);
    }
    Vec2 next2() {
        return std::visit([](auto& s) { return s.next2(); }, sampler_);
    }

private:
    std::variant<SobolSampler, IndependentSampler> sampler_;
};

// Makes a sampler of a static type, or an AnySampler of the given kind.
template <class Sampler>
Sampler make_sampler(SamplerKind kind, const SobolPoints& points, std::uint64_t seed, std::uint32_t pixel) {
    if constexpr (std::is_same_v<Sampler, AnySampler>)
        return AnySampler(kind, points, seed, pixel);
    else if constexpr (std::is_same_v<Sampler, SobolSampler>)
        return SobolSampler(points, seed, pixel);
    else
        return IndependentSampler(seed, pixel);
}

}  // namespace neumann
