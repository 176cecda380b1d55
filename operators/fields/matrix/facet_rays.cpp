#include "operators/fields/matrix/facet_rays.h"

#include "core/base/hot.h"

namespace neumann {

namespace {

// The square of directions has 2^log2_cells cells along each axis, which are sorted along a Morton curve.
constexpr std::uint32_t log2_cells = 3;

std::uint32_t place_on_curve(const Vec2& u) {
    const auto cell = [](double x) { return static_cast<std::uint32_t>(x * (1u << log2_cells)); };
    std::uint32_t place = 0;
    for (std::uint32_t bit = 0; bit < log2_cells; ++bit)
        place |= (cell(u.x) >> bit & 1u) << (2 * bit) | (cell(u.y) >> bit & 1u) << (2 * bit + 1);
    return place;
}

}  // namespace

NEUMANN_HOT std::vector<FacetRay> facet_rays(const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number) {
    constexpr std::uint32_t places = 1u << (2 * log2_cells);
    const std::uint32_t n = sobol.size();
    Sampler sampler(sobol, seed, number);
    std::vector<FacetRay> drawn(n), sorted(n);
    std::vector<std::uint8_t> place(n);
    std::array<std::uint32_t, places + 1> begin{};
    for (std::uint32_t i = 0; i < n; ++i) {
        sampler.start(i);
        drawn[i].direction = sampler.next2();
        drawn[i].point = sampler.next2();
        place[i] = static_cast<std::uint8_t>(place_on_curve(drawn[i].direction));
        ++begin[place[i] + 1u];
    }
    for (std::uint32_t p = 0; p < places; ++p) begin[p + 1] += begin[p];
    for (std::uint32_t i = 0; i < n; ++i) sorted[begin[place[i]]++] = drawn[i];
    return sorted;
}

}  // namespace neumann
