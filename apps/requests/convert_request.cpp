#include "apps/requests/convert_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

const Options<ConvertRequest>& convert_options() {
    using R = ConvertRequest;
    static const Options<R> options{
        "convert",
        "Write a scene of any format as a Mitsuba 3 file",
        {scene_option(&R::scene), option<R>("output", "FILE", "Mitsuba 3 file to write", &R::output, any_text()).alone().required(),
         definitions_option(&R::scene), lenient_option(&R::scene), quiet_option(&R::quiet, "Print errors only")}};
    return options;
}

}  // namespace neumann
