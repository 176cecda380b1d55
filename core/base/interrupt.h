// Handles Ctrl-C and what terminals and batch systems send to end a program: SIGINT, SIGTERM, SIGHUP, SIGXCPU and SIGUSR1.
#pragma once

namespace neumann {

// One ends the program at once, with exit code 1 and a line: nothing is there yet that could be kept.
void end_at_interrupts();
// From here on the first asks for an orderly end, and the second ends the program as usual.
void catch_interrupts();
// For a process that ends with another one, to which they are sent, too.
void ignore_interrupts();
bool interrupted();
// Sets the flag directly, for host programs that handle signals themselves, such as Python.
void set_interrupted(bool now);

// Of a program that catches interrupts: while this lives one ends it at once, as in the beginning.
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
