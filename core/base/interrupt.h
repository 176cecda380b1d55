// Handles Ctrl-C and what terminals and batch systems send to end a program: SIGINT, SIGTERM, SIGHUP, SIGXCPU and SIGUSR1.
#pragma once

namespace neumann {

// Makes an interrupt end the program at once, with exit code 1 and a line, because there is nothing yet that could be kept.
void end_at_interrupts();
// From here on the first interrupt asks for an orderly end, and the second ends the program as usual.
void catch_interrupts();
// Ignores interrupts in a process that ends with another one, which receives them as well.
void ignore_interrupts();
bool interrupted();
// Sets the flag directly, for host programs that handle signals themselves, such as Python.
void set_interrupted(bool now);

// While this lives, an interrupt ends a program that catches interrupts at once.
class EndsAtInterrupts {
public:
    EndsAtInterrupts();
    ~EndsAtInterrupts();
    EndsAtInterrupts(const EndsAtInterrupts&) = delete;
    EndsAtInterrupts& operator=(const EndsAtInterrupts&) = delete;

private:
    bool before_;
};

}  // namespace neumann
