#include "apps/requests/conform_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

const Options<ConformRequest>& conform_options() {
    using R = ConformRequest;
    static const Options<R> options{
        "conform",
        "Render a folder of Mitsuba's regression scenes and test it against their references",
        {option<R>("dir", "", "Folder that contains tests/scenes, the layout of Mitsuba's data", &R::folder, any_text())
             .alone()
             .required(),
         option<R>("only", "TEXT", "Only scenes whose folder/name contains this text", &R::only, any_text()),
         output_option(&R::output, "Folder for the pictures of rejected scenes").showing_default(),
         option<R>("samples", "N", "Samples of a scene, over all its pixels", &R::budget, whole_from(1, most_samples))
             .showing_default(),
         seed_option<R>(&R::seed), threads_option(&R::threads), json_option(&R::json)}};
    return options;
}

}  // namespace neumann
