// Options that several requests have.
#pragma once

#include "apps/requests/chosen_files.h"
#include "apps/requests/option.h"
#include "apps/requests/scene_file.h"

namespace neumann {

constexpr std::uint64_t most_samples = std::uint64_t{1} << 40;

// SCENE, which may be the name of a bundled scene.
template <class Request>
Option<Request> scene_option(SceneFile Request::*scene) {
    Form<std::string> form = any_text();
    form.read = [](const std::string& text) { return std::optional(scene_along(text)); };
    return option<Request>(
               "scene", "", "Scene file (Mitsuba 3, glTF, COLLADA, pbrt-v4, Tungsten), or the name of one that comes along",
               [=](auto& request) -> auto& { return (request.*scene).path; }, form)
        .alone()
        .required();
}

template <class Request>
Option<Request> definitions_option(SceneFile Request::*scene) {
    Option<Request> o;
    o.kind = OptionWords::Kind::many;
    o.name = "definitions";
    o.type = "name=value";
    o.help = "Define $name in the scene file";
    o.wrong = [](const std::string&) { return ""; };
    o.read = [=](Request& request, const std::vector<std::string>& texts) {
        (request.*scene).definitions = parse_definitions(texts);
    };
    o.texts = [=](const Request& request) {
        std::vector<std::string> texts;
        for (const auto& [name, value] : (request.*scene).definitions) texts.push_back(name + "=" + value);
        return texts;
    };
    return o.with_letter('D');
}

template <class Request>
Option<Request> lenient_option(SceneFile Request::*scene) {
    return flag<Request>(
        "lenient",
        "Take a scene with things that are not known: materials become grey and diffuse, lights, shapes and "
        "parameters are left out, and each is named in a warning",
        [=](auto& request) -> auto& { return (request.*scene).lenient; });
}

template <class Request, class Member>
Option<Request> seed_option(Member member, std::string meaning = "Seed of the random numbers") {
    return option<Request>("seed", "N", std::move(meaning), member, whole_from(0, ~std::uint64_t{0})).showing_default();
}

template <class Request>
Option<Request> threads_option(int Request::*threads) {
    return option<Request>("threads", "THREADS", "Number of threads; default all", threads, whole_from(1, 4096))
        .with_letter('t')
        .of_this_run();
}

template <class Request>
Option<Request> memory_option(std::optional<double> Request::*gibibytes) {
    return option<Request>("memory", "GIB", "Approximate memory that may be taken, in GiB; default half of the machine's",
                           gibibytes, above_zero());
}

// `what`: the data that are written to disk.
template <class Request>
Option<Request> checkpoint_option(std::optional<double> Request::*seconds, const std::string& what) {
    return option<Request>(
        "checkpoint", "S",
        fmt::format("Seconds after which what there is of the {} is written to disk, again and again; default 60", what), seconds,
        above_zero());
}

template <class Request>
Option<Request> output_option(std::string Request::*folder, std::string meaning) {
    return option<Request>("output", "DIR", std::move(meaning), folder, any_text()).with_letter('o').of_this_run();
}

template <class Request>
Option<Request> files_option(std::vector<std::string> Request::*files) {
    return option<Request>("files", fmt::format("WHAT:{{{}}}", fmt::join(all_file_groups(), ",")),
                           "What is written beside run.json; default all of these but layers, which is one file of all "
                           "pictures, figures, which are for papers, and touch",
                           files, one_of(all_file_groups()))
        .with_commas();
}

template <class Request>
Option<Request> theme_option(std::string Request::*theme) {
    return option<Request>("theme", "THEME:{dark,white}",
                           "What the contact sheet, the strips and the GIFs are on: dark, or white for slides and papers", theme,
                           one_of({"dark", "white"}))
        .showing_default();
}

template <class Request>
Option<Request> paths_option(std::vector<std::string> Request::*paths) {
    return option<Request>("paths", "X,Y",
                           "Put the paths of this pixel into the page; or the word named, for the samples that the health report "
                           "names. Repeatable",
                           paths, any_text());
}

template <class Request, class Member>
Option<Request> bounces_option(Member member, std::string meaning, std::uint64_t low = 0, std::uint64_t high = 100000) {
    return option<Request>("bounces", "BOUNCES", std::move(meaning), member, whole_from(low, high)).with_letter('n');
}

template <class Request>
Option<Request> quiet_option(bool Request::*quiet, std::string meaning = "Print nothing but errors") {
    return flag<Request>("quiet", std::move(meaning), quiet).of_this_run();
}

template <class Request>
Option<Request> json_option(bool Request::*json, std::string meaning = "Print JSON") {
    return flag<Request>("json", std::move(meaning), json).of_this_run();
}

}  // namespace neumann
