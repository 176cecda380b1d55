#include "apps/requests/compare_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

const Options<CompareRequest>& compare_options() {
    using R = CompareRequest;
    static const Options<R> options{
        "compare",
        "Print error metrics between two pictures or two output folders; the second is the reference",
        {option<R>("a", "", "Picture or folder", &R::a, any_text()).alone().required(),
         option<R>("b", "", "Reference picture or folder", &R::b, any_text()).alone().required(),
         option<R>("more", "", "With -o: further folders on the page; the figures are of A and B", &R::more, any_text()).alone(),
         output_option(&R::output, "For folders: write into this folder a page that shows all, bounce by bounce"),
         flag<R>("flip",
                 "HDR-FLIP besides, how different the pictures look; it takes about a second for a picture of 512 x 512 pixels",
                 &R::flip),
         json_option(&R::json)}};
    return options;
}

}  // namespace neumann
