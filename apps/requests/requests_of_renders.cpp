#include "apps/requests/requests_of_renders.h"

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

const Options<PageRequest>& page_options() {
    using R = PageRequest;
    static const Options<R> options{
        "page",
        "Make page and slides of a render anew, with the paths of pixels",
        {option<R>("dir", "", "Folder of a render", &R::folder, any_text()).alone().required(), paths_option(&R::paths),
         option<R>("files", fmt::format("WHAT:{{{}}}", fmt::join(page_file_groups(), ",")), "What is made; default all of these",
                   &R::files, one_of(page_file_groups()))
             .with_commas(),
         option<R>("theme", "THEME:{dark,white}", "What slides and strips are on: dark or white; default that of the render",
                   &R::theme, one_of({"dark", "white"})),
         threads_option(&R::threads), quiet_option(&R::quiet)}};
    return options;
}

const Options<ReplayRequest>& replay_options() {
    using R = ReplayRequest;
    static const Options<R> options{
        "replay",
        "Trace one sample of a render again, and show its path",
        {option<R>("dir", "", "Folder of a render", &R::folder, any_text()).alone().required(),
         option<R>("n", "", "Number of a sample in the health report in run.json, counted from 1", &R::number,
                   whole_from(1, 1'000'000))
             .alone(),
         option<R>("pixel", "X,Y", "For any other sample: its pixel", &R::pixel,
                   Form<std::array<int, 2>>{[](const std::string& text) { return two_whole(text, ','); },
                                            [](const auto& p) { return fmt::format("{},{}", p[0], p[1]); },
                                            not_a("two whole numbers with a comma between, such as 19,160")})
             .not_with("n")
             .only_with("sample"),
         option<R>("sample", "S", "Number of the sample in its pixel, counted from 0", &R::sample, whole_from(0, most_samples))
             .only_with("pixel"),
         json_option(&R::json)}};
    return options;
}

}  // namespace neumann
