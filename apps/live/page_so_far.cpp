#include "apps/live/page_so_far.h"

#include "apps/output/pages/explorer_page.h"
#include "core/base/error.h"

namespace neumann {

void PageSoFar::see(const Rendering& so_far) {
    try {
        folder_.show("index.html", explorer_page(page_data(so_far, true)));
    } catch (const RunError&) {
        // A full disk is reported when the pictures are written.
    }
}

}  // namespace neumann
