#include "operators/paths/metropolis/chain_batch.h"

#include "core/base/hot.h"

namespace neumann {

NEUMANN_HOT void ChainBatch::trace(std::span<std::uint64_t> counts, const NoObserver& none) { trace<NoObserver>(counts, none); }

}  // namespace neumann
