// The kernel of T: the mean radiance along the rays of a cell of directions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace neumann {

// The channels of an unknown in SIMD registers.
template <int C>
struct Lanes;
template <>
struct Lanes<1> {
    using Type = double;
};
template <>
struct Lanes<4> {
    typedef double Type __attribute__((vector_size(32), may_alias));
};

// The mean radiance along `rays`. Four partial sums hide the latency of additions.
template <int C>
inline void ray_mean(const double* source, std::span<const std::uint32_t> rays, typename Lanes<C>::Type& result) {
    using Lane = typename Lanes<C>::Type;
    const auto at = [&](std::uint32_t unknown) -> const Lane& {
        return *reinterpret_cast<const Lane*>(source + std::size_t{C} * unknown);
    };
    Lane sum[4] = {};
    std::size_t i = 0;
    for (; i + 4 <= rays.size(); i += 4)
        for (std::size_t k = 0; k < 4; ++k) sum[k] += at(rays[i + k]);
    for (; i < rays.size(); ++i) sum[0] += at(rays[i]);
    result = ((sum[0] + sum[1]) + (sum[2] + sum[3])) / static_cast<double>(rays.size());
}

}  // namespace neumann
