#include "tests/search/apart.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <sstream>

#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

namespace neumann::search {

namespace {

// Of addresses, not of memory: what grows without end is stopped before the machine swaps.
constexpr rlim_t most_bytes = rlim_t{16} << 30;
// What waits for ever takes no time of the processor.
constexpr unsigned times_longer = 20;

[[noreturn]] void work_and_end(const std::function<void(Words&)>& work, int file) {
    const rlimit no_core{0, 0}, bytes{most_bytes, most_bytes};
    setrlimit(RLIMIT_CORE, &no_core);
    setrlimit(RLIMIT_AS, &bytes);
    Words words(file);
    try {
        work(words);
        words.say("end");
    } catch (const std::exception& e) {
        words.say(fmt::format("exception {}", e.what()));
    }
    _exit(0);  // without the destructors of what the parent has, too
}

}  // namespace

void Words::say(std::string line) {
    for (char& c : line)
        if (c == '\n') c = ' ';
    line += '\n';
    for (std::size_t done = 0; done < line.size();) {
        const ssize_t n = write(file_, line.data() + done, line.size() - done);
        if (n < 0 && errno != EINTR) _exit(1);
        if (n > 0) done += static_cast<std::size_t>(n);
    }
}

void limit_time(unsigned seconds) {
    const itimerval of_processor{{0, 0}, {static_cast<time_t>(seconds), 0}};
    setitimer(ITIMER_PROF, &of_processor, nullptr);
    alarm(times_longer * seconds);
}

Ended run_apart(const std::function<void(Words&)>& work) {
    int ends[2];
    if (pipe(ends) != 0) throw RunError(fmt::format("pipe: {}", std::strerror(errno)));
    const pid_t child = fork();
    if (child < 0) throw RunError(fmt::format("fork: {}", std::strerror(errno)));
    if (child == 0) {
        close(ends[0]);
        work_and_end(work, ends[1]);
    }
    close(ends[1]);
    std::string text;
    std::array<char, 4096> buffer;
    for (;;) {
        const ssize_t n = read(ends[0], buffer.data(), buffer.size());
        if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
        if (n == 0 || (n < 0 && errno != EINTR)) break;
    }
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    Ended ended;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) ended.lines.push_back(line);
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGALRM || WTERMSIG(status) == SIGPROF))
        ended.how = "took too long";
    else if (WIFSIGNALED(status))
        ended.how = fmt::format("died of {}", strsignal(WTERMSIG(status)));
    else if (ended.lines.empty() || ended.lines.back() != "end")
        ended.how = ended.lines.empty() ? "ended without a word" : ended.lines.back();
    if (ended.how.empty()) ended.lines.pop_back();
    return ended;
}

}  // namespace neumann::search
