// The commands of experiments and of matrices, which a program of its own runs: neumann-experiments, beside neumann where that is
// built and among its modules where it is installed. Renders need none of it, and wait for none of it to be compiled.
#pragma once

namespace neumann {

// In `neumann`: goes on as the other program if the command is one of its own and it is there; then this does not return. In the
// other program itself: nothing.
void go_on_where_experiments_are(char** argv);

}  // namespace neumann
