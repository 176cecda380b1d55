// The commands of experiments and of matrices are run by a second program, neumann-experiments, which is beside neumann where that
// is built and among its modules where it is installed. Renders do not need it, nor wait for its compilation.
#pragma once

namespace neumann {

// In `neumann`: executes the other program, and does not return, if the command belongs to it. In the other program: nothing.
void go_on_where_experiments_are(char** argv);

}  // namespace neumann
