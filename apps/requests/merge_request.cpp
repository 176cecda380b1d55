#include "apps/requests/merge_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

const Options<MergeRequest>& merge_options() {
    using R = MergeRequest;
    static const Options<R> options{
        "merge",
        "Make one render of several: of other seeds, or of parts of the samples",
        {option<R>("dir", "DIR...", "Folders of renders of one scene that kept their samples", &R::folders, any_text())
             .alone()
             .required()
             .counting(2, 1 << 20),
         output_option(&R::output, "Folder for the pictures and tables of all together").required(),
         option<R>("scene", "SCENE", "The scene, if it has moved since", &R::scene, any_text()), files_option(&R::files),
         theme_option(&R::theme), threads_option(&R::threads), quiet_option(&R::quiet)}};
    return options;
}

}  // namespace neumann
