#include "apps/command_line/unknown_words.h"

#include "core/base/did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace neumann {

namespace {

// Options of Mitsuba, pbrt, Blender and the CS184 renderer, the option that they correspond to here, and a remark.
struct Elsewhere {
    std::string_view name, here, about;
};
constexpr std::string_view last_bounce = ", the last bounce; programs count differently, see counting.md of the manual",
                           samples = ", the samples a pixel",
                           size = ", as in -D res=256 or -D width=256: sizes have the names that the scene gives them",
                           folder = ", a folder";
constexpr std::array<Elsewhere, 19> elsewhere{{
    {"--max-depth", "-n", last_bounce},
    {"--maxdepth", "-n", last_bounce},
    {"--max-bounces", "-n", last_bounce},
    {"--depth", "-n", last_bounce},
    {"--bounces", "-n", last_bounce},
    {"--samples", "--spp", samples},
    {"--sample-count", "--spp", samples},
    {"--integrator", "--method", ""},
    {"--threads", "-t", ""},
    {"--nthreads", "-t", ""},
    {"--output", "-o", folder},
    {"--outfile", "-o", folder},
    {"--define", "-D", " NAME=VALUE"},
    {"--res", "-D", size},
    {"--resolution", "-D", size},
    {"--size", "-D", size},
    {"--width", "-D", size},
    {"--height", "-D", size},
    {"-r", "-D", size},
}};

std::string about(const std::string& name, const CLI::App& command) {
    std::vector<std::string> names;
    bool is_known = false;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& other : option->get_lnames()) names.push_back("--" + other);
        is_known = is_known || option->check_name(name);
    }
    // CLI11 assigns options after the command to the command.
    if (is_known)
        return fmt::format("{0} stands before the command, expected after it: neumann {1} … {0}", name, command.get_name());
    const auto other = std::ranges::find(elsewhere, std::string_view(name), &Elsewhere::name);
    const bool stands_for_one = other != elsewhere.end() && command.get_option_no_throw(std::string(other->here)) != nullptr;
    return fmt::format("{}: {} has no such option{}", name, command.get_name(),
                       stands_for_one ? fmt::format("; here it is {}{}", other->here, other->about) : did_you_mean(name, names));
}

}  // namespace

std::string about_unknown_options(const CLI::App& app, const std::vector<std::string>& unexpected) {
    const auto parsed = app.get_subcommands();
    const CLI::App& command = parsed.empty() ? app : *parsed.front();
    std::string text;
    for (const std::string& word : unexpected)
        if (word.starts_with("-") && word.size() > 1)
            text += (text.empty() ? "" : "\n") + about(word.substr(0, word.find('=')), command);
    return text;
}

}  // namespace neumann
