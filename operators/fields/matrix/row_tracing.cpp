#include "operators/fields/matrix/row_tracing.h"

#include "core/base/error.h"
#include "core/base/hot.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

namespace neumann {

namespace {

// If rows are kept, at least so many rays, and so many facets for each thread, are traced between two looks at the clock.
constexpr std::size_t rays_of_part = std::size_t{1} << 18, facets_of_thread = 8;
// The largest number of rays in a block of kept rows, 256 MB.
constexpr std::size_t rays_of_block = std::size_t{1} << 26;
// The number of kept rows that are traced again to see whether they are still the same.
constexpr std::size_t rows_compared = 16;

using SobolByRays = std::map<std::uint32_t, SobolPoints>;  // by number of rays

NEUMANN_HOT void trace_row(const RowsToTrace& rows, const SobolPoints& sobol, std::uint32_t number,
                           const std::function<void(const BlindRay&)>& on_blind_ray, std::uint32_t* row) {
    const PatchSpace& space = rows.space;
    const Facet& facet = space.facets()[number];
    const DirectionCells cells = facet.cells;
    const std::uint32_t each = sobol.size() / cells.size();
    std::vector<std::uint32_t> filled(cells.size());
    for_rays_of_facet(space, sobol, rows.seed, number, {.rough = rows.rough}, [&](const Vec2& u, const Sight& sight) {
        const std::uint32_t cell = cells.cell_of_square(u), place = cell * each + filled[cell]++;
        row[place] = sight.unknown;
        if (on_blind_ray && sight.hit && sight.unknown == space.nothing())
            on_blind_ray({number, place, facet.first + cell, 1.0 / each, sight});
    });
}

// Copies the kept rows to their places and returns the others, by their numbers among rows.facets.
std::vector<std::uint32_t> rows_to_trace(const RowsToTrace& rows, KeptRows* kept, std::uint32_t* seen) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<bool> is_there(rows.facets.size());
    if (kept) {
        const auto& facets = rows.space.facets();
        std::vector<std::uint32_t> place(facets.size(), none);  // by facet
        for (std::size_t i = 0; i < rows.facets.size(); ++i) place[rows.facets[i]] = static_cast<std::uint32_t>(i);
        kept->read([&](std::span<const std::uint32_t> kept_facets, std::span<const std::uint32_t> from) {
            std::size_t size = 0;
            for (const std::uint32_t f : kept_facets) size += f < facets.size() ? rays_of(facets[f], rows.rays) : from.size() + 1;
            if (size != from.size() || std::ranges::any_of(from, [&](auto u) { return u > rows.space.nothing(); })) return false;
            for (const std::uint32_t f : kept_facets) {
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

// Compares some kept rows, because other programs and processors may trace other rays.
void expect_same_rays(const RowsToTrace& rows, const SobolByRays& sobol, std::span<const std::uint32_t> to_trace,
                      const std::uint32_t* seen) {
    const std::size_t count = rows.facets.size(), step = std::max<std::size_t>(count / rows_compared, 1);
    for (std::size_t i = 0; i < count; i += step) {
        if (std::ranges::binary_search(to_trace, i)) continue;
        const std::span kept(seen + rows.first_ray[i], rows.first_ray[i + 1] - rows.first_ray[i]);
        std::vector<std::uint32_t> again(kept.size());
        trace_row(rows, sobol.at(static_cast<std::uint32_t>(kept.size())), rows.facets[i], {}, again.data());
        if (!std::ranges::equal(again, kept))
            throw KeptRowsError("the rays that are kept are not those that this program traces here; expected another folder");
    }
}

void keep_rows(const RowsToTrace& rows, std::span<const std::uint32_t> which, const std::uint32_t* seen, KeptRows& kept) {
    std::vector<std::uint32_t> facets;
    std::vector<std::span<const std::uint32_t>> pieces;
    std::size_t rays = 0;
    const auto keep = [&] {
        if (!facets.empty()) kept.keep(facets, pieces);
        facets.clear();
        pieces.clear();
        rays = 0;
    };
    for (const std::uint32_t i : which) {
        if (rays >= rays_of_block) keep();
        facets.push_back(rows.facets[i]);
        rays += rows.first_ray[i + 1] - rows.first_ray[i];
        const std::span row(seen + rows.first_ray[i], rows.first_ray[i + 1] - rows.first_ray[i]);
        if (!pieces.empty() && pieces.back().data() + pieces.back().size() == row.data())
            pieces.back() = {pieces.back().data(), pieces.back().size() + row.size()};
        else
            pieces.push_back(row);
    }
    keep();
}

// The number of parts in which the rows are traced, the same on all processes: after each part, these ask each other
// whether one was stopped.
std::size_t parts_of(const RowsToTrace& rows, const RowTracing& how, std::size_t to_trace) {
    if (!how.kept) return how.are_shared ? 16 : 1;
    const auto threads = static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency());
    const std::size_t rays = rows.facets.empty() ? 0 : rows.first_ray.back() / rows.facets.size() * to_trace,
                      parts = 1 + std::min(rays / rays_of_part, to_trace / (facets_of_thread * threads));
    return static_cast<std::size_t>(how.others.largest(static_cast<double>(parts)));
}

}  // namespace

void trace_rows(const RowsToTrace& rows, const RowTracing& how, std::uint32_t* seen) {
    if (how.kept && how.on_blind_ray) throw std::invalid_argument("trace_rows: kept rows tell of no blind rays");
    SobolByRays sobol;
    for (const std::uint32_t f : rows.facets) {
        const std::uint32_t n = rays_of(rows.space.facets()[f], rows.rays);
        sobol.try_emplace(n, n);
    }
    std::vector<std::uint32_t> which;
    std::exception_ptr wrong;
    try {
        which = rows_to_trace(rows, how.kept, seen);
        if (how.kept) expect_same_rays(rows, sobol, which, seen);
    } catch (const KeptRowsError&) {
        wrong = std::current_exception();
    }
    if (how.kept && how.others.any(wrong != nullptr) && !wrong)
        throw KeptRowsError("another process cannot use the rays that are kept");
    if (wrong) std::rethrow_exception(wrong);
    const std::size_t parts = parts_of(rows, how, which.size()), grain = std::max<std::size_t>(1, 1024 / rows.rays);
    std::size_t is_kept = 0;
    for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t begin = which.size() * part / parts, end = which.size() * (part + 1) / parts;
        std::atomic<bool> stopped = false;
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(begin, end, grain), [&](const auto& range) {
            if (stopped || how.watch.stop()) {
                stopped = true;
                return;
            }
            for (std::size_t k = range.begin(); k < range.end(); ++k) {
                const std::uint32_t i = which[k], f = rows.facets[i];
                trace_row(rows, sobol.at(rays_of(rows.space.facets()[f], rows.rays)), f, how.on_blind_ray,
                          seen + rows.first_ray[i]);
            }
        });
        const bool is_end = how.others.any(stopped);
        const std::size_t done = stopped ? begin : end;
        if (how.kept && (is_end || part + 1 == parts || how.kept->is_due())) {
            keep_rows(rows, std::span(which).subspan(is_kept, done - is_kept), seen, *how.kept);
            is_kept = done;
        }
        if (!is_end) continue;
        how.others.any(false);  // all processes have kept their rows before the exception of one ends them all
        throw Stopped();
    }
}

}  // namespace neumann
