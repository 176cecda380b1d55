#include "apps/requests/blame_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

const Options<BlameRequest>& blame_options() {
    using R = BlameRequest;
    static const Options<R> options{
        "blame",
        "Say which bounce of another renderer's pictures is wrong, and in what way",
        {option<R>("pictures", "PICTURES... SCENE",
                   "Pictures, one a depth limit or one a bounce, or a folder of them; then the scene", &R::pictures, any_text())
             .alone()
             .required(),
         option<R>("again", "PICTURES", "The same pictures with another seed: a folder, or one by one", &R::again, any_text()),
         option<R>("counts", "HOW", "How depths are counted: mitsuba, pbrt, cycles or bounces; default by the data", &R::counts,
                   any_text()),
         option<R>("channels", "NAME",
                   "The layer of the files that holds the picture: what is before .R, .G, .B, or the end of that; RGB for "
                   "channels without a layer. By default these, or the only layer, or Combined or beauty",
                   &R::channels, any_text()),
         option<R>("time", "SECONDS", "Seconds for our own pictures; default 20", &R::seconds, above_zero()),
         option<R>("spp", "N", "Samples a pixel for our own pictures, in place of --time", &R::samples,
                   whole_from(1, std::uint64_t{1} << 32)),
         seed_option<R>(&R::seed), threads_option(&R::threads), definitions_option(&R::scene), lenient_option(&R::scene),
         output_option(&R::output, "Write into this folder a page with the verdict and the differences by bounce"),
         json_option(&R::json)}};
    return options;
}

}  // namespace neumann
