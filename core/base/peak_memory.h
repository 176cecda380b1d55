// The most memory that this process had at a time: resident, of Linux's /proc.
#pragma once

namespace neumann {

// Begins to look for a new maximum, from what is used now. False where the system does not allow that: then the maximum is that of
// the whole run.
bool restart_peak_memory();
// In bytes; 0 where it is unknown.
double peak_memory();

}  // namespace neumann
