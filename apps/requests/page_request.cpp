#include "apps/requests/page_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

const Options<PageRequest>& page_options() {
    using R = PageRequest;
    static const Options<R> options{
        "page",
        "Make page, slides and tables of a render anew, with the paths of pixels",
        {option<R>("dir", "", "Folder of a render", &R::folder, any_text()).alone().required(), paths_option(&R::paths),
         option<R>("files", fmt::format("WHAT:{{{}}}", fmt::join(page_file_groups(), ",")), "What is made; default all of these",
                   &R::files, one_of(page_file_groups()))
             .with_commas(),
         option<R>("theme", "THEME:{dark,white}", "What slides and strips are on: dark or white; default that of the render",
                   &R::theme, one_of({"dark", "white"})),
         threads_option(&R::threads), quiet_option(&R::quiet)}};
    return options;
}

}  // namespace neumann
