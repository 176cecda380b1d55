// The command line.
#include "apps/command_line/add_options.h"
#include "apps/command_line/command_manual.h"
#include "apps/command_line/commands.h"
#include "apps/command_line/experiments.h"
#include "apps/command_line/unknown_words.h"
#include "apps/processes/launch.h"
#include "core/base/did_you_mean.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <vector>

namespace {

constexpr int failed_while_running = 1, wrong_input = 2;

// This does not use fmt::print, which throws if stderr cannot be written.
void complain(const std::string& what) { std::fputs((what + "\n").c_str(), stderr); }

// Returns `code`; throws RunError if the printed text could not be written.
int finish(int code) {
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
    throw neumann::RunError(std::string("standard output cannot be written: ") + std::strerror(errno));
}

std::string join(int argc, char** argv) {
    std::string line = "neumann";
    for (int i = 1; i < argc; ++i) line += fmt::format(" {}", argv[i]);
    return line;
}

// The command of this name; the program itself if the name is empty.
const CLI::App& find(const CLI::App& app, const std::string& name) {
    if (name.empty()) return app;
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_name() == name) return *command;
        names.push_back(command->get_name());
    }
    throw neumann::InputError(
        fmt::format("no command is called '{}'; there are {}{}", name, fmt::join(names, ", "), neumann::did_you_mean(name, names)));
}

// Keeps freed memory for new pictures: on virtual machines the first touch of a page takes longer than filling it.
void keep_memory() {
    constexpr int largest_threshold = 32 << 20;  // glibc takes no larger one
    mallopt(M_MMAP_THRESHOLD, largest_threshold);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

}  // namespace

int main(int argc, char** argv) try {
    neumann::go_on_where_experiments_are(argv);
    keep_memory();
    std::signal(SIGXFSZ, SIG_IGN);  // makes a file that is too large an error of write(), like a full disk
    neumann::end_at_interrupts();
    neumann::Launch launch;
    // In these commands all processes take part from the beginning.
    const bool together = argc > 1 && (argv[1] == std::string("solve") || argv[1] == std::string("spectrum"));
    if (launch.is_helper() && !together) return launch.help();
    CLI::App app("makes the bounces of light visible: the terms of L = Le + K Le + K² Le + …, their sums, and their errors");
    app.name("neumann");
    app.require_subcommand(1);
    app.set_version_flag("--version", "neumann " NEUMANN_VERSION);
    app.formatter(std::make_shared<neumann::ManualFormatter>());

    const std::vector<neumann::Command> commands = neumann::add_commands(app, join(argc, argv));
    auto* help = app.add_subcommand("help", "Show the manual page of a command, or of the program");
    std::string topic;
    bool roff = false;
    help->add_option("COMMAND", topic, "Command");
    help->add_flag("--roff", roff, "Print the page as man reads it");

    if (argc > 1 && argv[1][0] != '-') find(app, argv[1]);
    try {
        std::vector<std::string> arguments = neumann::joined_arguments(argc, argv);
        std::ranges::reverse(arguments);  // CLI11 expects this order
        app.parse(std::move(arguments));
    } catch (const CLI::ParseError& e) {
        if (launch.is_helper()) return launch.help();
        if (dynamic_cast<const CLI::ExtrasError*>(&e))
            if (const std::string about = neumann::about_unknown_options(app, app.remaining(true)); !about.empty())
                throw neumann::InputError(about + "\nRun with --help for more information.");
        const int code = app.exit(e);
        return code == 0 ? finish(0) : wrong_input;
    }
    if (*help) {
        const neumann::ManualPage page = neumann::manual_page(find(app, topic));
        fmt::print("{}", roff ? as_roff(page) : as_text(page));
        return finish(0);
    }
    const auto given = std::ranges::find_if(commands, [](const neumann::Command& command) { return bool(*command.app); });
    if (!launch.is_helper()) return finish(given->run());
    // All processes find the same errors of the input, and the first one reports them.
    try {
        given->run();
    } catch (const neumann::InputError&) {
    } catch (const neumann::RunError&) {
    }
    return launch.help();
} catch (const neumann::UnknownError& e) {
    complain(std::string(e.what()) + "\n--lenient takes the scene without what is not known");
    return wrong_input;
} catch (const neumann::OptionError& e) {
    complain(std::string("--") + e.what());
    return wrong_input;
} catch (const neumann::InputError& e) {
    complain(e.what());
    return wrong_input;
} catch (const std::filesystem::filesystem_error& e) {
    complain(fmt::format("{}: {}", e.path1().string(), e.code().message()));
    // These errors mean that no file can have this name; otherwise something failed.
    const bool is_name = e.code() == std::errc::too_many_symbolic_link_levels || e.code() == std::errc::filename_too_long ||
                         e.code() == std::errc::permission_denied || e.code() == std::errc::not_a_directory;
    return is_name ? wrong_input : failed_while_running;
} catch (const std::bad_alloc&) {
    complain("neumann: not enough memory");
    return failed_while_running;
} catch (const std::exception& e) {
    complain(std::string("neumann: ") + e.what());
    return failed_while_running;
}
