// Whose rows of T are whose, where several processes compute a series together: those of some facets each. Vectors are whole on all
// of them: each process applies K to its rows and tells the others what comes out.
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
    // All rows, of a process alone. Keeps a reference to the space.
    explicit RowShare(const PatchSpace& space);
    // About as many rays of `rays` per facet for each of the processes, to which it keeps a reference; null: as above.
    RowShare(const PatchSpace& space, std::uint32_t rays, Processes* processes);

    const PatchSpace& space() const { return *space_; }
    // Facets [begin(), end()) are this process's.
    std::uint32_t begin() const { return first_[rank_]; }
    std::uint32_t end() const { return first_[rank_ + 1]; }
    bool is_shared() const { return processes_ != nullptr; }
    bool is_first() const { return rank_ == 0; }
    std::size_t rank() const { return rank_; }
    // Of n equal parts of something, process p has [cut[p], cut[p + 1]).
    std::vector<std::size_t> cut(std::size_t n) const;
    // As light_vector.h asks for them; refers to this object.
    SomeFacets facets() const { return processes_ ? SomeFacets(numbers_) : SomeFacets(); }

    // Of values at all unknowns, gives all processes those of the process whose facet it is. For all of them together.
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

    // Of values first[p] … first[p + 1] − 1, which process p knows, the same; only if the rows are shared.
    void complete(std::span<double> values, std::span<const std::size_t> first) const { processes_->complete(values, first); }

private:
    void complete(std::span<double> values, std::size_t channels) const;

    const PatchSpace* space_;
    Processes* processes_ = nullptr;
    std::size_t rank_ = 0;
    std::vector<std::uint32_t> first_;    // facet of each process, and their number
    std::vector<std::uint32_t> numbers_;  // begin(), begin() + 1, …
};

}  // namespace neumann
