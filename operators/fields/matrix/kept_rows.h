// Rows of T that outlive the process which traced them.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace neumann {

struct TracedSettings;

// Thrown if kept rows cannot be used; the message names them.
class KeptRowsError : public InputError {
public:
    using InputError::InputError;
};

// The kept rows of one ray table. A block is some facets and their rows, one after the other.
class KeptRows {
public:
    virtual ~KeptRows() = default;

    // Hands over each block. `take` returns false if the block does not belong to this table. Throws KeptRowsError.
    virtual void read(
        const std::function<bool(std::span<const std::uint32_t> facets, std::span<const std::uint32_t> seen)>& take) = 0;
    // Whether it is time to keep the rows that were traced since the last time.
    virtual bool is_due() const = 0;
    // Keeps the rows of some facets, which come in pieces.
    virtual void keep(std::span<const std::uint32_t> facets, const std::vector<std::span<const std::uint32_t>>& seen) = 0;
};

class RowStore {
public:
    virtual ~RowStore() = default;
    virtual std::unique_ptr<KeptRows> rows_of(const TracedSettings& settings) = 0;
};

}  // namespace neumann
