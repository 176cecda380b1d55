#include "apps/requests/strip_request.h"

#include "apps/requests/shared_options.h"

#include <algorithm>

namespace neumann {

namespace {

// The options of a render that a strip does not have: of what is written, and of how one render goes on.
const std::vector<std::string> of_one_render{"output",     "tail",   "error", "reference", "files", "paths", "part",
                                             "checkpoint", "resume", "live",  "tev",       "ways",  "json"};

std::vector<Option<StripRequest>> options_of_strips() {
    using R = StripRequest;
    std::vector<Option<R>> all;
    for (const Option<RenderRequest>& o : render_options().all)
        if (std::ranges::find(of_one_render, o.name) == of_one_render.end()) all.push_back(of_inner(o, &R::render));
    const std::vector<Option<R>> own{
        option<R>("vary", fmt::format("WHAT:{{{}}}", fmt::join(varied_things(), ",")), "What is another thing in every tile",
                  &R::vary, one_of(varied_things()))
            .required(),
        option<R>("values", "A,B,...",
                  "A tile each, or a row each of ways: ascending numbers, or methods with options of render after colons, as in "
                  "walk:direct=bsdf; default those of the lectures",
                  &R::values, any_text())
            .with_commas(),
        option<R>("mark", "X,Y", "Put a cross on this pixel of every tile, and its value below", &R::mark,
                  Form<std::array<int, 2>>{[](const std::string& text) { return two_whole(text, ','); },
                                           [](const auto& p) { return fmt::format("{},{}", p[0], p[1]); },
                                           not_a("two whole numbers with a comma between, such as 19,160")}),
        of_inner(output_option(&RenderRequest::output, "Folder for the strip; default out/NAME-WHAT"), &R::render)};
    all.insert(all.begin() + 1, own.begin(), own.end());
    all.push_back(of_inner(json_option(&RenderRequest::json, "Print strip.json"), &R::render));
    return all;
}

}  // namespace

const std::vector<std::string>& varied_things() {
    static const std::vector<std::string> things{"samples", "shadow-rays", "hemisphere", "depth", "ways", "methods", "ladder"};
    return things;
}

const Options<StripRequest>& strip_options() {
    static const Options<StripRequest> options{
        "strip", "Render a scene several times with one thing varied, side by side at one exposure", options_of_strips()};
    return options;
}

}  // namespace neumann
