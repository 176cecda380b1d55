#include "apps/requests/render_request.h"

#include "apps/requests/shared_options.h"

namespace neumann {

namespace {

using R = RenderRequest;

Option<R> method_option() {
    Form<std::string> form = any_text();
    form.read = [](const std::string& text) { return wrong_method(text).empty() ? std::optional(text) : std::nullopt; };
    form.wrong = wrong_method;
    return option<R>(
        "method", "NAME", method_help(), [](auto& r) -> auto& { return r.method.name; }, form);
}

Option<R> of_method(const MethodOption& own) {
    Option<R> o;
    o.kind = own.kind == MethodOption::Kind::flag ? OptionWords::Kind::flag : OptionWords::Kind::one;
    o.name = own.name;
    o.type = own.type;
    o.help = own.help;
    o.wrong = own.wrong;
    o.is_number = own.kind == MethodOption::Kind::number;
    o.read = [name = own.name](R& r, const std::vector<std::string>& texts) {
        std::erase_if(r.method.options, [&](const auto& option) { return option.first == name; });
        r.method.options.emplace_back(name, texts.back());
    };
    o.texts = [name = own.name](const R& r) {
        for (const auto& [given, text] : r.method.options)
            if (given == name) return std::vector{text};
        return std::vector<std::string>();
    };
    return o;
}

Option<R> part_option() {
    const auto read = [](const std::string& text) -> std::optional<PartOfSamples> {
        const auto part = two_whole(text, '/');
        if (!part || (*part)[0] < 1 || (*part)[0] > (*part)[1]) return std::nullopt;
        return PartOfSamples{static_cast<std::uint32_t>((*part)[0]), static_cast<std::uint32_t>((*part)[1])};
    };
    return option<R>(
        "part", "K/N", "Render the K-th of N parts of the samples of --spp, which neumann merge puts together",
        [](auto& r) -> auto& { return r.goal.part; },
        Form<PartOfSamples>{read, [](const PartOfSamples& part) { return fmt::format("{}/{}", part.k, part.n); },
                            not_a("K/N with K from 1 to N, such as 3/16")});
}

std::vector<Option<R>> all_options() {
    std::vector<Option<R>> all{
        scene_option(&R::scene),
        output_option(&R::output, "Folder for the pictures and tables; default out/NAME"),
        bounces_option<R>(
            [](auto& r) -> auto& { return r.goal.bounces; }, "The last bounce with a picture of its own"),
        option<R>(
            "tail", "EPS", "Render as many bounces as it takes until the rest is below this part of the sum",
            [](auto& r) -> auto& { return r.goal.tail; }, above_zero())
            .not_with("bounces"),
        option<R>(
            "spp", "N", "Samples a pixel", [](auto& r) -> auto& { return r.goal.samples; }, whole_from(1, most_samples)),
        option<R>(
            "time", "S", "Sample, or refine patches, for this many seconds", [](auto& r) -> auto& { return r.goal.seconds; },
            above_zero()),
        option<R>(
            "error", "REL",
            "Sample until the relative standard error of every bounce is at most this, checked when the number of samples "
            "is a power of two; without --time for ten minutes at most",
            [](auto& r) -> auto& { return r.goal.relative_error; }, above_zero()),
        memory_option(&R::memory),
        method_option()};
    for (const MethodOption& own : method_options()) all.push_back(of_method(own));
    const std::vector<Option<R>> others{
        option<R>("reference", "DIR", "Folder of an earlier render; convergence.csv then also has the errors against it",
                  &R::reference, any_text()),
        option<R>(
            "hemisphere", "X,Y",
            "In place of the camera's picture, what arrives at the point that this pixel sees, from all directions: T K^i Le",
            [](auto& r) -> auto& { return r.scene.hemisphere; },
            Form<std::array<int, 2>>{[](const std::string& text) { return two_whole(text, ','); },
                                     [](const std::array<int, 2>& pixel) { return fmt::format("{},{}", pixel[0], pixel[1]); },
                                     not_a("a pixel, such as 19,160")}),
        files_option(&R::files),
        theme_option(&R::theme),
        paths_option(&R::paths),
        part_option(),
        checkpoint_option(&R::checkpoint, "render"),
        option<R>("resume", "DIR", "Go on with the render in this folder that was cut off, or add samples to one that is finished",
                  &R::resume, any_text())
            .of_this_run(),
        option<R>("live", "PORT",
                  "Serve the page of the render to browsers of this machine, where it fills meanwhile, at this port of 127.0.0.1; "
                  "without a number at any that is free",
                  &R::live, whole_from(0, 65535))
            .meaning_without_value("0")
            .of_this_run(),
        option<R>("tev", "HOST:PORT", "Show the bounces and sums meanwhile in the tev that listens there", &R::tev, any_text())
            .of_this_run(),
        seed_option<R>([](auto& r) -> auto& { return r.goal.seed; }),
        threads_option(&R::threads),
        definitions_option(&R::scene),
        lenient_option(&R::scene),
        flag<R>("touch", "Write touch.html, too: a page on which materials and lamps are changed, and all bounces follow",
                &R::touch)
            .of_this_run(),
        quiet_option(&R::quiet),
        json_option(&R::json, "Print run.json")};
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

}  // namespace

const Options<RenderRequest>& render_options() {
    static const Options<R> options{"render", "Render the bounces K^i Le of a scene, their sums, and what is left out",
                                    all_options()};
    return options;
}

}  // namespace neumann
