#include "core/base/interrupt.h"

#include <unistd.h>
#include <atomic>
#include <csignal>
#include <string_view>

namespace neumann {

namespace {

std::atomic<bool> caught = false, ends_at_once = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // may be set in a signal handler

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1};

void on_signal(int number) {
    if (ends_at_once) {
        constexpr std::string_view line = "neumann: interrupted\n";
        [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
        ::_exit(1);  // runs no destructors, which a signal may not call
    }
    caught = true;
    std::signal(number, SIG_DFL);
}

void handle_signals() {
    for (const int number : signals)
        // A SIGHUP that nohup ignores stays ignored.
        if (std::signal(number, on_signal) == SIG_IGN && number == SIGHUP) std::signal(number, SIG_IGN);
}

}  // namespace

void end_at_interrupts() {
    ends_at_once = true;
    handle_signals();
}

void catch_interrupts() {
    ends_at_once = false;
    handle_signals();
}

void ignore_interrupts() {
    for (const int number : signals) std::signal(number, SIG_IGN);
}

bool interrupted() { return caught; }
void set_interrupted(bool now) { caught = now; }

EndsAtInterrupts::EndsAtInterrupts() : before_(ends_at_once.exchange(true)) {}
EndsAtInterrupts::~EndsAtInterrupts() { ends_at_once = before_; }

}  // namespace neumann
