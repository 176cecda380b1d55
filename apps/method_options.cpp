#include "apps/method_options.h"

#include "apps/options.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace neumann {

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

std::optional<SamplerKind> sampler_kind(const std::string& name) {
    if (name.empty()) return std::nullopt;
    return name == "sobol" ? SamplerKind::sobol : SamplerKind::independent;
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
