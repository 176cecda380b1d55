// Handles Ctrl-C: the first asks for an orderly end, the second ends the program as usual.
#pragma once

namespace neumann {

void catch_interrupts();
bool interrupted();
// Sets the flag directly, for host programs that handle signals themselves, such as Python.
void set_interrupted(bool now);

}  // namespace neumann
