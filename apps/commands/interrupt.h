// Ctrl-C, once asks for an orderly end, twice ends the program as usual.
#pragma once

namespace neumann {

void catch_interrupts();
bool interrupted();
// The same from within: where another program has its own hands on the signals, as Python has.
void set_interrupted(bool now);

}  // namespace neumann
