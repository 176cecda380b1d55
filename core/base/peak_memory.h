// The peak of the resident memory of this process, by Linux's /proc.
#pragma once

namespace neumann {

// Restarts the search for the maximum from what is used now. Returns false if the system does not allow that: then the
// maximum is that of the whole run.
bool restart_peak_memory();
// The peak in bytes; 0 if it is unknown.
double peak_memory();

}  // namespace neumann
