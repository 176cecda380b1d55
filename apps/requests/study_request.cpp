#include "apps/requests/study_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

namespace {

// "4" and "1-4".
Form<StudiedBounces> studied_bounces() {
    const auto whole = whole_from<int>(0, 100000);
    const auto read = [=](const std::string& text) -> std::optional<StudiedBounces> {
        const std::size_t dash = text.find('-');
        const auto last = whole.read(dash == std::string::npos ? text : text.substr(dash + 1));
        if (!last || dash == std::string::npos) return last ? std::optional(StudiedBounces{{}, *last}) : std::nullopt;
        const auto first = whole.read(text.substr(0, dash));
        return first && *first <= *last ? std::optional(StudiedBounces{first, *last}) : std::nullopt;
    };
    const auto print = [](const StudiedBounces& bounces) {
        return bounces.first ? fmt::format("{}-{}", *bounces.first, bounces.last) : fmt::format("{}", bounces.last);
    };
    return {read, print, not_a("the last bounce, from 0 to 100000, or the first and the last, as in 1-4")};
}

}  // namespace

const Options<StudyRequest>& study_options() {
    using R = StudyRequest;
    static const Options<R> options{
        "study",
        "Compare methods: error against time, bounce by bounce",
        {scene_option(&R::scene),
         option<R>("methods", "A,B,...",
                   "Methods, each with options of render after colons: walk,walk:direct=light:sampler=independent,matrix; default "
                   "all that can do the scene",
                   &R::methods, any_text())
             .with_commas(),
         output_option(&R::output, "Folder for tables and page; default out/NAME-study"),
         option<R>("reference", "R",
                   "The reference: the folder of an earlier render, values:A,B,... for bounces of one grey value each, or an "
                   "unbiased method, whose pictures are made with a seed of their own and kept in the cache; default walk or "
                   "bidirectional, whichever has less variance for as many rays in the bounce where it is worst",
                   &R::reference, any_text()),
         option<R>("reference-spp", "N",
                   "Samples a pixel of a reference that is made; default 16 times those of walk at the largest budget",
                   &R::reference_samples, whole_from(4, most_samples)),
         option<R>("budgets", "S,S,...", "Seconds of a run, in ascending order; chosen automatically by default", &R::budgets,
                   above_zero())
             .with_commas(),
         option<R>("samples", "N,N,...", "Instead of --budgets: samples a pixel of a run, in ascending order", &R::samples,
                   whole_from(1, most_samples))
             .with_commas(),
         option<R>("repeats", "N", "Runs of each method at each budget, with other seeds", &R::repeats, whole_from(1, 100000))
             .showing_default(),
         option<R>("interval", "REL",
                   "In place of --repeats: as many as it takes for the RMSE of the sum to have a 95% interval of at most ± REL of "
                   "itself, as short runs foretell",
                   &R::interval, above_zero())
             .not_with("repeats"),
         option<R>("bounces", "BOUNCES",
                   "The last bounce that is compared; or the first and the last, as in 1-4, on which the verdict then is: without "
                   "bounce 0, whose error is that of the lamps' edges",
                   &R::bounces, studied_bounces())
             .with_letter('n'),
         option<R>("error", "REL", "Relative RMSE for the time to a given error; default the smallest that all methods reach",
                   &R::error, above_zero()),
         option<R>("crop", "X,Y,WIDTH,HEIGHT",
                   "A part of the picture that the page shows of every method, in pixels from the top left; may be given several "
                   "times. Three more are chosen where methods differ most",
                   &R::crops, any_text()),
         checkpoint_option(&R::checkpoint, "run"),
         flag<R>("resume", "Continue a study that was cut off", &R::resume).of_this_run(),
         seed_option<R>(&R::seed, "Seed from which the seeds of all runs are derived"),
         threads_option(&R::threads),
         definitions_option(&R::scene),
         lenient_option(&R::scene),
         quiet_option(&R::quiet),
         json_option(&R::json, "Print study.json")}};
    return options;
}

}  // namespace neumann
