// `neumann render --resume DIR`: the request of the render that began in DIR, and the options that may change.
#pragma once

#include "apps/requests/render_request.h"

namespace neumann {

// The request with which the render in `now.resume` began, with the limits, files and threads that are given now.
// Throws InputError if there is no such render, and if an option is given that differs from it and may not ("--resume:
// --seed is 2, and was 1").
RenderRequest resumed(const RenderRequest& now, const Given& given);

}  // namespace neumann
