// `neumann merge A B C -o DIR`: renders of one scene by different seeds, or parts of one, become one.
#pragma once

#include "apps/requests/render_request.h"
#include "apps/requests/requests_of_renders.h"
#include "operators/render/methods/saving.h"

namespace neumann {

// What would be asked for all samples at once, from what was asked for some of them.
RenderRequest asked_for_all(RenderRequest of_some, const RenderState& merged);

// Returns the exit code, 0. Throws InputError and RunError.
int merge_command(const MergeRequest& request);

}  // namespace neumann
