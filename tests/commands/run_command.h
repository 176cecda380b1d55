// The command as its users run it: a process with arguments, in a folder of its own, of which all that it prints and leaves is
// kept.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace neumann {

// What a process left behind; exit_code is 128 + n where signal n ended it.
struct Finished {
    int exit_code = -1;
    std::string out, err;
};

inline std::string text_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

// A process that is still running; it is ended with this, if it has not ended itself, and with the test.
class RunningCommand {
public:
    // Runs `command` (the program's path first) in `folder`; `logs` is a name for the files of stdout and stderr. With
    // `largest_file`, no file can grow beyond so many bytes: writes fail as they do on a full disk.
    RunningCommand(std::vector<std::string> command, const std::filesystem::path& folder, const std::filesystem::path& logs,
                   std::optional<rlim_t> largest_file = std::nullopt)
        : out_(logs.string() + ".out"), err_(logs.string() + ".err") {
        std::vector<char*> arguments;
        for (std::string& argument : command) arguments.push_back(argument.data());
        arguments.push_back(nullptr);
        const pid_t parent = getpid();
        process_ = fork();
        if (process_ != 0) return;
        // Only what is allowed between fork and exec.
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent || chdir(folder.c_str()) != 0) _exit(127);
        const int out = open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600),
                  err = open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int nothing = open("/dev/null", O_RDONLY);
        if (dup2(nothing, 0) < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0) _exit(127);
        const rlimit seconds{120, 120};
        setrlimit(RLIMIT_CPU, &seconds);  // what never ends fails, and does not hang
        if (largest_file) {
            std::signal(SIGXFSZ, SIG_IGN);
            const rlimit size{*largest_file, *largest_file};
            setrlimit(RLIMIT_FSIZE, &size);
        }
        execv(arguments.front(), arguments.data());
        _exit(127);
    }
    RunningCommand(const RunningCommand&) = delete;
    RunningCommand& operator=(const RunningCommand&) = delete;
    ~RunningCommand() {
        if (process_ <= 0) return;
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }

    void signal(int number) const { kill(process_, number); }
    // What it has in memory now.
    // 0 before it has become the program.
    double resident_bytes() const {
        std::error_code error;
        const std::filesystem::path process("/proc/" + std::to_string(process_));
        if (std::filesystem::read_symlink(process / "exe", error) == std::filesystem::read_symlink("/proc/self/exe", error))
            return 0.0;
        std::ifstream file("/proc/" + std::to_string(process_) + "/statm");
        double all = 0.0, resident = 0.0;
        file >> all >> resident;
        return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
    }

    Finished wait() {
        int status = 0;
        if (process_ <= 0 || waitpid(process_, &status, 0) != process_) return {};
        process_ = -1;
        return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status), text_of(out_), text_of(err_)};
    }

private:
    std::filesystem::path out_, err_;
    pid_t process_ = -1;
};

// Tests of the command, each in an empty folder of its own. Paths are relative to it, so messages can be compared whole.
class CommandTest : public testing::Test {
protected:
    using Names = std::set<std::string>;

    CommandTest() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        base_ =
            std::filesystem::path(testing::TempDir()) / ("neumann_" + std::string(info->test_suite_name()) + "." + info->name());
        std::filesystem::remove_all(base_);
        std::filesystem::create_directories(folder());
    }
    ~CommandTest() override { std::filesystem::remove_all(base_); }

    std::filesystem::path folder() const { return base_ / "work"; }
    std::filesystem::path path(const std::string& name) const { return folder() / name; }

    void write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories(path(name).parent_path());
        std::ofstream(path(name), std::ios::binary) << text;
    }

    std::vector<std::string> neumann(const std::vector<std::string>& arguments) const {
        std::vector<std::string> command{NEUMANN};
        command.insert(command.end(), arguments.begin(), arguments.end());
        return command;
    }
    Finished run(const std::vector<std::string>& arguments, std::optional<rlim_t> largest_file = std::nullopt) const {
        return RunningCommand(neumann(arguments), folder(), base_ / "log", largest_file).wait();
    }
    // What a command says that is wrong: exit code 2, and nothing printed.
    std::string refused(const std::vector<std::string>& arguments) const {
        const Finished done = run(arguments);
        EXPECT_EQ(done.exit_code, 2);
        EXPECT_EQ(done.out, "");
        return done.err;
    }
    // Runs a program other than neumann.
    Finished run_program(const std::vector<std::string>& command) const {
        return RunningCommand(command, folder(), base_ / "log").wait();
    }
    RunningCommand start_program(const std::vector<std::string>& command) const {
        return RunningCommand(command, folder(), base_ / "log");
    }
    RunningCommand start(const std::vector<std::string>& arguments) const { return start_program(neumann(arguments)); }

    // All that is below a folder, files and folders.
    Names names(const std::string& below = ".") const {
        Names found;
        std::error_code error;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path(below), error))
            found.insert(entry.path().lexically_relative(path(below)).string());
        return found;
    }
    // Likewise, with what is in the files.
    std::map<std::string, std::string> contents(const std::string& below) const {
        std::map<std::string, std::string> found;
        for (const std::string& name : names(below)) found[name] = text_of(path(below) / name);
        return found;
    }

private:
    std::filesystem::path base_;
};

}  // namespace neumann
