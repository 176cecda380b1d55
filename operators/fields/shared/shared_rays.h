// T shared out: a process has the rows of its own facets, with the same rays as RayTable, and never those of others.
//
// A row lists slots: the process's own unknowns 0 … own() − 1, then those that its rays see and others have, and a last one for
// what is nothing. Four bytes a ray, as in RayTable.
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
    // For all processes together. Keeps references to the space and the processes. Throws Stopped on all if `watch` stops one.
    SharedRays(const PatchSpace& space, std::uint32_t rays, std::uint64_t seed, Processes& processes, const Watch& watch = {},
               KeptRows* kept = nullptr);

    const PatchSpace& space() const { return *space_; }
    // The numbers of this process's facets, and for the i-th of them its first unknown, and its rays.
    std::span<const std::uint32_t> facets() const { return facets_; }
    std::uint32_t first_of(std::size_t i) const { return first_of_facet_[i]; }
    std::span<const std::uint32_t> row(std::size_t i) const {
        return {slots_.get() + first_ray_[i], slots_.get() + first_ray_[i + 1]};
    }
    std::size_t rays() const { return first_ray_.back(); }

    std::uint32_t own() const { return own_; }
    std::uint32_t slots() const { return own_ + static_cast<std::uint32_t>(others_.size()) + 1; }
    std::uint32_t nothing() const { return slots() - 1; }
    // Numbers among all unknowns: of the first own one, of a slot, of all.
    std::uint32_t first() const { return first_; }
    std::uint32_t number(std::uint32_t slot) const { return slot < own_ ? first_ + slot : others_[slot - own_]; }
    std::uint32_t all() const { return all_; }
    // The unknown of the space for each own one.
    std::uint32_t unknown(std::size_t facet, std::uint32_t cell) const { return space_->facets()[facets_[facet]].first + cell; }

    // Values at the slots, from each process's values at its own unknowns; they stay until the next call.
    const double* fetch(const Vector& own) const;
    // Adds what each process has at its slots at the unknowns that they stand for.
    void add_up(const Vector& at_slots, Vector& own) const;
    // Of a field of the space, the values at the own unknowns; and the other way, on process 0, elsewhere empty.
    Vector own_of(const Vector& field) const;
    Vector gathered(const Vector& own) const;

    void sum(std::span<double> values) const override { processes_->sum(values); }
    void largest(std::span<double> values) const override { processes_->largest(values); }
    using Agreement::largest;
    using Agreement::sum;

    // Processor time that this process has traced for.
    double seconds() const { return seconds_; }

private:
    void find_slots(const std::vector<std::uint32_t>& number, const std::vector<std::uint32_t>& first);

    const PatchSpace* space_;
    Processes* processes_;
    std::vector<std::uint32_t> facets_, first_of_facet_;
    std::vector<std::size_t> first_ray_;
    LargeArray<std::uint32_t> slots_;
    std::uint32_t own_ = 0, first_ = 0, all_ = 0;
    std::vector<std::uint32_t> others_;  // the numbers of the unknowns of others at slots, ascending
    std::vector<std::uint32_t> given_;   // own unknowns that others see, process by process
    Processes::Counts counts_;           // of fetch()
    LargeArray<double> at_slots_;        // of fetch(); read at random, which small pages make slower
    double seconds_ = 0.0;
};

}  // namespace neumann
