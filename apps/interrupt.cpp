#include "apps/interrupt.h"

#include <csignal>

namespace neumann {

namespace {

volatile std::sig_atomic_t caught = 0;

void on_signal(int number) {
    caught = 1;
    std::signal(number, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

bool interrupted() { return caught != 0; }

}  // namespace neumann
