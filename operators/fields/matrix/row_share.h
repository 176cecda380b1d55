// The division of the rows of T among processes that compute a series together: each has the rows of some facets. All
// processes hold whole vectors: each applies K to its rows and sends the results to the others.
#pragma once

#include "core/base/processes/processes.h"
#include "operators/algebra/agreement.h"
#include "operators/fields/matrix/patch_field.h"
#include "operators/fields/matrix/some_facets.h"
#include "operators/fields/patches/patch_space.h"

#include <vector>

namespace neumann {

class RowShare : public Agreement {
public:
    // All rows belong to one process. Keeps a reference to the space.
    explicit RowShare(const PatchSpace& space);
    // Gives each of the processes about as many rays, with `rays` per facet; keeps a reference to `processes`. If that
    // is null, all rows belong to one process.
    RowShare(const PatchSpace& space, std::uint32_t rays, Processes* processes);

    const PatchSpace& space() const { return *space_; }
    // This process has the facets [begin(), end()).
    std::uint32_t begin() const { return first_[rank_]; }
    std::uint32_t end() const { return first_[rank_ + 1]; }
    bool is_shared() const { return processes_ != nullptr; }
    bool is_first() const { return rank_ == 0; }
    std::size_t rank() const { return rank_; }
    // If something has n equal parts, process p has the parts [cut[p], cut[p + 1]).
    std::vector<std::size_t> cut(std::size_t n) const;
    // The facets of this process as light_vector.h takes them; they refer to this object.
    SomeFacets facets() const { return processes_ ? SomeFacets(numbers_) : SomeFacets(); }

    // Gives all processes the values at all unknowns, each from the process that has the facet. All processes must call
    // it together.
    template <class Side, int C>
    void complete(PatchField<Side, C>& field) const {
        if (processes_) complete({field.data(), static_cast<std::size_t>(field.size())}, C);
    }

    void sum(std::span<double> values) const override {
        if (processes_) processes_->sum(values);
    }
    void largest(std::span<double> values) const override {
        if (processes_) processes_->largest(values);
    }
    using Agreement::largest;
    using Agreement::sum;

    // Gives all processes the values first[p] … first[p + 1] − 1, which process p knows; only if the rows are shared.
    void complete(std::span<double> values, std::span<const std::size_t> first) const { processes_->complete(values, first); }

private:
    void complete(std::span<double> values, std::size_t channels) const;

    const PatchSpace* space_;
    Processes* processes_ = nullptr;
    std::size_t rank_ = 0;
    std::vector<std::uint32_t> first_;    // first facet of each process, and the number of facets
    std::vector<std::uint32_t> numbers_;  // begin(), begin() + 1, …
};

}  // namespace neumann
