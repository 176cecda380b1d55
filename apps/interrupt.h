// Ctrl-C, once asks for an orderly end, twice ends the program as usual.
#pragma once

namespace neumann {

void catch_interrupts();
bool interrupted();

}  // namespace neumann
