#include "core/sampling/sobol_sampler.h"

#include <boost/random/sobol.hpp>
#include <bit>

namespace neumann {

SobolPoints::SobolPoints(std::uint32_t size)
    : size_(size), log2_size_(static_cast<std::uint32_t>(std::countr_zero(size))), reversed_(static_cast<std::size_t>(size) * dimensions) {
    // Boost omits the point at the origin and returns the others in Gray code order, which is the same set if the size is a power of
    // two.
    boost::random::sobol engine(dimensions);
    for (std::uint32_t index = 1; index < size; ++index)
        for (std::uint32_t d = 0; d < dimensions; ++d) {
            const auto top = static_cast<std::uint32_t>(engine() >> 32);
            std::uint32_t bits = 0;
            for (int i = 0; i < 32; ++i) bits |= (top >> i & 1u) << (31 - i);
            reversed_[static_cast<std::size_t>(d) * size + index] = bits;
        }
}

}  // namespace neumann
