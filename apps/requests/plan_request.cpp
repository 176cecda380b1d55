#include "apps/requests/plan_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

const Options<PlanRequest>& plan_options() {
    using R = PlanRequest;
    static const Options<R> options{
        "plan",
        "Print what a scene needs of the machinery, what is left out, and why",
        {scene_option(&R::scene), definitions_option(&R::scene), lenient_option(&R::scene), json_option(&R::json)}};
    return options;
}

}  // namespace neumann
