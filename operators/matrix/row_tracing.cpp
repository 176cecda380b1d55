#include "operators/matrix/row_tracing.h"

#include "core/base/hot.h"

#include <oneapi/tbb/parallel_for.h>
#include <atomic>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

namespace neumann {

namespace {

// So many are traced between one look at the clock and the next, and before what was traced can be lost.
constexpr std::size_t rays_of_part = std::size_t{1} << 18;

NEUMANN_HOT void trace_row(const PatchSpace& space, const SobolPoints& sobol, std::uint64_t seed, std::uint32_t number,
                           const std::function<void(const BlindRay&)>& on_blind_ray, std::uint32_t* row) {
    const Facet& facet = space.facets()[number];
    const DirectionCells cells = facet.cells;
    const std::uint32_t each = sobol.size() / cells.size();
    std::vector<std::uint32_t> filled(cells.size());
    for_rays_of_facet(space, sobol, seed, number, [&](const Vec2& u, const Sight& sight) {
        const std::uint32_t cell = cells.cell_of_square(u), place = cell * each + filled[cell]++;
        row[place] = sight.unknown;
        if (on_blind_ray && sight.hit && sight.unknown == space.nothing())
            on_blind_ray({number, place, facet.first + cell, 1.0 / each, sight});
    });
}

// Puts the rows that are kept in their places and returns the others, by their numbers among rows.facets.
std::vector<std::uint32_t> rows_to_trace(const RowsToTrace& rows, KeptRows* kept, std::uint32_t* seen) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<bool> is_there(rows.facets.size());
    if (kept) {
        const auto& facets = rows.space.facets();
        std::vector<std::uint32_t> place(facets.size(), none);  // by facet
        for (std::size_t i = 0; i < rows.facets.size(); ++i) place[rows.facets[i]] = static_cast<std::uint32_t>(i);
        kept->read([&](std::span<const std::uint32_t> of, std::span<const std::uint32_t> from) {
            std::size_t size = 0;
            for (const std::uint32_t f : of) size += f < facets.size() ? rays_of(facets[f], rows.rays) : from.size() + 1;
            if (size != from.size() || std::ranges::any_of(from, [&](auto u) { return u > rows.space.nothing(); })) return false;
            for (const std::uint32_t f : of) {
                const std::uint32_t n = rays_of(facets[f], rows.rays);
                if (place[f] != none) {
                    std::copy_n(from.begin(), n, seen + rows.first_ray[place[f]]);
                    is_there[place[f]] = true;
                }
                from = from.subspan(n);
            }
            return true;
        });
    }
    std::vector<std::uint32_t> others;
    for (std::size_t i = 0; i < rows.facets.size(); ++i)
        if (!is_there[i]) others.push_back(static_cast<std::uint32_t>(i));
    return others;
}

void keep_rows(const RowsToTrace& rows, std::span<const std::uint32_t> which, const std::uint32_t* seen, KeptRows& kept) {
    if (which.empty()) return;
    std::vector<std::uint32_t> facets;
    std::vector<std::span<const std::uint32_t>> pieces;
    for (const std::uint32_t i : which) {
        facets.push_back(rows.facets[i]);
        const std::span row(seen + rows.first_ray[i], rows.first_ray[i + 1] - rows.first_ray[i]);
        if (!pieces.empty() && pieces.back().data() + pieces.back().size() == row.data())
            pieces.back() = {pieces.back().data(), pieces.back().size() + row.size()};
        else
            pieces.push_back(row);
    }
    kept.keep(facets, pieces);
}

}  // namespace

void trace_rows(const RowsToTrace& rows, const RowTracing& how, std::uint32_t* seen) {
    if (how.kept && how.on_blind_ray) throw std::invalid_argument("trace_rows: kept rows tell of no blind rays");
    std::map<std::uint32_t, SobolPoints> sobol;  // by number of rays
    for (const std::uint32_t f : rows.facets) {
        const std::uint32_t n = rays_of(rows.space.facets()[f], rows.rays);
        sobol.try_emplace(n, n);
    }
    const std::vector<std::uint32_t> which = rows_to_trace(rows, how.kept, seen);
    // All processes ask each other equally often whether one was stopped.
    const double most = how.others.largest(static_cast<double>(rows.first_ray.back()));
    const std::size_t parts = 1 + static_cast<std::size_t>(most) / rays_of_part;
    std::size_t is_kept = 0;
    for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t begin = which.size() * part / parts, end = which.size() * (part + 1) / parts;
        std::atomic<bool> stopped = false;
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(begin, end, 16), [&](const auto& range) {
            if (stopped || how.watch.stop()) {
                stopped = true;
                return;
            }
            for (std::size_t k = range.begin(); k < range.end(); ++k) {
                const std::uint32_t i = which[k], f = rows.facets[i];
                trace_row(rows.space, sobol.at(rays_of(rows.space.facets()[f], rows.rays)), rows.seed, f, how.on_blind_ray,
                          seen + rows.first_ray[i]);
            }
        });
        const bool is_end = how.others.any(stopped);
        const std::size_t done = stopped ? begin : end;
        if (how.kept && (is_end || part + 1 == parts || how.kept->is_due())) {
            keep_rows(rows, std::span(which).subspan(is_kept, done - is_kept), seen, *how.kept);
            is_kept = done;
        }
        if (is_end) throw Stopped();
    }
}

}  // namespace neumann
