#include "apps/requests/unbounce_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

const Options<UnbounceRequest>& unbounce_options() {
    using R = UnbounceRequest;
    static const Options<R> options{
        "unbounce",
        "Take pictures of a scene under separate lights apart into bounces: the series backwards",
        {option<R>(
             "input", "", "Folder of OpenEXR files, a picture a light; or a scene, which is rendered so first",
             [](auto& r) -> auto& { return r.input.path; }, any_text())
             .alone()
             .required(),
         output_option(&R::output, "Folder for what is written; default INPUT/unbounced, of a scene out/NAME-lights"),
         option<R>("lights", "COLUMNSxROWS",
                   "Of a scene, the blocks of the projector's picture; default 8x8. Of a folder, how its lights are arranged, "
                   "which gives an estimate of the discretisation",
                   &R::lights, any_text()),
         option<R>("width", "PIXELS", "Of a scene, the width of the pictures in pixels; default that of its film, at most 64",
                   &R::width, whole_from(1, 65536)),
         option<R>("spp", "N", "Of a scene, samples a pixel, for all lights together", &R::samples,
                   whole_from(1, std::uint64_t{1} << 32))
             .showing_default(),
         bounces_option<R>(&R::bounces, "Last bounce with a picture of its own", 1, 1000).showing_default(),
         option<R>("regularisation", "ALPHA",
                   "Tikhonov's parameter, for a matrix whose columns have the largest value 1; default 0, or by the discrepancy "
                   "principle where the matrix cannot be told from a singular one",
                   &R::regularisation, real([](double x) { return x >= 0.0; }, "a number that is not below 0")),
         flag<R>("direct", "Take the direct light from pictures of it, in place of from the inverse", &R::direct),
         option<R>("picture", "FILE", "Unbounce this picture of the same scene, in place of that under all lights", &R::picture,
                   any_text()),
         option<R>("regions", "FILE",
                   "OpenEXR file with the number of the light, from 1, that each pixel belongs to, or 0 for none; default the "
                   "light under which it is brightest",
                   &R::regions, any_text()),
         seed_option<R>(&R::seed), threads_option(&R::threads), definitions_option(&R::input), lenient_option(&R::input),
         json_option(&R::json), quiet_option(&R::quiet, "Print errors only")}};
    return options;
}

}  // namespace neumann
