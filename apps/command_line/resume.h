// `neumann render --resume DIR`: what was asked of the render that began there, and what may change.
#pragma once

#include "apps/requests/render_request.h"

namespace neumann {

// The request with which the render in `now.resume` began, with the limits, the files and the threads that are given now. Throws
// InputError if there is no such render, and if another option is given that it did not have ("--resume: --seed is 2, and was 1").
RenderRequest resumed(const RenderRequest& now, const Given& given);

}  // namespace neumann
