#include "apps/command_line/unknown_words.h"

#include "core/base/did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace neumann {

namespace {

// Options of Mitsuba, pbrt, Blender and the CS184 renderer, and what is said here in their place.
constexpr const char* last_bounce = "-n, the last bounce; programs count differently, see counting.md of the manual";
constexpr std::array<std::pair<const char*, const char*>, 13> elsewhere{{
    {"--max-depth", last_bounce},
    {"--maxdepth", last_bounce},
    {"--max-bounces", last_bounce},
    {"--depth", last_bounce},
    {"--bounces", last_bounce},
    {"--samples", "--spp, the samples a pixel"},
    {"--sample-count", "--spp, the samples a pixel"},
    {"--integrator", "--method"},
    {"--threads", "-t"},
    {"--nthreads", "-t"},
    {"--output", "-o, a folder"},
    {"--outfile", "-o, a folder"},
    {"--define", "-D NAME=VALUE"},
}};

}  // namespace

std::string about_unknown_options(const CLI::App& app, const std::vector<std::string>& unexpected) {
    const auto parsed = app.get_subcommands();
    const CLI::App& command = parsed.empty() ? app : *parsed.front();
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    std::string text;
    for (const std::string& word : unexpected) {
        if (!word.starts_with("-") || word.size() < 2) continue;
        const std::string name = word.substr(0, word.find('='));
        const auto other = std::ranges::find(elsewhere, name, [](const auto& entry) { return std::string_view(entry.first); });
        const bool stands_for_one = other != elsewhere.end() && command.get_name() == "render";
        text += fmt::format("{}{}: {} has no such option{}", text.empty() ? "" : "\n", name, command.get_name(),
                            stands_for_one ? fmt::format("; here it is {}", other->second) : did_you_mean(name, names));
    }
    return text;
}

}  // namespace neumann
