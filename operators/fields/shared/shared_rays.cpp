#include "operators/fields/shared/shared_rays.h"

#include "operators/fields/matrix/row_tracing.h"

#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <ctime>
#include <utility>

namespace neumann {

namespace {

std::span<double> values_of(Vector& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }
std::span<const double> values_of(const Vector& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }

}  // namespace

SharedRays::SharedRays(const PatchSpace& space, std::uint32_t rays, std::uint64_t seed, Processes& processes, const Watch& watch,
                       KeptRows* kept)
    : space_(&space), processes_(&processes) {
    Ownership shared = share_out(space, rays, processes.size(), processes.rank());
    facets_ = std::move(shared.facets);
    const auto rank = static_cast<std::size_t>(processes.rank());
    first_ = shared.first[rank];
    own_ = shared.first[rank + 1] - first_;
    all_ = shared.first.back();
    first_ray_.push_back(0);
    std::uint32_t unknown = 0;
    for (const std::uint32_t f : facets_) {
        first_of_facet_.push_back(unknown);
        unknown += space.facets()[f].cells.size();
        first_ray_.push_back(first_ray_.back() + rays_of(space.facets()[f], rays));
    }
    const std::clock_t begin = std::clock();
    slots_ = make_large_array<std::uint32_t>(first_ray_.back());
    trace_rows({space, rays, seed, facets_, first_ray_}, {watch, *this, true, {}, kept}, slots_.get());
    seconds_ = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    find_slots(shared.number, shared.first);
}

void SharedRays::find_slots(const std::vector<std::uint32_t>& number, const std::vector<std::uint32_t>& first) {
    constexpr std::uint32_t unseen = 0, seen = 1;
    std::vector<std::uint32_t> slot(std::size_t{all_} + 1, unseen);  // by number
    const std::span<std::uint32_t> rays(slots_.get(), first_ray_.back());
    for (std::uint32_t& ray : rays) {
        ray = ray == space_->nothing() ? all_ : number[ray];
        slot[ray] = seen;
    }
    std::vector<int> wanted(first.size() - 1);
    for (std::size_t p = 0; p + 1 < first.size(); ++p)
        for (std::uint32_t n = first[p]; n < first[p + 1]; ++n) {
            if (n - first_ < own_ || slot[n] == unseen) continue;
            others_.push_back(n);
            ++wanted[p];
        }
    for (std::uint32_t u = 0; u < own_; ++u) slot[first_ + u] = u;
    for (std::size_t i = 0; i < others_.size(); ++i) slot[others_[i]] = own_ + static_cast<std::uint32_t>(i);
    slot[all_] = nothing();
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, rays.size()), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) rays[i] = slot[rays[i]];
    });

    const Processes::Counts requests = processes_->counts(wanted);
    std::size_t size = 0;
    for (const int n : requests.taken) size += static_cast<std::size_t>(n);
    given_.resize(size);
    processes_->exchange(others_, given_, requests);
    for (std::uint32_t& u : given_) u -= first_;
    counts_ = {requests.taken, requests.given};
    at_slots_ = make_large_array<double>(slots());
}

const double* SharedRays::fetch(const Vector& own) const {
    Vector given(static_cast<Eigen::Index>(given_.size()));
    for (std::size_t i = 0; i < given_.size(); ++i) given[static_cast<Eigen::Index>(i)] = own[given_[i]];
    std::copy(own.begin(), own.end(), at_slots_.get());
    at_slots_[nothing()] = 0.0;
    processes_->exchange(values_of(std::as_const(given)), std::span(at_slots_.get() + own_, others_.size()), counts_);
    return at_slots_.get();
}

void SharedRays::add_up(const Vector& at_slots, Vector& own) const {
    Vector taken(static_cast<Eigen::Index>(given_.size()));
    processes_->exchange(std::span<const double>(at_slots.data() + own_, others_.size()), values_of(taken),
                         {counts_.taken, counts_.given});
    own = at_slots.head(own_);
    for (std::size_t i = 0; i < given_.size(); ++i) own[given_[i]] += taken[static_cast<Eigen::Index>(i)];
}

Vector SharedRays::own_of(const Vector& field) const {
    Vector own(own_);
    for (std::size_t i = 0; i < facets_.size(); ++i) {
        const std::uint32_t cells = space_->facets()[facets_[i]].cells.size();
        own.segment(first_of(i), cells) = field.segment(unknown(i, 0), cells);
    }
    return own;
}

Vector SharedRays::gathered(const Vector& own) const {
    std::vector<int> to_first(static_cast<std::size_t>(processes_->size()));
    to_first[0] = static_cast<int>(own_);
    const Processes::Counts counts = processes_->counts(to_first);
    std::vector<std::uint32_t> unknowns, places(processes_->rank() == 0 ? all_ : 0);
    for (std::size_t i = 0; i < facets_.size(); ++i)
        for (std::uint32_t cell = 0; cell < space_->facets()[facets_[i]].cells.size(); ++cell) unknowns.push_back(unknown(i, cell));
    Vector values(static_cast<Eigen::Index>(places.size())), field(values.size());
    processes_->exchange(unknowns, places, counts);
    processes_->exchange(values_of(own), values_of(values), counts);
    for (std::size_t i = 0; i < places.size(); ++i) field[places[i]] = values[static_cast<Eigen::Index>(i)];
    return field;
}

}  // namespace neumann
