// Commands on several processes, started by mpirun as users start them.
#pragma once

#include "tests/commands/render_output.h"

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace neumann {

class LaunchedTest : public RenderTest {
protected:
    // A program on so many processes; 0: without a launcher. Options of Open MPI: root may run in a container, and more processes
    // than processors may be started.
    static std::vector<std::string> on(int processes, std::vector<std::string> command) {
        if (processes == 0) return command;
        std::vector<std::string> all{MPIRUN, "--allow-run-as-root",    "--oversubscribe", "--bind-to", "none",
                                     "-n",   std::to_string(processes)};
        all.insert(all.end(), command.begin(), command.end());
        return all;
    }
    Finished run_on(int processes, const std::vector<std::string>& arguments) const {
        return run_program(on(processes, neumann(arguments)));
    }
    RunningCommand start_on(int processes, const std::vector<std::string>& arguments) const {
        return start_program(on(processes, neumann(arguments)));
    }
    static void expect_done(const Finished& done) {
        EXPECT_EQ(done.exit_code, 0) << done.err;
        EXPECT_EQ(done.err, "");
    }
    bool wait_for(const std::string& name) const {
        for (int i = 0; i < 2000 && !std::filesystem::exists(path(name)); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return std::filesystem::exists(path(name));
    }
    // The process with this number that renders into the folder of this test.
    std::optional<pid_t> process(int rank, const std::string& output) const {
        for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
            const std::string name = entry.path().filename();
            if (name.find_first_not_of("0123456789") != std::string::npos) continue;
            const std::string command = text_of(entry.path() / "cmdline"), environment = text_of(entry.path() / "environ");
            std::error_code error;
            if (command.starts_with(NEUMANN) && command.find(output) != std::string::npos &&
                std::filesystem::read_symlink(entry.path() / "cwd", error) == std::filesystem::canonical(folder()) &&
                ('\0' + environment).find('\0' + fmt::format("OMPI_COMM_WORLD_RANK={}", rank) + '\0') != std::string::npos)
                return std::stoi(name);
        }
        return std::nullopt;
    }
    // The same, as soon as it is there and has had a second to work in.
    std::optional<pid_t> working_process(int rank, const std::string& output) const {
        for (int i = 0; i < 1000; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            if (const auto found = process(rank, output)) {
                std::this_thread::sleep_for(std::chrono::seconds(1));
                return found;
            }
        }
        return std::nullopt;
    }
};

}  // namespace neumann
