// `neumann merge A B C -o DIR`: merges renders of one scene by different seeds, or parts of one, into one.
#pragma once

#include "apps/requests/render_request.h"
#include "apps/requests/requests_of_renders.h"
#include "operators/render/methods/saving.h"

namespace neumann {

// The request for all samples at once, from the request for some of them.
RenderRequest request_for_all(RenderRequest of_some, const RenderState& merged);

// Returns the exit code, 0. Throws InputError and RunError.
int merge_command(const MergeRequest& request);

}  // namespace neumann
