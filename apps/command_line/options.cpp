#include "apps/command_line/options.h"

#include "apps/command_line/scenes_along.h"
#include "apps/commands/patch_scene.h"
#include "apps/output/files/chosen_files.h"

#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <string_view>

namespace neumann {

CLI::Validator above_zero() {
    return CLI::Validator(
        [](std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0.0;
            return good ? std::string() : "'" + text + "' is not a number above 0";
        },
        "", "above_zero");
}

CLI::Validator whole_from(std::uint64_t low, std::uint64_t high) {
    return CLI::Validator(
        [=](std::string& text) {
            std::uint64_t value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool good = error == std::errc() && end == text.data() + text.size() && value >= low && value <= high;
            return good ? std::string() : fmt::format("'{}' is not a whole number from {} to {}", text, low, high);
        },
        "", "whole");
}

void add_scene(CLI::App& command, std::string& scene) {
    const auto along = [](std::string& text) {
        text = scene_along(text);
        return std::string();
    };
    command
        .add_option("SCENE", scene, "Scene file (Mitsuba 3, glTF, COLLADA, pbrt-v4, Tungsten), or the name of one that comes along")
        ->transform(CLI::Validator(along, "", "along"))
        ->required();
}

void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& meaning) {
    command.add_option("--seed", seed, meaning)->type_name("N")->check(whole_from(0, ~std::uint64_t{0}))->capture_default_str();
}

void add_threads(CLI::App& command, int& threads) {
    command.add_option("-t", threads, "Number of threads; default all")->type_name("THREADS")->check(whole_from(1, 4096));
}

CLI::Option* add_checkpoint(CLI::App& command, std::optional<double>& seconds, const std::string& what) {
    return command
        .add_option(
            "--checkpoint", seconds,
            fmt::format("Seconds after which what there is of the {} is written to disk, again and again; default 60", what))
        ->type_name("S")
        ->check(above_zero());
}

void add_memory(CLI::App& command, std::optional<double>& gibibytes) {
    command.add_option("--memory", gibibytes, "Approximate memory that may be taken, in GiB; default half of the machine's")
        ->type_name("GIB")
        ->check(above_zero());
}

PartOfSamples part_of(const std::string& text) {
    PartOfSamples part{0, 0};
    const char* end = text.data() + text.size();
    const auto k = std::from_chars(text.data(), end, part.k);
    if (k.ec != std::errc() || k.ptr == end || *k.ptr != '/') return {0, 0};
    const auto n = std::from_chars(k.ptr + 1, end, part.n);
    return n.ec == std::errc() && n.ptr == end ? part : PartOfSamples{0, 0};
}

CLI::Validator whole_part() {
    return CLI::Validator(
        [](std::string& text) {
            const PartOfSamples part = part_of(text);
            const bool good = part.k >= 1 && part.k <= part.n;
            return good ? std::string() : fmt::format("'{}' is not K/N with K from 1 to N, such as 3/16", text);
        },
        "", "part");
}

void add_files(CLI::App& command, std::vector<std::string>& files, std::string& theme) {
    command
        .add_option("--files", files,
                    "What is written beside run.json; default all of these but layers, which is one file of all pictures")
        ->type_name("WHAT")
        ->delimiter(',')
        ->check(CLI::IsMember(all_file_groups()));
    command
        .add_option("--theme", theme,
                    "What the contact sheet, the strips and the GIFs are on: dark, or white for slides and papers")
        ->type_name("THEME")
        ->check(CLI::IsMember({"dark", "white"}))
        ->capture_default_str();
}

void add_paths(CLI::App& command, std::vector<std::string>& paths) {
    command
        .add_option("--paths", paths,
                    "Put the paths of this pixel into the page; or the word named, for the samples that the health report names. "
                    "Repeatable")
        ->type_name("X,Y")
        ->allow_extra_args(false)
        ->take_all();
}

void add_definitions(CLI::App& command, std::vector<std::string>& texts) {
    command.add_option("-D", texts, "Define $name in the scene file")->type_name("name=value")->allow_extra_args(false)->take_all();
}

void add_lenient(CLI::App& command, bool& lenient) {
    command.add_flag(
        "--lenient", lenient,
        "Take a scene with things that are not known: materials become grey and diffuse, lights, shapes and parameters "
        "are left out, and each is named in a warning");
}

void add_petsc(CLI::App& command, std::optional<std::string>& options, const std::string& meaning) {
    command.add_option("--petsc", options, meaning)->type_name("OPTIONS")->expected(0, 1)->default_str("");
}

std::vector<std::string> joined_arguments(int argc, char** argv) {
    std::vector<std::string> joined;
    for (int i = 1; i < argc; ++i) {
        const std::string_view text = argv[i];
        // What is no port is the scene.
        if (!joined.empty() && joined.back() == "--live")
            joined.back() += !text.empty() && text.find_first_not_of("0123456789") == text.npos ? "" : "=0";
        const bool petsc = !joined.empty() && joined.back() == "--petsc" && text.size() > 2 && text[0] == '-' && text[1] != '-' &&
                           !text.starts_with("-D") && text.find_first_of("_ ") != text.npos;
        if (petsc)
            joined.back() += "=" + std::string(text);
        else
            joined.emplace_back(text);
    }
    return joined;
}

void add_patch_options(CLI::App& command, PatchOptions& options) {
    add_scene(command, options.scene);
    command.add_option("--patches", options.patches, "Approximate number of patches")
        ->type_name("N")
        ->check(whole_from(0, std::uint64_t{1} << 40))
        ->capture_default_str();
    command.add_option("--directions", options.rays, "Number of rays of T for each side of a patch, a power of two")
        ->type_name("M")
        ->check(whole_from(0, std::uint64_t{1} << 40))
        ->capture_default_str();
    add_seed(command, options.seed);
    add_threads(command, options.threads);
    add_memory(command, options.memory);
    add_definitions(command, options.definitions);
    add_lenient(command, options.lenient);
    auto* keep = command
                     .add_option("--keep", options.keep,
                                 "Folder that keeps the rays of T: they are taken from there if they were traced before, by this "
                                 "command until it was cut off, or by another")
                     ->type_name("DIR");
    add_checkpoint(command, options.checkpoint, "T")->needs(keep);
    command.add_flag("--quiet", options.quiet, "Print no warnings");
    command.add_flag("--json", options.json, "Print JSON");
}

}  // namespace neumann
