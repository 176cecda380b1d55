#include "apps/command_line/resume.h"

#include "apps/command_line/commands.h"
#include "apps/commands/render_command.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/saved_render.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace neumann {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 3> limits = {"--spp", "--time", "--error"};
// What has no effect on the samples. The scene may have moved; its hash tells whether it is the same.
constexpr std::array<std::string_view, 12> changeable = {"SCENE",  "-t",     "--memory", "--files",      "--paths",     "--quiet",
                                                         "--live", "--json", "--resume", "--checkpoint", "--reference", "--tev"};

bool is_one_of(const auto& names, const std::string& name) { return std::ranges::find(names, name) != names.end(); }

std::string words(const Json& values) { return fmt::format("{}", fmt::join(values.get<std::vector<std::string>>(), " ")); }

std::vector<std::string> as_arguments(const Json& options) {
    std::vector<std::string> arguments = {"render"};
    for (const auto& [name, values] : options.items()) {
        if (name == "--files") {
            arguments.insert(arguments.end(), {name, fmt::format("{}", fmt::join(values.get<std::vector<std::string>>(), ","))});
        } else if (name.starts_with("-")) {
            for (const std::string& value : values.get<std::vector<std::string>>()) {
                arguments.push_back(name);
                if (value != "true") arguments.push_back(value);
            }
        } else {
            arguments.push_back(file_named_in_json(values.at(0)));
        }
    }
    return arguments;
}

}  // namespace

Json given_options(const CLI::App& command) {
    Json options = Json::object();
    for (const CLI::Option* o : command.get_options())
        if (o->count() > 0) options[o->get_name()] = o->results();
    return options;
}

Json lasting(Json options) {
    for (const char* name : {"-o", "-t", "--quiet", "--json", "--live", "--tev", "--resume"}) options.erase(name);
    return options;
}

RenderRequest resumed(const RenderRequest& now) {
    RequestOnDisk begun = request_in(now.resume);
    Json& options = begun.options;
    if (std::ranges::any_of(limits, [&](std::string_view name) { return now.options.contains(std::string(name)); })) {
        if (options.contains("--part"))
            throw InputError(
                fmt::format("--resume: --part {} is of the samples that it began with; for more, render them as parts of "
                            "another seed and merge these, too",
                            words(options.at("--part"))));
        for (const std::string_view name : limits) options.erase(std::string(name));
    }
    for (const auto& [name, values] : now.options.items()) {
        if (name == "-o") throw InputError("-o: --resume writes into the folder of the render that it goes on with");
        if (!is_one_of(limits, name) && !is_one_of(changeable, name) && (!options.contains(name) || options.at(name) != values))
            throw InputError(options.contains(name)
                                 ? fmt::format("--resume: {} is {}, and was {}", name, words(values), words(options.at(name)))
                                 : fmt::format("--resume: {} {} is given, and was not", name, words(values)));
        options[name] = values;
    }
    options.erase("--resume");
    RenderRequest request;
    read_arguments([&](CLI::App& app) { add_render(app, request); }, as_arguments(options));
    request.options = lasting(options);
    request.command_line = now.command_line;
    request.resume = request.output = now.resume;
    request.scene_hash = begun.scene_hash;
    return request;
}

}  // namespace neumann
