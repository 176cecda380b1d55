// T shared among processes: each has the rows of its own facets, with the same rays as in RayTable, and never those of others.
//
// A row lists slots: the process's own unknowns 0 … own() − 1, then the unknowns of others that its rays see, and a
// last one for nothing(). They take four bytes a ray, as in RayTable.
#pragma once

#include "core/base/large_array.h"
#include "core/base/processes/processes.h"
#include "operators/algebra/agreement.h"
#include "operators/fields/matrix/kept_rows.h"
#include "operators/fields/shared/ownership.h"
#include "operators/watch.h"

#include <span>

namespace neumann {

class SharedRays : public Agreement {
public:
    // All processes construct it together. Keeps references to the space and the processes. Throws Stopped on all
    // processes if `watch` stops one.
    SharedRays(const PatchSpace& space, std::uint32_t rays, std::uint64_t seed, Processes& processes, const Watch& watch = {},
               KeptRows* kept = nullptr);

    const PatchSpace& space() const { return *space_; }
    // The numbers of this process's facets; first_of(i) is the first own unknown of the i-th of them, and row(i) its rays.
    std::span<const std::uint32_t> facets() const { return facets_; }
    std::uint32_t first_of(std::size_t i) const { return first_of_facet_[i]; }
    std::span<const std::uint32_t> row(std::size_t i) const {
        return {slots_.get() + first_ray_[i], slots_.get() + first_ray_[i + 1]};
    }
    std::size_t rays() const { return first_ray_.back(); }

    std::uint32_t own() const { return own_; }
    std::uint32_t slots() const { return own_ + static_cast<std::uint32_t>(others_.size()) + 1; }
    std::uint32_t nothing() const { return slots() - 1; }
    // first() is the number of the first own unknown among all unknowns, number() that of a slot, and all() is how many there are.
    std::uint32_t first() const { return first_; }
    std::uint32_t number(std::uint32_t slot) const { return slot < own_ ? first_ + slot : others_[slot - own_]; }
    std::uint32_t all() const { return all_; }
    // The unknown of the space that belongs to a cell of this process's `facet`-th facet.
    std::uint32_t unknown(std::size_t facet, std::uint32_t cell) const { return space_->facets()[facets_[facet]].first + cell; }

    // The values at the slots, made from each process's values at its own unknowns; they stay until the next call.
    const double* fetch(const Vector& own) const;
    // Adds the values that each process has at its slots to the unknowns that the slots stand for.
    void add_up(const Vector& at_slots, Vector& own) const;
    // own_of() returns the values of a field of the space at the own unknowns. gathered() is the inverse: the field of
    // the space on process 0, and empty on others.
    Vector own_of(const Vector& field) const;
    Vector gathered(const Vector& own) const;

    void sum(std::span<double> values) const override { processes_->sum(values); }
    void largest(std::span<double> values) const override { processes_->largest(values); }
    using Agreement::largest;
    using Agreement::sum;

    // The processor time, in seconds, for which this process has traced.
    double seconds() const { return seconds_; }

private:
    void find_slots(const std::vector<std::uint32_t>& number, const std::vector<std::uint32_t>& first);

    const PatchSpace* space_;
    Processes* processes_;
    std::vector<std::uint32_t> facets_, first_of_facet_;
    std::vector<std::size_t> first_ray_;
    LargeArray<std::uint32_t> slots_;
    std::uint32_t own_ = 0, first_ = 0, all_ = 0;
    std::vector<std::uint32_t> others_;  // numbers of the other processes' unknowns that have slots, ascending
    std::vector<std::uint32_t> given_;   // own unknowns that others see, process by process
    Processes::Counts counts_;           // numbers of values that fetch() exchanges
    LargeArray<double> at_slots_;        // result of fetch(); read at random, which small pages make slower
    double seconds_ = 0.0;
};

}  // namespace neumann
