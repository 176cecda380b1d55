#include "apps/command_line/method_options.h"

#include "apps/command_line/options.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace neumann {

namespace {

void add_light_options(CLI::App& command, LightOptions& options) {
    command
        .add_option("--direct", options.direct,
                    "How a walk finds lights. By directions: hemisphere (uniform), cosine, bsdf (of the material). By points: "
                    "surfaces (all "
                    "of them), light (on lights), solid-angle (on lights, uniform as seen). Both: mis (bsdf and light by the power "
                    "heuristic, the default), mis-balance, mis-solid-angle")
        ->type_name("HOW")
        ->check(CLI::IsMember(names_of_direct()).description(""));
    command
        .add_option(
            "--lights", options.lights,
            "Which light is asked: mixed (half by power, half alike, the default), uniform, power, contribution (radiance times "
            "solid angle), all (each in turn)")
        ->type_name("WHICH")
        ->check(CLI::IsMember(names_of_lights()).description(""));
    command
        .add_option(
            "--roulette", options.roulette,
            "How walks end: none (not before the last picture, the default), albedo (by what the last reflection left of the "
            "weight), throughput (by what all of them left), or a probability of going on, such as 0.9")
        ->type_name("HOW")
        ->check([](const std::string& text) {
            return is_roulette(text) ? "" : "'" + text + "' is not none, albedo, throughput or a number above 0 and at most 1";
        });
    command
        .add_option("--split", options.split,
                    "At the first surface point of each camera ray, ask L times for light and let C walks go on; 1,1 without it")
        ->type_name("L,C")
        ->check([](const std::string& text) {
            return is_split(text) ? "" : "'" + text + "' is not two whole numbers from 1 to 4096 with a comma between, such as 8,8";
        });
}

}  // namespace

void add_method_options(CLI::App& command, RenderRequest& request) {
    command
        .add_option(
            "--method", request.method,
            "walk: one walk for all bounces; guided: the same with directions drawn by the fields of a matrix solution; surface: "
            "the same by points on all surfaces; light: from the lights to the camera; "
            "bidirectional: from both ends, joined everywhere; classic: by mirrors and glass alone, some of all paths; pointwise: "
            "each bounce by itself, slow and plain; matrix: T and R on patches, fast; gather: the same with K once more at the "
            "pixel; patches: the patches as they are")
        ->type_name("NAME")
        ->check(CLI::IsMember(
                    {"walk", "guided", "surface", "light", "bidirectional", "classic", "pointwise", "matrix", "gather", "patches"})
                    .description(""))
        ->capture_default_str();
    add_light_options(command, request.light);
    command
        .add_option(
            "--sampler", request.sampler,
            "Random numbers of the methods that make paths: sobol (scrambled Sobol' points) or independent; the scene's without it")
        ->type_name("NAME")
        ->check(CLI::IsMember({"sobol", "independent"}).description(""));
    command
        .add_option("--plan", request.plan,
                    "auto: what the scene does not need is left out, as `neumann plan` tells; full: nothing is left out")
        ->type_name("NAME")
        ->check(CLI::IsMember({"auto", "full"}).description(""))
        ->capture_default_str();
    command.add_option("--patches", request.patches, "Patches of guided, patches, matrix and gather; about as many")
        ->type_name("N")
        ->check(whole_from(0, std::uint64_t{1} << 40));
    command.add_option("--directions", request.directions, "Rays of a patch, of guided, patches, matrix and gather")
        ->type_name("N")
        ->check(whole_from(1, 1u << 20));
}

RenderRequest parse_method(const std::string& text) {
    RenderRequest request;
    CLI::App command;
    command.set_help_flag();
    add_method_options(command, request);
    std::istringstream parts(text);
    std::string part;
    std::getline(parts, part, ':');
    std::vector<std::string> arguments{"--method", part};
    while (std::getline(parts, part, ':')) {
        const std::size_t equals = part.find('=');
        const CLI::Option* option = command.get_option_no_throw("--" + part.substr(0, equals));
        if (equals == std::string::npos)
            throw InputError(fmt::format("{}: '{}' is no option, expected NAME=VALUE as in direct=bsdf", text, part));
        if (option == nullptr || part.starts_with("method="))
            throw InputError(fmt::format("{}: '{}' is not an option of a method, such as direct, lights or roulette", text,
                                         part.substr(0, equals)));
        arguments.insert(arguments.end(), {"--" + part.substr(0, equals), part.substr(equals + 1)});
    }
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    try {
        command.parse(arguments);
    } catch (const CLI::ParseError& e) {
        throw InputError(fmt::format("{}: {}", text, e.what()));
    }
    return request;
}

}  // namespace neumann
