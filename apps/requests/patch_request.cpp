#include "apps/requests/patch_request.h"

#include "apps/requests/shared_options.h"

#include <bit>

namespace neumann {

namespace {

Form<std::uint64_t> power_of_two(std::uint64_t most) {
    Form<std::uint64_t> form = whole_from(1, most);
    form.read = [whole = form.read](const std::string& text) {
        const auto n = whole(text);
        return n && std::has_single_bit(*n) ? n : std::nullopt;
    };
    form.wrong = not_a(fmt::format("a power of two from 1 to {}, such as 32 or 64", most));
    return form;
}

// The options of the patches, followed by `own`.
template <class R>
std::vector<Option<R>> with_patches(std::vector<Option<R>> own) {
    using P = PatchOptions;
    const std::vector<Option<P>> of_patches{
        scene_option(&P::scene),
        option<P>("patches", "N", "Approximate number of patches", &P::patches, whole_from(1, std::uint64_t{1} << 40))
            .showing_default(),
        option<P>("directions", "M", "Number of rays of T for each side of a patch, a power of two", &P::rays,
                  power_of_two(1 << 20))
            .showing_default(),
        seed_option<P>(&P::seed),
        threads_option(&P::threads),
        memory_option(&P::memory),
        definitions_option(&P::scene),
        lenient_option(&P::scene),
        option<P>("keep", "DIR",
                  "Folder that keeps the rays of T: they are taken from there if they were traced before, by this command until "
                  "it was cut off, or by another",
                  &P::keep, any_text()),
        checkpoint_option(&P::checkpoint, "T").only_with("keep"),
        quiet_option(&P::quiet, "Print no warnings"),
        json_option(&P::json)};
    std::vector<Option<R>> all;
    for (const Option<P>& o : of_patches) all.push_back(of_inner(o, &R::patches));
    all.insert(all.end(), own.begin(), own.end());
    return all;
}

template <class R>
Option<R> channel_option(std::string meaning) {
    return option<R>("channel", "NAME", std::move(meaning), &R::channel, one_of({"r", "g", "b"}));
}

template <class R>
Option<R> most_option(std::string meaning) {
    return option<R>("most", "N", std::move(meaning), &R::most, whole_from(1, 1000000000)).showing_default();
}

template <class R>
Option<R> petsc_option(std::string meaning) {
    Option<R> o = option<R>("petsc", "OPTIONS", std::move(meaning), &R::petsc, any_text()).meaning_without_value("");
    o.texts = [](const R& request) { return request.petsc ? std::vector{*request.petsc} : std::vector<std::string>(); };
    return o;
}

}  // namespace

const Options<SolveRequest>& solve_options() {
    using R = SolveRequest;
    static const Options<R> options{
        "solve", "Solve L = Le + K L by the series and by all other solvers, side by side",
        with_patches<R>(
            {channel_option<R>("r, g or b; default the one with the largest spectral radius"),
             option<R>("error", "REL", "Relative error at which a solver ends", &R::tolerance, above_zero()).showing_default(),
             most_option<R>("Applications of K that a solver may take"),
             flag<R>("csv", "Print every step of every solver as CSV", &R::csv).not_with("json"),
             petsc_option<R>("PETSc's solvers as well, with these options of theirs, or else a few kinds")})};
    return options;
}

const Options<SpectrumRequest>& spectrum_options() {
    using R = SpectrumRequest;
    static const Options<R> options{
        "spectrum", "Print norms and leading eigenvalues of K: whether the series converges, and how fast",
        with_patches<R>(
            {channel_option<R>("r, g or b; default all that differ"),
             option<R>("eigenvalues", "N", "Number of leading eigenvalues", &R::eigenvalues, whole_from(1, 100)).showing_default(),
             option<R>("time", "S", "Search for eigenvalues for at most this many seconds", &R::seconds, above_zero())
                 .showing_default(),
             most_option<R>("Applications of K that a search for eigenvalues may take"),
             flag<R>("csv", "Print the eigenvalues as CSV", &R::csv).not_with("json"),
             petsc_option<R>("SLEPc's leading eigenvalues as well, with these options of theirs")})};
    return options;
}

const Options<ExportRequest>& export_options() {
    using R = ExportRequest;
    static const Options<R> options{"export", "Write T, R and Le of a scene as files that SciPy reads",
                                    with_patches<R>({output_option(&R::output, "Folder for the files; default out/NAME-matrices"),
                                                     flag<R>("with-K", "Write K = R T too", &R::with_K)})};
    return options;
}

}  // namespace neumann
