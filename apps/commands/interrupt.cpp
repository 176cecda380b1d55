#include "apps/commands/interrupt.h"

#include <atomic>
#include <csignal>

namespace neumann {

namespace {

std::atomic<bool> caught = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // may be set in a signal handler

void on_signal(int number) {
    caught = true;
    std::signal(number, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

bool interrupted() { return caught; }
void set_interrupted(bool now) { caught = now; }

}  // namespace neumann
