#include "apps/requests/replay_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

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
                   Form<std::array<std::int64_t, 2>>{[](const std::string& text) { return two_whole(text, ','); },
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
