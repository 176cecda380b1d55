#include "apps/requests/stress_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

const Options<StressRequest>& stress_options() {
    using R = StressRequest;
    static const Options<R> options{
        "stress",
        "Run all cases with known answers, also stiff and extreme ones, and print expected and measured values",
        {option<R>("only", "PATTERN", "Only cases whose name contains this, or matches it if it has * or ? in it", &R::only,
                   any_text()),
         flag<R>("list", "Print the names of the cases and where their answers come from, and run none", &R::list),
         seed_option<R>(&R::seed), threads_option(&R::threads), json_option(&R::json)}};
    return options;
}

}  // namespace neumann
